% From where the arm is, with the smallest motion.
[start, missed] = corrected(a, goal, previous, false, 20);
is_reached = missed <= 1e-10;
if is_reached
    best = offer(a, limits, previous, slid(a, goal, start, false, previous), best);
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
if ~isempty(starts)
    % From the nearest few.
    [~, order] = sort(apart(a, previous, starts));
    starts = starts(order(1:min(6, end)), :);
    best = offer(a, limits, previous, slid(a, goal, starts, false, previous), best);
end
if ~is_reached
    choice.status = 'undecided';
end
