found = all_solutions(a, pose, []);
choice.status = found.status;
for k = 1:numel(found.solutions)
    q = found.solutions(k).q;
    best = offer(a, limits, previous, q, best);
    if found.solutions(k).dimension > 0
        best = offer(a, limits, previous, slid(a, goal, q, true, previous), best);
    end
end
