% From where the arm is, with the smallest motion.
[start, missed] = corrected(a, goal, previous, false, 20);
is_reached = missed <= 1e-10;
if is_reached
    best = offer(a, limits, previous, slid(a, goal, start, false, previous), best);
end
for sample = 0:@samples@ - 1
    if best(1).distance <= 0.1
        break;
    end
    found = all_solutions(a, pose, spread(a, limits, previous, sample));
    if ~isempty(found.q)
        best = offer(a, limits, previous, found.q, best);
        best = offer(a, limits, previous, slid(a, goal, found.q, false, previous), best);
        is_reached = true;
    end
end
if ~is_reached
    choice.status = 'undecided';
end
