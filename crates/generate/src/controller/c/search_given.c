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
        is_reached = 1;
    }
    for (int sample = 0; sample < ANSWER_SAMPLES && !(best->distance[0] <= 0.1); sample++) {
        @name@_solve_solution found[@NAME@_SOLVE_MAX];
        double given[ANSWER_GIVEN];
        answer_spread(own, previous, sample, given);
        const int count = answer_list(goal, given@parameters_passed@, found, &is_all);
        for (int s = 0; s < count; s++) {
            double apart = answer_apart(previous, found[s].q);
            int place = starts < ANSWER_STARTS ? starts++ : ANSWER_STARTS;
            answer_offer(own, previous, found[s].q, best);
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
                memcpy(start[place], found[s].q, sizeof start[place]);
            }
        }
    }
    for (int k = 0; k < starts; k++) {
        (void)answer_slide(goal, start[k]@parameters_passed@, 0, previous);
        answer_offer(own, previous, start[k], best);
    }
    return is_reached ? @NAME@_IK_SOLVED : @NAME@_IK_UNDECIDED;
}
