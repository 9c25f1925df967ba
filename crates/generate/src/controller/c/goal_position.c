
/* Reads the position of a pose. */
static @name@_ik_status answer_goal(double pose[4][4], double goal[4][4], double *off)
{
    *off = 0.0;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            goal[i][j] = i == j ? 1.0 : 0.0;
        }
    }
    for (int i = 0; i < 3; i++) {
        goal[i][3] = pose[i][3];
        if (!answer_is_finite(&goal[i][3], 1)) {
            return @NAME@_IK_NOT_FINITE;
        }
    }
    return @NAME@_IK_SOLVED;
}

/* The rotation is not looked at. */
static void answer_turned(
    double goal[4][4], const double *pose, double turn[3], double jacobian[3][ANSWER_JOINTS])
{
    (void)goal;
    (void)pose;
    for (int i = 0; i < 3; i++) {
        turn[i] = 0.0;
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            jacobian[i][j] = 0.0;
        }
    }
}
