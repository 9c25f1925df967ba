
/* The rotation nearest to that of a pose, and how far it was away; less than 0 if it is nowhere near one. */
static double answer_nearest_rotation(double r[4][4])
{
    double before[3][3];
    double off = 0.0;
    for (int i = 0; i < 3; i++) {
        memcpy(before[i], r[i], sizeof before[i]);
    }
    for (int step = 0; step < 8; step++) {
        double product[3][3];
        double next[3][3];
        double defect = 0.0;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                product[i][j] = (i == j ? 1.0 : 0.0)
                    - (r[0][i] * r[0][j] + r[1][i] * r[1][j] + r[2][i] * r[2][j]);
                defect = fmax(defect, fabs(product[i][j]));
            }
        }
        if (!(defect <= 0.5)) {
            return -1.0;
        }
        if (defect <= 4e-16) {
            break;
        }
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                next[i][j] = r[i][j]
                    + 0.5 * (r[i][0] * product[0][j] + r[i][1] * product[1][j] + r[i][2] * product[2][j]);
            }
        }
        for (int i = 0; i < 3; i++) {
            memcpy(r[i], next[i], sizeof next[i]);
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            off = fmax(off, fabs(r[i][j] - before[i][j]));
        }
    }
    if (!(r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1])
            - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0])
            + r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]) > 0.0)) {
        return -1.0;
    }
    return off;
}

/* Reads a pose, and brings its rotation to the nearest one. */
static @name@_ik_status answer_goal(double pose[4][4], double goal[4][4], double *off)
{
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            goal[i][j] = i < 3 ? pose[i][j] : (j == 3 ? 1.0 : 0.0);
        }
    }
    if (!answer_is_finite(goal[0], 4) || !answer_is_finite(goal[1], 4) || !answer_is_finite(goal[2], 4)) {
        return @NAME@_IK_NOT_FINITE;
    }
    *off = answer_nearest_rotation(goal);
    if (*off < 0.0) {
        *off = HUGE_VAL;
    }
    return *off <= @NAME@_IK_ROTATION_TOLERANCE ? @NAME@_IK_SOLVED : @NAME@_IK_NOT_A_ROTATION;
}

/* The turn from the rotation of a pose (the last 16 of `both`) to that of the goal, along the axes of the
   base (rad). */
static void answer_turn(double goal[4][4], const double *pose, double turn[3])
{
    double e[3][3];
    double length, angle;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            e[i][j] = goal[i][0] * pose[4 * j] + goal[i][1] * pose[4 * j + 1] + goal[i][2] * pose[4 * j + 2];
        }
    }
    turn[0] = 0.5 * (e[2][1] - e[1][2]);
    turn[1] = 0.5 * (e[0][2] - e[2][0]);
    turn[2] = 0.5 * (e[1][0] - e[0][1]);
    length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    angle = atan2(length, 0.5 * (e[0][0] + e[1][1] + e[2][2] - 1.0));
    if (length > 1e-7) {
        for (int i = 0; i < 3; i++) {
            turn[i] *= angle / length;
        }
    } else if (angle > 1.0) {
        /* Half a turn: the axis is the longest column of e + 1. */
        int k = 0;
        for (int i = 1; i < 3; i++) {
            k = e[i][i] > e[k][k] ? i : k;
        }
        for (int i = 0; i < 3; i++) {
            turn[i] = e[i][k] + (i == k ? 1.0 : 0.0);
        }
        length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
        for (int i = 0; i < 3; i++) {
            turn[i] *= angle / length;
        }
    }
}

/* What is missing in rotation, whose rows of the Jacobian stay as they are. */
static void answer_turned(
    double goal[4][4], const double *pose, double turn[3], double jacobian[3][ANSWER_JOINTS])
{
    (void)jacobian;
    answer_turn(goal, pose, turn);
}
