% From where the arm is, with the smallest motion.
[start, missed] = corrected(a, goal, previous, false, 20);
is_reached = missed <= 1e-10;
if is_reached
    best = offer(a, limits, previous, slid(a, goal, start, false, previous), best);
    if best(1).distance == Inf
        best = settle(a, goal, start, false, limits, previous, best);
    end
end
starts = zeros(0, a.n);
for sample = 0:@samples@ - 1
    if best(1).distance <= 0.1
        break;
    end
    found = listed(a, goal, spread(a, limits, previous, sample));
    if ~isempty(found)
        best = offer(a, limits, previous, vertcat(found.q), best);
        starts = [starts; vertcat(found.q)]; %#ok<AGROW>
        is_reached = true;
    end
end
% From the nearest few.
[~, order] = sort(apart(a, previous, starts));
for start = starts(order(1:min(6, end)), :).'
    least = best(1).distance;
    best = offer(a, limits, previous, slid(a, goal, start.', false, previous), best);
    % Where that is not within the limits, or no nearer: from the start once more, within them.
    if ~(best(1).distance < least)
        best = settle(a, goal, start.', false, limits, previous, best);
    end
end
% By descent from configurations within the limits.
[lower, upper] = around(a, limits, previous);
for k = 0:23
    if best(1).distance < Inf
        break;
    end
    part = k*(0.6180339887498949 + 0.1*(0:a.n - 1));
    start = previous;
    if k > 0
        start = lower + (upper - lower).*(part - floor(part));
    end
    [start, missed] = corrected(a, goal, approached(a, goal, limits, start), false, 20);
    if missed <= 1e-10
        best = settle(a, goal, start, false, limits, previous, best);
        is_reached = true;
    end
end
if ~is_reached
    choice.status = 'undecided';
end
