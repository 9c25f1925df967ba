function [limits, are_limits] = read_limits(a, limits)
% Limits without those that are too far to be some; and whether they allow any value.
far = a.far*a.unit;
are_limits = all(limits.lower <= limits.upper & limits.lower <= far & limits.upper >= -far);
limits.lower(limits.lower < -far) = -Inf;
limits.upper(limits.upper > far) = Inf;
end

function q = clamped(limits, q)
q = min(max(q, limits.lower), limits.upper);
end

function [q, is_allowed] = nearest_copy(a, limits, previous, q)
% The values nearest to the previous ones among those whole turns away and within the limits; and which
% joints have one.
lower = limits.lower - 1e-9*a.unit;
upper = limits.upper + 1e-9*a.unit;
q = q + turns(previous - q, a.window);
k = a.window > 0 & q > upper;
q(k) = q(k) - a.window(k).*ceil((q(k) - upper(k))./a.window(k));
k = a.window > 0 & ~k & q < lower;
q(k) = q(k) + a.window(k).*ceil((lower(k) - q(k))./a.window(k));
is_allowed = q >= lower & q <= upper;
inside = clamped(limits, q);
q(is_allowed) = inside(is_allowed);
end

function best = offer(a, limits, previous, q, best)
% Keeps the nearest of configurations, moved by whole turns: best(1) within the limits, best(2) wherever.
for k = 1:size(q, 1)
    for copy = a.copies.'
        [own, is_allowed] = nearest_copy(a, limits, previous, q(k, :) + copy.');
        is_within = all(is_allowed);
        if ~is_within
            own = previous + a.unit.*way(a, previous, own);
        end
        distance = max(abs(own - previous)./a.unit);
        for kind = 2 - is_within:2
            if distance < best(kind).distance
                best(kind) = struct('q', own, 'distance', distance);
            end
        end
    end
end
end

function best = settle(a, goal, start, is_held, limits, previous, best)
% Moves a configuration that has the pose, with the hand still, first until its joints are within the
% limits, then to where it is nearest to the previous one there; joints at a limit stay while they would
% leave it. Offers what it comes by.
target = clamped(limits, previous);
[q, is_allowed] = nearest_copy(a, limits, previous, start);
beside = target + a.unit.*way(a, target, q);
q(~is_allowed) = beside(~is_allowed);
left_out = @(q) sum(abs(clamped(limits, q) - q)./a.unit);
factor = 1;
for step = 1:60
    [~, ~, jacobian] = missing(a, goal, q, is_held);
    outside = left_out(q);
    is_outside = outside > 1e-10;
    direction = (target - q)./a.unit;
    if is_outside
        direction = (clamped(limits, q) - q)./a.unit;
    end
    moves = true(1, a.n);
    moves(a.given) = ~is_held;
    is_changed = true;
    while is_changed
        jacobian(:, ~moves) = 0;
        direction(~moves) = 0;
        motion = (direction - pull(jacobian, (jacobian*direction.').', 1e-9)).*moves;
        % They would leave their limits: they stay, and the others do what they can.
        leaves = (motion > 1e-9 & abs(q - limits.upper) <= 1e-9*a.unit) ...
            | (motion < -1e-9 & abs(q - limits.lower) <= 1e-9*a.unit);
        moves = moves & ~leaves;
        is_changed = any(leaves);
    end
    largest = max(abs(motion));
    if ~(largest > 1e-11)
        break;
    end
    by = 0.4/largest;
    if is_outside
        % As far as what is outside comes inside, not just as far along as it is away.
        whole = sum(direction.^2);
        by = min(by, min(whole/max(sum(direction.*motion), 0.01*whole), 100));
    else
        by = min(by, 1);
    end
    % No farther than to the next limit.
    room = q - limits.lower;
    room(motion > 0) = limits.upper(motion > 0) - q(motion > 0);
    k = room > 0 & motion ~= 0;
    by = min([factor*by, room(k)./(abs(motion(k)).*a.unit(k))]);
    ahead = q + by*a.unit.*motion;
    [trial, missed] = corrected(a, goal, ahead, is_held, 8);
    after = left_out(trial);
    is_better = after < outside;
    if ~is_outside
        is_better = norm((target - trial)./a.unit) < norm((target - q)./a.unit) && after <= 0.1*by*largest;
    end
    if is_better && missed <= 1e-10 && apart(a, trial, ahead) <= 0.5*by*largest
        q = trial;
        factor = min(1, 2*factor);
        if after <= 1e-9
            best = offer(a, limits, previous, q, best);
        end
    else
        factor = 0.25*factor;
        if factor < 1e-3
            break;
        end
    end
end
best = offer(a, limits, previous, q, best);
end

function q = approached(a, goal, limits, q)
% Descends from a configuration to where the hand comes close to the goal, within the limits.
damping = 1e-2;
q = clamped(limits, q);
[missed, distance, jacobian] = missing(a, goal, q, false);
for step = 1:200
    if ~(distance > 1e-12 && damping < 1e8)
        break;
    end
    motion = pull(jacobian, missed, damping);
    trial = clamped(limits, q + a.unit.*min(max(motion, -0.5), 0.5));
    [trial_missed, trial_distance, trial_jacobian] = missing(a, goal, trial, false);
    if trial_distance < distance
        by = apart(a, trial, q);
        q = trial;
        missed = trial_missed;
        distance = trial_distance;
        jacobian = trial_jacobian;
        damping = max(0.2*damping, 1e-12);
        if by < 1e-12
            break;
        end
    else
        damping = 8*damping;
    end
end
end
@spread@
function choice = nearest(a, pose, previous, limits)
[status, goal, off] = wanted(a, pose);
choice = struct('status', status, 'is_found', false, 'q', previous, 'distance', Inf, 'off', off, ...
    'missed_shift', Inf, 'missed_turn', Inf);
[limits, are_limits] = read_limits(a, limits);
if ~are_limits || ~all(abs(previous) <= a.far*a.unit) || ~are_numbers(a.parameters)
    choice.status = 'not finite';
end
if ~strcmp(choice.status, 'solved')
    return;
end
best = repmat(struct('q', previous, 'distance', Inf), 2, 1);
@search@
if best(1).distance < Inf
    choice.is_found = true;
    choice.q = best(1).q;
    choice.distance = best(1).distance;
elseif best(2).distance < Inf
    choice.q = best(2).q;
    choice.distance = best(2).distance;
    choice.status = 'outside limits';
else
    choice.q = approached(a, goal, limits, previous);
    choice.distance = max(abs(choice.q - previous)./a.unit);
end
missed = missing(a, goal, choice.q, false);
choice.missed_shift = a.size*norm(missed(1:3));
choice.missed_turn = norm(missed(4:6));
end

function q = member_within(a, goal, own, limits)
% A member of a family within limits, if moving one that is known leads to it.
best = repmat(struct('q', own.q, 'distance', Inf), 2, 1);
for by = a.aside
    if best(1).distance == Inf
        best = settle(a, goal, aside(a, goal, own, by), true, limits, own.q, best);
    end
end
q = best(1).q;
end

function list = copies_within(a, limits, value)
% For each joint the copies of a value within the limits, as counts of whole turns.
list = cell(1, a.n);
for j = 1:a.n
    lower = limits.lower(j) - 1e-9*a.unit(j);
    upper = limits.upper(j) + 1e-9*a.unit(j);
    period = a.window(j);
    if ~(period > 0)
        list{j} = zeros(1, value(j) >= lower && value(j) <= upper);
    elseif lower == -Inf && upper == Inf
        % Without a limit on a side: a turn in all.
        list{j} = 0;
    else
        if lower == -Inf
            lower = upper - period;
        elseif upper == Inf
            upper = lower + period;
        end
        first = ceil((lower - value(j))/period);
        last = floor((upper - value(j))/period);
        list{j} = first:min(last, first + a.most_copies - 1);
    end
end
end

function [status, q] = all_within(a, pose, given, limits)
q = zeros(0, a.n);
status = 'not finite';
[limits, are_limits] = read_limits(a, limits);
if ~are_limits
    return;
end
found = all_solutions(a, pose, given);
status = found.status;
[~, goal] = wanted(a, pose);
for s = 1:size(found.q, 1)
    own = found.solutions(s);
    is_there = @(copy) ~any(cellfun(@isempty, copies_within(a, limits, own.q + copy)));
    if own.dimension > 0 && ~any(cellfun(is_there, num2cell(a.copies, 2)))
        % Another member of the family may be within the limits.
        own.q = member_within(a, goal, own, limits);
    end
    for copy = a.copies.'
        base = own.q + copy.';
        counts = copies_within(a, limits, base);
        sizes = cellfun(@numel, counts);
        % The first joint turns fastest.
        many = max(min(prod(sizes), a.most_copies - size(q, 1)), min(1, prod(sizes)));
        rows = zeros(many, a.n);
        index = (0:many - 1).';
        for j = 1:a.n
            if many > 0
                rows(:, j) = counts{j}(mod(index, sizes(j)) + 1);
                index = floor(index/sizes(j));
            end
        end
        q = [q; clamped(limits, base + rows.*a.window)]; %#ok<AGROW>
    end
end
if isempty(q) && ~isempty(found.q)
    status = 'outside limits';
end
end
