
function a = arm()
% The arm is B Z1 A1 Z2 A2 ... Z6 A6, where Zi turns about z (or moves along z); lengths are divided by its
% size. A value of a joint is the number cos + i sin of an angle, or a slide.
a.size = @size@;
a.slides = logical(@slides@);
a.base = @base@;
a.links = zeros(4, 4, 6);
@links@
% The joint variables are coupling (axes - offsets).
a.coupling = @coupling@;
a.offsets = @offsets@;
a.is_angle = logical(@is_angle@);
% The cuts of the loop in the order in which they are tried: which joint is hidden, and whether the last of
% the three on its side is multiplied.
order = @cuts@;
for k = 1:size(order, 1)
    a.cuts(k) = cut_of(a, order(k, 1), order(k, 2) ~= 0);
end
end

function x = about(slides, value)
% The motion of a joint at a value.
if slides
    x = [1, 0, 0, 0; 0, 1, 0, 0; 0, 0, 1, real(value); 0, 0, 0, 1];
else
    c = real(value);
    s = imag(value);
    x = [c, -s, 0, 0; s, c, 0, 0; 0, 0, 1, 0; 0, 0, 0, 1];
end
end

function x = inverse(x)
% The inverse of a rigid motion.
x = [x(1:3, 1:3).', -x(1:3, 1:3).'*x(1:3, 4); 0, 0, 0, 1];
end

function x = crossed(x, y)
% Vector products of columns.
x = x([2, 3, 1], :) .* y([3, 1, 2], :) - x([3, 1, 2], :) .* y([2, 3, 1], :);
end

function z = on_circle(z)
% Complex numbers divided by their lengths; 1 if they have none.
size_of = abs(z);
z = z ./ size_of;
z(~(size_of > 0)) = 1;
end

function [frame, point, jacobian] = hand(a, values)
% Rotations, 9 x m, points, 3 x m, and the Jacobians, 6 x 6 x m, of configurations, a row each.
m = size(values, 1);
x = a.base(1:3, 1)*ones(1, m);
y = a.base(1:3, 2)*ones(1, m);
z = a.base(1:3, 3)*ones(1, m);
p = a.base(1:3, 4)*ones(1, m);
axes = zeros(3, m, 6);
points = zeros(3, m, 6);
for k = 1:6
    axes(:, :, k) = z;
    points(:, :, k) = p;
    value = values(:, k).';
    if a.slides(k)
        p = p + z .* real(value);
    else
        turned = x .* real(value) + y .* imag(value);
        y = y .* real(value) - x .* imag(value);
        x = turned;
    end
    link = a.links(1:3, :, k);
    p = p + x*link(1, 4) + y*link(2, 4) + z*link(3, 4);
    last = x*link(1, 3) + y*link(2, 3) + z*link(3, 3);
    turned = x*link(1, 1) + y*link(2, 1) + z*link(3, 1);
    y = x*link(1, 2) + y*link(2, 2) + z*link(3, 2);
    x = turned;
    z = last;
end
frame = [x; y; z];
point = p;
jacobian = zeros(6, 6, m);
for k = 1:6
    own = axes(:, :, k);
    if a.slides(k)
        along = [own; zeros(3, m)];
    else
        along = [crossed(own, p - points(:, :, k)); own];
    end
    jacobian(:, k, :) = reshape(along, 6, 1, m);
end
end

function [best, least] = polished(a, goal, values)
% Newton's method on the pose, a row a candidate, each kept at its best; and how far that is from the goal: a
% turn and a shift divided by the size, as one length.
best = values;
least = Inf(size(values, 1), 1);
rows = (1:size(values, 1)).';
patience = 4*ones(size(rows));
turned = reshape(goal(1:3, 1:3), 9, 1);
for step = 1:24
    [frame, point, jacobian] = hand(a, values);
    shift = goal(1:3, 4) - point;
    turn = zeros(3, numel(rows));
    for k = [1, 4, 7]
        aim = turned(k:k + 2)*ones(1, numel(rows));
        turn = turn + 0.5*crossed(frame(k:k + 2, :), aim);
    end
    square = (sum(shift.^2, 1) + 0.5*sum((frame - turned).^2, 1)).';
    patience(rows) = patience(rows) - ~(square < 0.25*least(rows));
    better = square < least(rows);
    best(rows(better), :) = values(better, :);
    least(rows(better)) = square(better);
    goes_on = isfinite(square) & ~(square < 4e-30) & patience(rows) > 0;
    rows = rows(goes_on);
    values = values(goes_on, :);
    if isempty(rows)
        break
    end
    twist = [shift(:, goes_on); turn(:, goes_on)];
    jacobian = jacobian(:, :, goes_on);
    for k = 1:numel(rows)
        [u, s, v] = svd(jacobian(:, :, k));
        s = diag(s);
        part = (u.'*twist(:, k)) ./ s;
        part(s < 1e-13) = 0;
        motion = (v*part).';
        motion = motion*(0.6/max(0.6, max(abs(motion))));
        ahead = on_circle(values(k, :) .* exp(1i*motion));
        ahead(a.slides) = values(k, a.slides) + motion(a.slides);
        values(k, :) = ahead;
    end
end
least = sqrt(least);
end
