    {
        double q[ANSWER_JOINTS], start[ANSWER_STARTS][ANSWER_JOINTS], away[ANSWER_STARTS];
        int starts = 0;
        int is_reached = 0;
        /* From where the arm is, with the smallest motion. */
        memcpy(q, previous, sizeof q);
        if (answer_correct(goal, q@parameters_passed@, 0, 20) <= 1e-10) {
            (void)answer_slide(goal, q@parameters_passed@, 0, previous);
            answer_offer(own, previous, q, &best);
            is_reached = 1;
        }
        for (int sample = 0; sample < ANSWER_SAMPLES && !(best.distance[0] <= 0.1); sample++) {
            @name@_ik_result found;
            double given[ANSWER_GIVEN];
            answer_spread(own, previous, sample, given);
            found.count = 0;
            (void)answer_solve(goal, given@parameters_passed@, &found);
            for (int s = 0; s < found.count; s++) {
                double apart = answer_apart(previous, found.solutions[s].q);
                int place = starts < ANSWER_STARTS ? starts++ : ANSWER_STARTS;
                answer_offer(own, previous, found.solutions[s].q, &best);
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
                    memcpy(start[place], found.solutions[s].q, sizeof start[place]);
                }
            }
        }
        for (int k = 0; k < starts; k++) {
            (void)answer_slide(goal, start[k]@parameters_passed@, 0, previous);
            answer_offer(own, previous, start[k], &best);
        }
        status = is_reached ? @NAME@_IK_SOLVED : @NAME@_IK_UNDECIDED;
    }