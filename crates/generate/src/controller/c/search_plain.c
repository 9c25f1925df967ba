    {
        @name@_ik_result found;
        status = @name@_ik(pose@parameters_passed@, &found);
        for (int s = 0; s < found.count; s++) {
            double q[ANSWER_JOINTS];
            memcpy(q, found.solutions[s].q, sizeof q);
            answer_offer(own, previous, q, &best);
            if (found.solutions[s].dimension > 0) {
                (void)answer_slide(goal, q@parameters_passed@, 1, previous);
                answer_offer(own, previous, q, &best);
            }
        }
    }