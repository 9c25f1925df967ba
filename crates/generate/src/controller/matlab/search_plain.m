found = all_solutions(a, pose, []);
choice.status = found.status;
for own = found.solutions.'
    best = offer(a, limits, previous, own.q, best);
    if own.dimension > 0
        least = best(1).distance;
        best = offer(a, limits, previous, slid(a, goal, own.q, true, previous), best);
        % Where the nearest member is not within the limits, another is.
        for by = a.aside
            if ~(best(1).distance < least)
                best = settle(a, goal, aside(a, goal, own, by), true, limits, previous, best);
            end
        end
    end
end
