    {
        double q[ANSWER_JOINTS];
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
            (void)@name@_ik(pose, given@parameters_passed@, &found);
            for (int s = 0; s < found.count; s++) {
                memcpy(q, found.solutions[s].q, sizeof q);
                answer_offer(own, previous, q, &best);
                (void)answer_slide(goal, q@parameters_passed@, 0, previous);
                answer_offer(own, previous, q, &best);
                is_reached = 1;
            }
        }
        status = is_reached ? @NAME@_IK_SOLVED : @NAME@_IK_UNDECIDED;
    }