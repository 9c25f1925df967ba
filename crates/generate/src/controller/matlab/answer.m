function varargout = @name@_answer(what, parameters, varargin)
%@NAME@_ANSWER  What @name@_ik, @name@_ik_nearest and @name@_ik_all_within_limits answer.
%
%   All solutions with a status, around @name@_solve. Rows of q are configurations, goals are the first
%   three rows of a pose.

a = arm();
a.parameters = parameters;
switch what
    case 'ik'
        varargout{1} = all_solutions(a, varargin{:});
    case 'nearest'
        varargout{1} = nearest(a, varargin{:});
    case 'within'
        [varargout{1:2}] = all_within(a, varargin{:});
end
end

function a = arm()
% The number of joints, of what functions of the joints take, and the most configurations listed.
a.n = @n@;
a.variables = @variables@;
a.most = @max@;
% What lengths are compared with (m): the sum of the arm's lengths.
a.size = @size@;
% For each joint what its numbers are divided by.
a.unit = @units@;
% By what a joint can move so that all links come back; 0 for one that slides.
a.period = @periods@;
% The range in which angles are listed.
a.window = @windows@;
% The joints whose values are given beside the pose, and the others.
a.given = @given@;
a.free = setdiff(1:a.n, a.given);
% Motions of joints with gears after which all links are back, besides those in turns of one joint; the
% first is none.
a.copies = @copies@;
% Poses beside a singular one that are solved.
a.neighbours = 6;
% Members of families have singular values below this beside the largest.
a.flat = 2e-6;
% How far along the motion of a family its members are searched from.
a.aside = [0, 2, -2];
% Beyond this a value of a joint, divided by its unit, is none: turns are rounded there until the hand is
% elsewhere.
a.far = 1e6;
% The most copies of turns that are listed.
a.most_copies = 1000000;
% What a rotation may be off, by its largest entry, from the nearest one, which is meant.
a.tolerance = 1e-5;
end

function x = turns(x, period)
% The multiple of a period that is nearest to x; 0 where there is no period.
divisor = period;
divisor(period <= 0) = Inf;
x = period .* floor(x ./ divisor + 0.5);
end

function x = way(a, from, to)
% How joints go, divided by their units; angles by the shorter way.
x = to - from;
x = (x - turns(x, a.period)) ./ a.unit;
end

function x = apart(a, from, to)
% The largest of the ways.
x = max(abs(way(a, from, to)), [], 2);
end

function q = wrapped(a, q)
% Angles in the range in which they are listed.
q = q - turns(q, a.window);
q = q + a.window .* (q <= -0.5*a.window);
end

function x = lengths(rows)
x = sqrt(sum(rows.^2, 2));
end
@goal@
function [jacobian, pose] = see(a, q)
% Jacobians, 6 x n x N, and poses, 4 x 4 x N, in one pass.
variables = zeros(size(q, 1), a.variables);
variables(:, 1:a.n) = q;
parameters = a.parameters; %#ok<NASGU>
both = @name@_jacobian_fk(variables@jacobian_fk_parameters@);
jacobian = permute(reshape(both(:, 1:6*a.n), [], a.n, 6), [3, 2, 1]);
pose = permute(reshape(both(:, 6*a.n + 1:end), [], 4, 4), [3, 2, 1]);
end

function [missed, distance, jacobian] = missing(a, goal, q, is_held)
% What is missing from configurations to the goal (a shift divided by the arm's size, a turn), its length,
% and how it changes with the joints divided by their units; given joints stand still if they are held.
[jacobian, pose] = see(a, q);
jacobian = jacobian .* a.unit;
jacobian(1:3, :, :) = jacobian(1:3, :, :)/a.size;
if is_held
    jacobian(:, a.given, :) = 0;
end
missed = zeros(size(q, 1), 6);
for k = 1:size(q, 1)
    missed(k, 1:3) = (goal(:, 4) - pose(1:3, 4, k)).'/a.size;
    [turn, jacobian(4:6, :, k)] = turned(goal, pose(1:3, 1:3, k), jacobian(4:6, :, k));
    missed(k, 4:6) = turn.';
end
distance = lengths(missed);
end

function motion = pull(jacobian, x, damping)
% The smallest motion of the joints that makes x: J' y with (J J' + damping) y = x.
motion = zeros(size(x, 1), size(jacobian, 2));
for k = 1:size(x, 1)
    [u, s, v] = svd(jacobian(:, :, k), 'econ');
    s = diag(s);
    motion(k, :) = (v*((u.'*x(k, :).') .* s./(s.^2 + damping(k)))).';
end
end

function [best, least] = corrected(a, goal, q, is_held, steps)
% Newton's method with the smallest motion; and how far the poses are from the goal in the end.
best = q;
least = Inf(size(q, 1), 1);
before = least;
rows = (1:size(q, 1)).';
for step = 0:steps
    [missed, distance, jacobian] = missing(a, goal, q(rows, :), is_held);
    is_better = distance < least(rows);
    best(rows(is_better), :) = q(rows(is_better), :);
    least(rows(is_better)) = distance(is_better);
    goes_on = isfinite(distance) & distance > 1e-15 & distance <= 1e3*least(rows);
    % Where roots come together an error falls by a quarter or more a step; what falls less in four leads
    % nowhere.
    if mod(step, 4) == 3
        goes_on = goes_on & distance < 0.7*before(rows);
        before(rows) = distance;
    end
    rows = rows(goes_on);
    if step == steps || isempty(rows)
        break;
    end
    damping = 1e-13 + 1e-3*min(1, distance(goes_on).^2);
    motion = pull(jacobian(:, :, goes_on), missed(goes_on, :), damping);
    largest = max(abs(motion), [], 2);
    q(rows, :) = q(rows, :) + a.unit .* motion .* (0.5./max(0.5, largest));
end
end

function [q, distance] = slid(a, goal, q, is_held, target)
% Moves configurations that have the pose, with the hand still, to where they are nearest to their
% targets; and how far they are then.
moves = ones(1, a.n);
if is_held
    moves(a.given) = 0;
end
target = target .* ones(size(q));
factor = ones(size(q, 1), 1);
rows = (1:size(q, 1)).';
for step = 1:40
    [~, ~, jacobian] = missing(a, goal, q(rows, :), is_held);
    left = moves .* way(a, q(rows, :), target(rows, :));
    seen = zeros(numel(rows), 6);
    for k = 1:numel(rows)
        seen(k, :) = (jacobian(:, :, k)*left(k, :).').';
    end
    along = left - pull(jacobian, seen, 1e-9*ones(numel(rows), 1));
    largest = max(abs(along), [], 2);
    goes_on = largest > 1e-8;
    rows = rows(goes_on);
    if isempty(rows)
        break;
    end
    along = along(goes_on, :);
    largest = largest(goes_on);
    before = lengths(left(goes_on, :));
    ahead = q(rows, :) + a.unit .* along .* (0.4*factor(rows)./max(0.4, largest));
    [trial, missed] = corrected(a, goal, ahead, is_held, 8);
    % What lies far from where the tangent leads is another solution.
    is_good = missed <= 1e-10 ...
        & apart(a, trial, ahead) <= 0.5*factor(rows).*min(largest, 0.4) ...
        & lengths(moves .* way(a, trial, target(rows, :))) < before;
    q(rows(is_good), :) = trial(is_good, :);
    factor(rows(is_good)) = min(1, 2*factor(rows(is_good)));
    factor(rows(~is_good)) = 0.25*factor(rows(~is_good));
    rows = rows(is_good | factor(rows) >= 1e-3);
    if isempty(rows)
        break;
    end
end
distance = apart(a, q, target);
end

function [kernels, least] = still(a, goal, q)
% For each configuration, directions in which the hand hardly moves, up to three, orthogonal to each other,
% a row each; and the smallest singular value of the Jacobian beside the largest. Joints that are given
% stand still.
[~, ~, jacobian] = missing(a, goal, q, true);
kernels = cell(size(q, 1), 1);
least = zeros(size(q, 1), 1);
for k = 1:size(q, 1)
    own = jacobian(:, a.free, k);
    square = own.'*own;
    [v, d] = eig((square + square.')/2);
    [d, order] = sort(diag(d));
    d = max(d, 0)/max(d(end), 1e-300);
    count = min(3, sum(d <= 1e-8));
    kernels{k} = zeros(count, a.n);
    kernels{k}(:, a.free) = v(:, order(1:count)).';
    least(k) = min(1, sqrt(d(1)));
end
end

function mixed = mixtures(kernel)
% The sums and differences of directions: unit vectors, one of those that are opposite to each other.
parts = zeros(0, size(kernel, 1));
for number = 0:3^size(kernel, 1) - 1
    part = mod(floor(number./3.^(0:size(kernel, 1) - 1)), 3) - 1;
    first = part(find(part, 1));
    if ~isempty(first) && first == 1
        parts(end + 1, :) = part; %#ok<AGROW>
    end
end
mixed = parts*kernel;
mixed = mixed./lengths(mixed);
end

function found = followed(a, goal, q, directions)
% Of directions in which the hand hardly moves those that the arm takes with its hand still, as it takes
% them. Another solution nearby is as far away whatever the step.
by = [0.02, 0.009, 0.004, 1e-4, -0.02, -0.009, -0.004, -1e-4];
found = zeros(0, a.n);
count = size(directions, 1);
start = zeros(0, a.n);
for k = 1:count
    start = [start; q + a.unit .* (by.'*directions(k, :))]; %#ok<AGROW>
end
if count == 0
    return;
end
[moved, missed] = corrected(a, goal, start, true, 40);
parts = (moved - q)./a.unit;
distance = reshape(lengths(parts), 8, count);
missed = reshape(missed, 8, count);
is_step = missed <= 1e-10 & distance >= 0.5*abs(by).' & distance <= 1.5*abs(by).';
for k = 1:count
    if all(is_step(1:4, k))
        found(end + 1, :) = parts(8*k - 4, :)/distance(4, k); %#ok<AGROW>
    elseif all(is_step(5:8, k))
        found(end + 1, :) = -parts(8*k, :)/distance(8, k); %#ok<AGROW>
    end
end
end

function [dimension, motion] = family(a, goal, q, kernel)
% In how many directions the joints can move with the hand still, and one of them.
motions = followed(a, goal, q, kernel);
dimension = size(motions, 1);
if dimension == 0 && size(kernel, 1) > 1
    % A curve need not leave along one of the directions that were chosen.
    motions = followed(a, goal, q, mixtures(kernel));
    dimension = min(1, size(motions, 1));
end
motion = [motions; zeros(1, a.n)];
motion = motion(1, :);
end

function q = aside(a, goal, own, by)
% A member of a family: the one that is known, or another, some way along its motion or against it.
q = own.q;
if by ~= 0
    q = slid(a, goal, q, true, q + by*a.unit.*own.motion);
end
end

function are = are_members(a, goal, own, q)
% Whether configurations are members of the family of a solution.
are = false(size(q, 1), 1);
for by = a.aside
    % Half a turn away the shorter way of each joint need not be that of the family: start from
    % elsewhere, too.
    rows = find(~are);
    if ~isempty(rows)
        start = aside(a, goal, own, by) .* ones(numel(rows), a.n);
        [~, distance] = slid(a, goal, start, true, q(rows, :));
        are(rows) = distance <= 1e-4;
    end
end
end

function is_there = meet(a, goal, own, q, least, close, is_there)
% Which configurations are there, if one is: it is theirs, or they are members of its family.
is_there = is_there | apart(a, own.q, q) <= close;
rows = find(~is_there & least < a.flat);
if own.dimension > 0 && ~isempty(rows)
    is_there(rows) = are_members(a, goal, own, q(rows, :));
end
end

function known = add(a, goal, known, found)
% Adds configurations that have the pose, unless they are there, or a family of which they are members, as
% far as there is room.
if isempty(found)
    return;
end
q = wrapped(a, vertcat(found.q));
[kernels, least] = still(a, goal, q);
% Where it is flat, a configuration is known to what is missing divided by the slope.
close = min(1e-3, 1e-6 + 10*vertcat(found.residual)./max(least, 1e-12));
is_there = false(numel(found), 1);
for k = 1:numel(known)
    is_there = meet(a, goal, known(k), q, least, close, is_there);
end
for k = 1:numel(found)
    if is_there(k)
        continue;
    end
    own = found(k);
    own.q = q(k, :);
    [own.dimension, own.motion] = family(a, goal, own.q, kernels{k});
    if own.dimension > 0 && ~isempty(known)
        % What is known already may be a member of it.
        others = vertcat(known.q);
        [~, beside] = still(a, goal, others);
        flat = find(beside < a.flat);
        if ~isempty(flat)
            known(flat(are_members(a, goal, own, others(flat, :)))) = [];
        end
    end
    if numel(known) < a.most
        known(end + 1, 1) = own; %#ok<AGROW>
        is_there = meet(a, goal, own, q, least, close, is_there);
    end
end
end

function s = solutions_of(q, residual, multiplicity, branch)
% A struct a row.
s = struct('q', {}, 'residual', {}, 'multiplicity', {}, 'branch', {}, 'dimension', {}, 'motion', {});
for k = 1:size(q, 1)
    s(k, 1) = struct('q', q(k, :), 'residual', residual(k), 'multiplicity', multiplicity(k), ...
        'branch', branch(k), 'dimension', 0, 'motion', zeros(1, size(q, 2)));
end
s = reshape(s, [], 1);
end

function [solutions, is_all] = listed(a, goal, given)
% What @name@_solve lists, and whether that is all.
parameters = a.parameters; %#ok<NASGU>
[q, info] = @name@_solve([@flatten@]@solve_parameters@);
solutions = solutions_of(q, info.residual, info.multiplicity, @branch@);
is_all = strcmp(info.certificate, 'complete');
end

function beside = neighbours(a, goal, known)
% Poses beside the goal: those of configurations beside ones that are listed@or_twist@.
distance = [3e-3, 3e-4, 3e-5];
beside = cell(0, 1);
for number = 0:a.neighbours - 1
    far = distance(mod(number, 3) + 1);
    if isempty(known)
@twist@
    end
    by = sin(1 + 2.4*(a.n*number + (0:a.n - 1)));
    by(a.given) = 0;
    [~, pose] = see(a, known(mod(number, numel(known)) + 1).q + far*by.*a.unit);
    beside{end + 1, 1} = pose(1:3, :); %#ok<AGROW>
end
end

function known = led(a, goal, known, starts, steps)
% Adds the solutions to which Newton's method leads from configurations.
if ~isempty(starts)
    [q, missed] = corrected(a, goal, starts, true, steps);
    is_good = missed <= 1e-12;
    count = sum(is_good);
    found = solutions_of(q(is_good, :), missed(is_good), ones(count, 1), -ones(count, 1));
    known = add(a, goal, known, found);
end
end

function [known, status] = singular(a, goal, given, first)
% Singular poses: what @name@_solve lists is made precise, families are found, and solutions that it does not
% see there are followed from poses beside it.
precise = first;
for k = 1:numel(precise)
    if precise(k).residual > 1e-12
        [q, missed] = corrected(a, goal, precise(k).q, true, 8);
        if missed <= precise(k).residual && apart(a, q, precise(k).q) <= 0.01
            precise(k).q = q;
            precise(k).residual = missed;
        end
    end
end
known = add(a, goal, solutions_of(zeros(0, a.n), [], [], []), precise);
starts = zeros(0, a.n);
beside = neighbours(a, goal, first);
for k = 1:numel(beside)
    other = listed(a, beside{k}, given);
    starts = [starts; vertcat(other.q)]; %#ok<AGROW>
end
known = led(a, goal, known, starts, 20);
% Where the arm hardly moves its hand, and no motion with the hand still is seen, several may cross: what lies
% farther along is on one of them, or is another solution.
k = 1;
while k <= numel(known)
    if known(k).dimension == 0
        q = known(k).q;
        kernels = still(a, goal, q);
        % Along one direction there is nothing to cross.
        ways = zeros(0, a.n);
        if size(kernels{1}, 1) > 1
            ways = 0.3*a.unit.*mixtures(kernels{1});
        end
        starts = zeros(0, a.n);
        for m = 1:size(ways, 1)
            starts = [starts; q + ways(m, :); q - ways(m, :)]; %#ok<AGROW>
        end
        known = led(a, goal, known, starts, 40);
    end
    k = k + 1;
end
status = 'undecided';
if any([known.dimension] > 0)
    status = 'family';
end
end

function are = are_numbers(parameters)
% Whether no parameter is infinite or none.
is_wrong = @(x) isnumeric(x) && ~all(isfinite(x(:)));
are = ~isstruct(parameters) || ~any(cellfun(is_wrong, struct2cell(parameters)));
end

function result = all_solutions(a, pose, given)
[status, goal, off] = wanted(a, pose);
result = struct('status', status, 'off', off, 'q', zeros(0, a.n), 'solutions', ...
    solutions_of(zeros(0, a.n), [], [], []));
if ~all(isfinite(given)) || ~are_numbers(a.parameters)
    result.status = 'not finite';
end
if ~strcmp(result.status, 'solved')
    return;
end@rounded@
[known, is_all] = listed(a, @solve_goal@, given);
if ~is_all
    [known, result.status] = singular(a, goal, given, known);
elseif isempty(known)
    result.status = 'no solution';
end
result.solutions = known;
result.q = [zeros(0, a.n); vertcat(known.q)];
end

