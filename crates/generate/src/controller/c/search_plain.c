/* Offers what is known to have the goal's pose; the status of that. */
static NOINLINE @name@_ik_status answer_search(
    double pose[4][4],
    double goal[4][4],
    const double *previous,
    const @name@_ik_limits *own,@parameters_local@
    answer_best *best)
{
    @name@_ik_result found;
    const @name@_ik_status status = @name@_ik(pose@parameters_passed@, &found);
    for (int s = 0; s < found.count; s++) {
        double q[ANSWER_JOINTS];
        memcpy(q, found.solutions[s].q, sizeof q);
        answer_offer(own, previous, q, best);
        if (found.solutions[s].dimension > 0) {
            const double before = best->distance[0];
            (void)answer_slide(goal, q@parameters_passed@, 1, previous);
            answer_offer(own, previous, q, best);
            /* Where the nearest member is not within the limits, another is. */
            for (int start = 0; start < 3 && !(best->distance[0] < before); start++) {
                answer_aside(goal, &found.solutions[s], start@parameters_passed@, q);
                answer_settle(goal, q@parameters_passed@, 1, previous, own, best);
            }
        }
    }
    return status;
}
