function [q, info] = @name@_solve(pose)
%@NAME@_SOLVE  @about@
%
%   At most 16 solutions, each with a residual of at most 1e-10. With them comes a certificate: whether these
%   are all; where there is none, the arm does not reach. Not a pose: the rotation is off by more than a tenth
%   from all rotations, or something is no number; by less, the nearest rotation is meant.
%
%   [Q, INFO] = @NAME@_SOLVE(POSE): POSE is 3 x 4; a solution a row of Q.
%   INFO has a row a solution in each field: residual (how far the forward model is from the pose: a turn in
%   rad and a shift divided by the arm's size, as one length), multiplicity (2 where two solutions come
%   together, else 1), singular (the smallest singular value of the Jacobian, lengths divided by that size).
%   INFO.certificate is 'complete' (these are all, each of them isolated), 'near double root' (two come
%   together, or are about to, or miss each other by less than rounding tells; or the arm can move with its
%   hand still), 'undecided' (there may be more) or 'not a pose'.

narginchk(1, 1);
if ~isnumeric(pose) || ~isreal(pose) || ~isequal(size(pose), [3, 4])
    error('@name@:solve:argument', 'pose must be 3 x 4 real numbers.');
end
pose = double(pose);
persistent kept
if isempty(kept)
    kept = arm();
end
a = kept;
q = zeros(0, 6);
info = struct('residual', zeros(0, 1), 'multiplicity', zeros(0, 1), 'singular', zeros(0, 1));
info.certificate = 'not a pose';
shift = pose(:, 4)/a.size;
[rotation, is_rotation] = nearest_rotation(pose(:, 1:3));
if ~is_rotation || ~all(isfinite(shift))
    return
end
goal = [rotation, shift; 0, 0, 0, 1];

% The wider matrices last: they take longer, and their determinants never vanish.
found = struct('values', zeros(0, 6), 'residual', zeros(0, 1));
last = 'uncertain';
for is_wide = [false, true]
    for k = 1:numel(a.cuts)
        if strcmp(last, 'certified') || (is_wide && strcmp(last, 'pairs'))
            break
        end
        [found, last] = solved(a, a.cuts(k), is_wide, goal, found);
    end
end

count = min(numel(found.residual), 16);
values = found.values(1:count, :);
axes = angle(values);
axes(:, a.slides) = real(values(:, a.slides))*a.size;
q = (axes - a.offsets)*a.coupling.';
own = q(:, a.is_angle);
own = own - 2*pi*floor(own/(2*pi) + 0.5);
q(:, a.is_angle) = own + 2*pi*(own <= -pi);
info.residual = found.residual(1:count);
info.singular = zeros(count, 1);
[~, ~, jacobian] = hand(a, values);
for k = 1:count
    info.singular(k) = min(svd(jacobian(:, :, k)));
end
info.multiplicity = 1 + (info.singular < 1e-6);
% Newton and Kantorovich: a root of its own lies near if 2 K residual <= singular^2, where K = 20 bounds the
% second derivative.
is_isolated = info.singular >= 1e-6 & 40*info.residual <= info.singular.^2;
if numel(found.residual) > count
    info.certificate = 'undecided';
elseif ~all(is_isolated) || strcmp(last, 'pairs')
    info.certificate = 'near double root';
elseif strcmp(last, 'certified')
    info.certificate = 'complete';
else
    info.certificate = 'undecided';
end
end

function [r, is_rotation] = nearest_rotation(r)
% The rotation nearest to a matrix, if it is one, if only to a tenth.
is_rotation = false;
for step = 1:4
    off = eye(3) - r.'*r;
    if ~all(abs(off(:)) <= 0.1)
        return
    end
    if all(abs(off(:)) <= 1e-15)
        break
    end
    r = r + 0.5*r*off;
end
is_rotation = det(r) > 0;
end

function [found, total] = solved(a, cut, is_wide, goal, found)
% Finds the configurations of a cut, and adds them: the whole circle first, then charts of the arcs where
% something does not fit. What is known of the roots: each belongs to a configuration ('certified'); those
% that do not come in pairs, about to be real or just not any more ('pairs'); anything else ('uncertain').
total = 'uncertain';
[loop, is_finite] = eliminated(cut, a.links(:, :, 6)*inverse(goal)*a.base);
if ~is_finite
    return
end
if is_wide
    [every, matrix] = wide_matrix(cut, loop);
    degree = 12;
    count = 32;
    deepest = 2;
else
    matrix = narrow_matrix(cut, loop);
    every = matrix;
    degree = 8;
    count = 24;
    deepest = 4;
end
charts = struct('centre', 1, 'kappa', 1, 'depth', 0);
total = 'certified';
next = 1;
while next <= numel(charts)
    chart = charts(next);
    next = next + 1;
    verdict = 'uncertain';
    arcs = zeros(0, 2);
    [polynomial, noise] = fitted(matrix, chart, degree, count);
    if ~isempty(polynomial)
        roots = roots_of(polynomial, noise);
        if is_wide
            [hidden, null, roots] = wide_candidates(cut, every, chart, roots);
        else
            [hidden, null] = narrow_candidates(cut, every, chart, roots);
        end
        values = completed(cut, loop, a.slides, hidden, null);
        [values, residual] = polished(a, goal, values);
        found = added(a, found, values(residual <= 1e-10, :), residual(residual <= 1e-10));
        [verdict, marks] = judged(cut, chart, roots, found);
        arcs = crowds(polynomial, noise, marks);
    end
    if strcmp(verdict, 'certified')
        continue
    end
    if isempty(arcs) || chart.depth == deepest || numel(charts) + size(arcs, 1) > 12
        if ~strcmp(total, 'uncertain')
            total = verdict;
        end
        continue
    end
    for k = 1:size(arcs, 1)
        charts(end + 1) = part(chart, arcs(k, 1), arcs(k, 2)); %#ok<AGROW>
    end
end
% Configurations come in even numbers.
if strcmp(total, 'certified') && mod(numel(found.residual), 2) ~= 0
    total = 'uncertain';
end
end

function found = added(a, found, values, residual)
% Adds configurations that are new, as far as there is room.
for k = 1:numel(residual)
    scale = ones(size(found.values));
    scale(:, a.slides) = 1 + abs(found.values(:, a.slides));
    apart = max(abs(found.values - values(k, :)) ./ scale, [], 2);
    if numel(apart) < 64 && ~any(apart < 1e-6)
        found.values(end + 1, :) = values(k, :);
        found.residual(end + 1, 1) = residual(k);
    end
end
end

function [verdict, marks] = judged(cut, chart, roots, found)
% Whether each disc that reaches the circle belongs to a configuration of its own; and the angles in the
% chart at which something does not fit. The discs hold the roots of all polynomials that differ by the noise.
z = roots.z;
radius = roots.radius;
% Also where the radius is no number.
reaching = find(~(abs(abs(z) - 1) > radius) & answers_for(chart, real(z) ./ abs(z))).';
at = found.values(:, cut.joints(3));
if ~cut.is_forwards
    at = conj(at);
end
at = inside(chart, at);
at = at(answers_for(chart, real(at)));
left = reaching;
is_stranger = true(size(at));
for k = 1:numel(at)
    away = abs(z(left) - at(k));
    away(away > max(3*radius(left), 1e-7)) = Inf;
    [least, nearest] = min(away);
    if ~isempty(left) && least < Inf
        left(nearest) = [];
        is_stranger(k) = false;
    end
end
marks = zeros(0, 1);
if ~any(is_stranger) && isempty(left)
    verdict = 'certified';
    return
end
vague = reaching(ismember(reaching, left) | ~(radius(reaching) < 1e-2).');
marks = sort(angle([at(is_stranger); z(vague(:))]));
are_pairs = ~any(is_stranger) && mod(numel(at) + numel(left), 2) == 0;
for k = left
    others = reaching(reaching ~= k);
    has_other = any(abs(z(others) - z(k)) <= radius(others) + radius(k));
    are_pairs = are_pairs && radius(k) < 0.02 && has_other;
end
if are_pairs
    verdict = 'pairs';
else
    verdict = 'uncertain';
end
end
