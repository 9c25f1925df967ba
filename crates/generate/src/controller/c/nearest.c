
/* Whether limits are limits: infinite ones stand for none. */
static int answer_are_limits(const @name@_ik_limits *limits)
{
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        if (!(limits->lower[j] <= limits->upper[j])) {
            return 0;
        }
    }
    return 1;
}

/* The value of a joint that is nearest to x among those whole turns away and within the limits; 0 if there is none. */
static int answer_nearest_copy(const @name@_ik_limits *limits, int joint, double x, double *value)
{
    const double slack = 1e-9 * answer_unit[joint];
    const double lower = limits->lower[joint] - slack;
    const double upper = limits->upper[joint] + slack;
    const double period = answer_window[joint];
    if (period > 0.0) {
        *value += period * floor((x - *value) / period + 0.5);
        if (*value > upper) {
            *value -= period * ceil((*value - upper) / period);
        } else if (*value < lower) {
            *value += period * ceil((lower - *value) / period);
        }
    }
    return *value >= lower && *value <= upper;
}

/* What is known of the nearest configuration. */
typedef struct answer_best {
    double q[2][ANSWER_JOINTS];
    double distance[2];
} answer_best;

/* Keeps a configuration if it is the nearest one: [0] within the limits, [1] wherever. */
static void answer_offer(
    const @name@_ik_limits *limits, const double *previous, const double *q, answer_best *best)
{
    for (int copy = 0; copy < ANSWER_COPIES; copy++) {
        double own[ANSWER_JOINTS];
        double distance = 0.0;
        int is_within = 1;
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            own[j] = q[j] + answer_copies[copy][j];
            is_within &= answer_nearest_copy(limits, j, previous[j], &own[j]);
        }
        if (!is_within) {
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                own[j] = previous[j] + answer_unit[j] * answer_way(j, previous[j], own[j]);
            }
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            distance = fmax(distance, fabs(own[j] - previous[j]) / answer_unit[j]);
        }
        for (int kind = is_within ? 0 : 1; kind < 2; kind++) {
            if (distance < best->distance[kind]) {
                best->distance[kind] = distance;
                memcpy(best->q[kind], own, sizeof own);
            }
        }
    }
}

/* Descends from a configuration to where the hand comes close to the goal, within the limits. */
static NOINLINE void answer_approach(
    double goal[4][4], const @name@_ik_limits *limits, double *q@parameters_given@)
{
    double error[ANSWER_ROWS], motion[ANSWER_JOINTS];
    double jacobian[ANSWER_ROWS][ANSWER_JOINTS];
    double damping = 1e-2;
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        q[j] = fmin(fmax(q[j], limits->lower[j]), limits->upper[j]);
    }
    for (int step = 0; step < 200 && damping < 1e8; step++) {
        const double length = answer_error(goal, q@parameters_passed@, 0, error, jacobian);
        double trial[ANSWER_JOINTS], unused[ANSWER_ROWS];
        double beside[ANSWER_ROWS][ANSWER_JOINTS];
        if (length <= 1e-12) {
            break;
        }
        answer_pull(jacobian, error, damping, motion);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            trial[j] = q[j] + answer_unit[j] * fmin(fmax(motion[j], -0.5), 0.5);
            trial[j] = fmin(fmax(trial[j], limits->lower[j]), limits->upper[j]);
        }
        if (answer_error(goal, trial@parameters_passed@, 0, unused, beside) < length) {
            const double by = answer_apart(trial, q);
            memcpy(q, trial, sizeof trial);
            damping = fmax(0.2 * damping, 1e-12);
            if (by < 1e-12) {
                break;
            }
        } else {
            damping *= 8.0;
        }
    }
}
@spread@
@search@
/* By how much a configuration misses the goal: a shift (m) and a turn (rad). */
static NOINLINE void answer_missed(
    double goal[4][4], const double *q@parameters_given@, double *shift, double *turn)
{
    double error[ANSWER_ROWS], jacobian[ANSWER_ROWS][ANSWER_JOINTS];
    (void)answer_error(goal, q@parameters_passed@, 0, error, jacobian);
    *shift = answer_size * sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2]);
    *turn = sqrt(error[3] * error[3] + error[4] * error[4] + error[5] * error[5]);
}

@name@_ik_status @name@_ik_nearest(
    double pose[4][4],
    const double previous[@n@],
    const @name@_ik_limits *limits,@parameters_declaration@
    @name@_ik_choice *choice)
{
    double goal[4][4];
    answer_best best;
    @name@_ik_status status;
    const @name@_ik_limits *own = limits ? limits : &@name@_limits;
    best.distance[0] = HUGE_VAL;
    best.distance[1] = HUGE_VAL;
    choice->is_found = 0;
    choice->distance = 0.0;
    choice->off = 0.0;
    choice->missed_shift = 0.0;
    choice->missed_turn = 0.0;
    memcpy(choice->q, previous, sizeof choice->q);
    status = answer_goal(pose, goal, &choice->off);
    if (!answer_is_finite(previous, ANSWER_JOINTS) || !answer_are_limits(own)) {
        status = @NAME@_IK_NOT_FINITE;
    }
    if (status != @NAME@_IK_SOLVED) {
        return status;
    }
    status = answer_search(pose, goal, previous, own@parameters_passed@, &best);
    if (best.distance[0] < HUGE_VAL) {
        choice->is_found = 1;
        choice->distance = best.distance[0];
        memcpy(choice->q, best.q[0], sizeof choice->q);
    } else if (best.distance[1] < HUGE_VAL) {
        choice->distance = best.distance[1];
        memcpy(choice->q, best.q[1], sizeof choice->q);
        status = @NAME@_IK_OUTSIDE_LIMITS;
    } else {
        answer_approach(goal, own, choice->q@parameters_passed@);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double by = fabs(choice->q[j] - previous[j]) / answer_unit[j];
            choice->distance = fmax(choice->distance, by);
        }
    }
    answer_missed(goal, choice->q@parameters_passed@, &choice->missed_shift, &choice->missed_turn);
    return status;
}

/* The first and the last copy of a value within the limits, as counts of whole turns; 0 if there is none. */
static int answer_copies_within(
    const @name@_ik_limits *limits, int joint, double value, double *first, double *last)
{
    const double slack = 1e-9 * answer_unit[joint];
    const double period = answer_window[joint];
    double lower = limits->lower[joint] - slack;
    double upper = limits->upper[joint] + slack;
    *first = 0.0;
    *last = 0.0;
    if (!(period > 0.0)) {
        return value >= lower && value <= upper;
    }
    /* Without a limit on a side: a turn in all. */
    if (!(lower > -HUGE_VAL) && !(upper < HUGE_VAL)) {
        return 1;
    }
    lower = lower > -HUGE_VAL ? lower : upper - period;
    upper = upper < HUGE_VAL ? upper : lower + period;
    *first = ceil((lower - value) / period);
    *last = floor((upper - value) / period);
    return *first <= *last;
}

@name@_ik_status @name@_ik_all_within_limits(
    double pose[4][4],@given_declaration@
    const @name@_ik_limits *limits,@parameters_declaration@
    int room,
    double (*q)[@n@],
    int *count)
{
    @name@_ik_result found;
    const @name@_ik_limits *own = limits ? limits : &@name@_limits;
    const @name@_ik_status status = answer_are_limits(own)
        ? @name@_ik(pose@given_passed@@parameters_passed@, &found)
        : @NAME@_IK_NOT_FINITE;
    *count = 0;
    if (status > @NAME@_IK_UNDECIDED) {
        return status;
    }
    for (int s = 0; s < found.count; s++) {
        for (int copy = 0; copy < ANSWER_COPIES; copy++) {
            double base[ANSWER_JOINTS], first[ANSWER_JOINTS], last[ANSWER_JOINTS], turns[ANSWER_JOINTS];
            int is_more = 1;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                base[j] = found.solutions[s].q[j] + answer_copies[copy][j];
                is_more = is_more && answer_copies_within(own, j, base[j], &first[j], &last[j]);
            }
            if (is_more) {
                memcpy(turns, first, sizeof turns);
            }
            while (is_more) {
                if (*count < room) {
                    for (int j = 0; j < ANSWER_JOINTS; j++) {
                        q[*count][j] = base[j] + turns[j] * answer_window[j];
                    }
                }
                (*count)++;
                /* The next combination. */
                int j = 0;
                while (j < ANSWER_JOINTS && turns[j] >= last[j]) {
                    turns[j] = first[j];
                    j++;
                }
                is_more = j < ANSWER_JOINTS && *count < 1000000;
                if (is_more) {
                    turns[j] += 1.0;
                }
            }
        }
    }
    return *count == 0 && found.count > 0 ? @NAME@_IK_OUTSIDE_LIMITS : status;
}
