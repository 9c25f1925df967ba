
/* Beyond this a value of a joint, divided by its unit, is none: turns are rounded there until the hand is elsewhere. */
static const double answer_far = 1e6;

/* Reads limits (NULL: those of the robot): what is beyond answer_far is none. 0 if they exclude all values. */
static int answer_limits(const @name@_ik_limits *limits, @name@_ik_limits *own)
{
    const @name@_ik_limits *given = limits ? limits : &@name@_limits;
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        const double far = answer_far * answer_unit[j];
        const double lower = given->lower[j];
        const double upper = given->upper[j];
        if (!(lower <= upper && lower <= far && upper >= -far)) {
            return 0;
        }
        own->lower[j] = lower >= -far ? lower : -HUGE_VAL;
        own->upper[j] = upper <= far ? upper : HUGE_VAL;
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
    if (!(*value >= lower && *value <= upper)) {
        return 0;
    }
    *value = fmin(fmax(*value, limits->lower[joint]), limits->upper[joint]);
    return 1;
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

/* Moves a configuration that has the pose, with the hand still, first until its joints are within the limits, then to where it is
   nearest to the previous one there; joints at a limit stay while they would leave it. Offers what it comes by. */
static NOINLINE void answer_settle(
    double goal[4][4], const double *start@parameters_given@, int is_held, const double *previous,
    const @name@_ik_limits *limits, answer_best *best)
{
    double q[ANSWER_JOINTS];
    double size = 1.0;
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        q[j] = start[j];
        if (!answer_nearest_copy(limits, j, previous[j], &q[j])) {
            const double middle = fmin(fmax(previous[j], limits->lower[j]), limits->upper[j]);
            q[j] = middle + answer_unit[j] * answer_way(j, middle, q[j]);
        }
    }
    for (int step = 0; step < 60 && size >= 1e-3; step++) {
        double error[ANSWER_ROWS], seen[ANSWER_ROWS], way[ANSWER_JOINTS], motion[ANSWER_JOINTS];
        double jacobian[ANSWER_ROWS][ANSWER_JOINTS];
        double trial[ANSWER_JOINTS], ahead[ANSWER_JOINTS];
        double outside[2] = {0.0, 0.0}, away[2] = {0.0, 0.0};
        double largest = 0.0, gain = 1.0, by;
        int is_fixed[ANSWER_JOINTS] = {0};
        int is_changed = 1;
        (void)answer_error(goal, q@parameters_passed@, is_held, error, jacobian);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double inside = fmin(fmax(q[j], limits->lower[j]), limits->upper[j]);
            outside[0] += fabs(inside - q[j]) / answer_unit[j];
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double inside = fmin(fmax(q[j], limits->lower[j]), limits->upper[j]);
            const double wanted = fmin(fmax(previous[j], limits->lower[j]), limits->upper[j]);
            way[j] = ((outside[0] > 1e-10 ? inside : wanted) - q[j]) / answer_unit[j];
            away[0] += (wanted - q[j]) / answer_unit[j] * ((wanted - q[j]) / answer_unit[j]);
            way[j] = is_held && answer_is_given[j] ? 0.0 : way[j];
        }
        while (is_changed) {
            for (int i = 0; i < ANSWER_ROWS; i++) {
                seen[i] = 0.0;
                for (int j = 0; j < ANSWER_JOINTS; j++) {
                    seen[i] += jacobian[i][j] * way[j];
                }
            }
            answer_pull(jacobian, seen, 1e-9, motion);
            is_changed = 0;
            largest = 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                const double near = 1e-9 * answer_unit[j];
                motion[j] = way[j] - motion[j];
                if (!is_fixed[j]
                    && ((motion[j] > 1e-9 && fabs(q[j] - limits->upper[j]) <= near)
                        || (motion[j] < -1e-9 && fabs(q[j] - limits->lower[j]) <= near))) {
                    /* It would leave its limits: it stays, and the others do what they can. */
                    for (int i = 0; i < ANSWER_ROWS; i++) {
                        jacobian[i][j] = 0.0;
                    }
                    way[j] = 0.0;
                    is_fixed[j] = 1;
                    is_changed = 1;
                }
                largest = fmax(largest, fabs(motion[j]));
            }
        }
        if (!(largest > 1e-11)) {
            break;
        }
        if (outside[0] > 1e-10) {
            /* As far as what is outside comes inside, not just as far along as it is away. */
            double whole = 0.0, part = 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                whole += way[j] * way[j];
                part += way[j] * motion[j];
            }
            gain = fmin(whole / fmax(part, 0.01 * whole), 100.0);
        }
        by = size * fmin(gain, 0.4 / largest);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            /* No farther than to the next limit. */
            const double room = motion[j] > 0.0 ? limits->upper[j] - q[j] : q[j] - limits->lower[j];
            const double need = fabs(motion[j]) * answer_unit[j];
            if (room > 0.0 && by * need > room) {
                by = room / need;
            }
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            trial[j] = q[j] + by * answer_unit[j] * motion[j];
        }
        memcpy(ahead, trial, sizeof ahead);
        if (answer_correct(goal, trial@parameters_passed@, is_held, 8) <= 1e-10
            && answer_apart(trial, ahead) <= 0.5 * by * largest) {
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                const double inside = fmin(fmax(trial[j], limits->lower[j]), limits->upper[j]);
                const double wanted = fmin(fmax(previous[j], limits->lower[j]), limits->upper[j]);
                outside[1] += fabs(inside - trial[j]) / answer_unit[j];
                away[1] += (wanted - trial[j]) / answer_unit[j] * ((wanted - trial[j]) / answer_unit[j]);
            }
            if (outside[0] > 1e-10 ? outside[1] < outside[0]
                                   : away[1] < away[0] && outside[1] <= 0.1 * by * largest) {
                memcpy(q, trial, sizeof trial);
                size = fmin(1.0, 2.0 * size);
                if (outside[1] <= 1e-9) {
                    answer_offer(limits, previous, q, best);
                }
                continue;
            }
        }
        size *= 0.25;
    }
    answer_offer(limits, previous, q, best);
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
    double goal[4][4], from[ANSWER_JOINTS];
    answer_best best;
    @name@_ik_limits own;
    @name@_ik_status status;
    best.distance[0] = HUGE_VAL;
    best.distance[1] = HUGE_VAL;
    /* The caller's previous configuration may be the q that is written. */
    memcpy(from, previous, sizeof from);
    memmove(choice->q, from, sizeof choice->q);
    choice->is_found = 0;
    choice->distance = HUGE_VAL;
    choice->off = 0.0;
    choice->missed_shift = HUGE_VAL;
    choice->missed_turn = HUGE_VAL;
    status = answer_goal(pose, goal, &choice->off);@parameters_check@
    if (!answer_limits(limits, &own)) {
        status = @NAME@_IK_NOT_FINITE;
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        if (!(fabs(from[j]) <= answer_far * answer_unit[j])) {
            status = @NAME@_IK_NOT_FINITE;
        }
    }
    if (status != @NAME@_IK_SOLVED) {
        return status;
    }
    choice->distance = 0.0;
    status = answer_search(pose, goal, from, &own@parameters_passed@, &best);
    if (best.distance[0] < HUGE_VAL) {
        choice->is_found = 1;
        choice->distance = best.distance[0];
        memcpy(choice->q, best.q[0], sizeof choice->q);
    } else if (best.distance[1] < HUGE_VAL) {
        choice->distance = best.distance[1];
        memcpy(choice->q, best.q[1], sizeof choice->q);
        status = @NAME@_IK_OUTSIDE_LIMITS;
    } else {
        answer_approach(goal, &own, choice->q@parameters_passed@);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double by = fabs(choice->q[j] - from[j]) / answer_unit[j];
            choice->distance = fmax(choice->distance, by);
        }
    }
    answer_missed(goal, choice->q@parameters_passed@, &choice->missed_shift, &choice->missed_turn);
    return status;
}

/* Moves a member of a family until it is within the limits; 0 if that does not succeed. */
static NOINLINE int answer_member_within(
    double pose[4][4], @name@_ik_solution *member, const @name@_ik_limits *limits@parameters_given@)
{
    double goal[4][4], off;
    answer_best best;
    best.distance[0] = HUGE_VAL;
    best.distance[1] = HUGE_VAL;
    if (answer_goal(pose, goal, &off) != @NAME@_IK_SOLVED) {
        return 0;
    }
    for (int start = 0; start < 3 && !(best.distance[0] < HUGE_VAL); start++) {
        answer_aside(goal, member, start@parameters_passed@, best.q[1]);
        answer_settle(goal, best.q[1]@parameters_passed@, 1, member->q, limits, &best);
    }
    if (!(best.distance[0] < HUGE_VAL)) {
        return 0;
    }
    memcpy(member->q, best.q[0], sizeof member->q);
    return 1;
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
    @name@_ik_limits own;
    const @name@_ik_status status = answer_limits(limits, &own)
        ? @name@_ik(pose@given_passed@@parameters_passed@, &found)
        : @NAME@_IK_NOT_FINITE;
    double all = 0.0;
    *count = 0;
    if (status > @NAME@_IK_UNDECIDED) {
        return status;
    }
    for (int s = 0; s < found.count; s++) {
        const double before = all;
        for (int round = 0; round < 2; round++) {
            for (int copy = 0; copy < ANSWER_COPIES; copy++) {
                double base[ANSWER_JOINTS], turns[ANSWER_JOINTS];
                double first[ANSWER_JOINTS] = {0.0}, last[ANSWER_JOINTS] = {0.0};
                double copies = 1.0;
                int is_more = 1;
                for (int j = 0; j < ANSWER_JOINTS; j++) {
                    base[j] = found.solutions[s].q[j] + answer_copies[copy][j];
                    is_more = is_more && answer_copies_within(&own, j, base[j], &first[j], &last[j]);
                    copies *= is_more ? last[j] - first[j] + 1.0 : 0.0;
                }
                all += copies;
                if (is_more) {
                    memcpy(turns, first, sizeof turns);
                }
                while (is_more && *count < room) {
                    int j = 0;
                    for (int k = 0; k < ANSWER_JOINTS; k++) {
                        const double value = base[k] + turns[k] * answer_window[k];
                        q[*count][k] = fmin(fmax(value, own.lower[k]), own.upper[k]);
                    }
                    (*count)++;
                    /* The next combination. */
                    while (j < ANSWER_JOINTS && turns[j] >= last[j]) {
                        turns[j] = first[j];
                        j++;
                    }
                    is_more = j < ANSWER_JOINTS;
                    if (is_more) {
                        turns[j] += 1.0;
                    }
                }
            }
            if (round == 0 && (all > before || found.solutions[s].dimension == 0)) {
                break;
            }
            /* Another member of the family may be within the limits. */
            if (round == 0 && !answer_member_within(pose, &found.solutions[s], &own@parameters_passed@)) {
                break;
            }
        }
    }
    *count = all < 2147483647.0 ? (int)all : 2147483647;
    return all <= 0.0 && found.count > 0 ? @NAME@_IK_OUTSIDE_LIMITS : status;
}
