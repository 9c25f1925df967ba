        % Turned about the axes of the base, and shifted.
        along = 2.4*(6*number + (0:2));
        pose = goal;
        pose(:, 4) = pose(:, 4) + far*a.size*sin(2 + along).';
        for i = 1:3
            rows = mod(i + [0, 1], 3) + 1;
            c = cos(far*sin(1 + along(i)));
            s = sin(far*sin(1 + along(i)));
            pose(rows, 1:3) = [c, -s; s, c]*pose(rows, 1:3);
        end
        beside{end + 1, 1} = pose; %#ok<AGROW>
        continue;
