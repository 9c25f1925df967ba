
% @name@_solve at poses with all their configurations, and those whose poses they are, where there are some.
poses = { ...
@poses@
};
known = { ...
@known@
};
given = { ...
@given@
};
is_angle = logical(@angles@);
% Angles modulo a turn, slides by what lengths are compared with (m).
unit = ones(1, 6);
unit(~is_angle) = @unit@;
turn = Inf(1, 6);
turn(is_angle) = 2*pi;
apart = @(q, a) min([Inf; max(abs(q - a - 2*pi*is_angle.*floor((q - a)./turn + 0.5))./unit, [], 2)]);
for k = 1:numel(poses)
    [q, info] = @name@_solve(poses{k});
    if size(q, 1) ~= size(known{k}, 1) || ~strcmp(info.certificate, 'complete')
        error('@name@:test', '@name@_solve: pose %d has %d solutions and is %s.', ...
            k, size(q, 1), info.certificate);
    end
    angles = q(:, is_angle);
    if any(info.residual > 1e-10) || any(info.multiplicity ~= 1) || any(abs(angles(:)) > pi)
        error('@name@:test', '@name@_solve: a solution of pose %d is none.', k);
    end
    for wanted = [known{k}; given{k}].'
        if ~(apart(q, wanted.') <= 1e-9)
            error('@name@:test', '@name@_solve: pose %d lacks a solution.', k);
        end
    end
    % A pose of six decimals is that of nearby configurations; what is no rotation has none.
    scale = [1, 1, 1, @unit@];
    q = @name@_solve(round(1e6*poses{k}./scale)/1e6.*scale);
    for wanted = known{k}.'
        if ~(apart(q, wanted.') <= 1e-2)
            error('@name@:test', '@name@_solve: pose %d of six decimals lacks a solution.', k);
        end
    end
    for by = [1, Inf, NaN]
        wrong = poses{k};
        wrong(1) = wrong(1) + by;
        [q, info] = @name@_solve(wrong);
        if ~isempty(q) || ~strcmp(info.certificate, 'not a pose')
            error('@name@:test', '@name@_solve: what is no rotation has solutions.');
        end
    end
end
