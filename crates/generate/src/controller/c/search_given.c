/* Offers what is known to have the goal's pose; the status of that. */
static NOINLINE @name@_ik_status answer_search(
    double pose[4][4],
    double goal[4][4],
    const double *previous,
    const @name@_ik_limits *own,@parameters_local@
    answer_best *best)
{
    double q[ANSWER_JOINTS], start[ANSWER_STARTS][ANSWER_JOINTS], away[ANSWER_STARTS];
    int starts = 0;
    int is_reached = 0;
    int is_all;
    (void)pose;
    /* From where the arm is, with the smallest motion. */
    memcpy(q, previous, sizeof q);
    if (answer_correct(goal, q@parameters_passed@, 0, 20) <= 1e-10) {
        (void)answer_slide(goal, q@parameters_passed@, 0, previous);
        answer_offer(own, previous, q, best);
        if (!(best->distance[0] < HUGE_VAL)) {
            answer_settle(goal, q@parameters_passed@, 0, previous, own, best);
        }
        is_reached = 1;
    }
    for (int sample = 0; sample < ANSWER_SAMPLES && !(best->distance[0] <= 0.1); sample++) {
        @name@_solve_solution found[@NAME@_SOLVE_MAX];
        double given[ANSWER_GIVEN];
        answer_spread(own, previous, sample, given);
        const int count = answer_list(goal, given@parameters_passed@, found, &is_all);
        for (int s = 0; s < count; s++) {
            double apart = answer_apart(previous, found[s].@solve_result@);
            int place = starts < ANSWER_STARTS ? starts++ : ANSWER_STARTS;
            answer_offer(own, previous, found[s].@solve_result@, best);
            is_reached = 1;
            /* The nearest few, in order. */
            while (place > 0 && apart < away[place - 1]) {
                if (place < ANSWER_STARTS) {
                    away[place] = away[place - 1];
                    memcpy(start[place], start[place - 1], sizeof start[place]);
                }
                place--;
            }
            if (place < ANSWER_STARTS) {
                away[place] = apart;
                memcpy(start[place], found[s].@solve_result@, sizeof start[place]);
            }
        }
    }
    for (int k = 0; k < starts; k++) {
        double q_k[ANSWER_JOINTS];
        const double before = best->distance[0];
        memcpy(q_k, start[k], sizeof q_k);
        (void)answer_slide(goal, q_k@parameters_passed@, 0, previous);
        answer_offer(own, previous, q_k, best);
        /* Where that is not within the limits, or no nearer: from the start once more, within them. */
        if (!(best->distance[0] < before)) {
            answer_settle(goal, start[k]@parameters_passed@, 0, previous, own, best);
        }
    }
    /* By descent from configurations within the limits. */
    for (int k = 0; k < ANSWER_DESCENTS && !(best->distance[0] < HUGE_VAL); k++) {
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double half = answer_period[j] > 0.0 ? 0.5 * answer_period[j] : answer_size;
            const double lower = fmax(own->lower[j], fmin(previous[j], own->upper[j]) - half);
            const double upper = fmin(own->upper[j], fmax(previous[j], own->lower[j]) + half);
            const double x = k * (0.6180339887498949 + 0.1 * j);
            q[j] = k == 0 ? previous[j] : lower + (upper - lower) * (x - floor(x));
        }
        answer_approach(goal, own, q@parameters_passed@);
        if (answer_correct(goal, q@parameters_passed@, 0, 20) <= 1e-10) {
            answer_settle(goal, q@parameters_passed@, 0, previous, own, best);
            is_reached = 1;
        }
    }
    return is_reached ? @NAME@_IK_SOLVED : @NAME@_IK_UNDECIDED;
}
