
/* Reads position and z axis of a pose, and brings the axis to length 1. */
static @name@_ik_status answer_goal(double pose[4][4], double goal[4][4], double *off)
{
    double length = 0.0;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            goal[i][j] = i == j ? 1.0 : 0.0;
        }
    }
    for (int i = 0; i < 3; i++) {
        goal[i][2] = pose[i][2];
        goal[i][3] = pose[i][3];
        if (!answer_is_finite(&goal[i][2], 2)) {
            return @NAME@_IK_NOT_FINITE;
        }
        length += goal[i][2] * goal[i][2];
    }
    length = sqrt(length);
    *off = fabs(length - 1.0);
    if (!(*off <= @NAME@_IK_ROTATION_TOLERANCE)) {
        return @NAME@_IK_NOT_A_ROTATION;
    }
    for (int i = 0; i < 3; i++) {
        goal[i][2] /= length;
    }
    return @NAME@_IK_SOLVED;
}

/* The turn that brings the z axis to that of the goal by the shortest way; turns about the axis are not seen. */
static void answer_turned(
    double goal[4][4], const double *pose, double turn[3], double jacobian[3][ANSWER_JOINTS])
{
    const double z[3] = {pose[2], pose[6], pose[10]};
    const double wanted[3] = {goal[0][2], goal[1][2], goal[2][2]};
    double length, angle;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        turn[i] = z[j] * wanted[k] - z[k] * wanted[j];
    }
    length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    angle = atan2(length, z[0] * wanted[0] + z[1] * wanted[1] + z[2] * wanted[2]);
    if (length > 1e-7) {
        for (int i = 0; i < 3; i++) {
            turn[i] *= angle / length;
        }
    } else if (angle > 1.0) {
        /* Against it: about the axis of the base that is farthest from it, made orthogonal. */
        int k = 0;
        for (int i = 1; i < 3; i++) {
            k = fabs(z[i]) < fabs(z[k]) ? i : k;
        }
        length = sqrt(1.0 - z[k] * z[k]);
        for (int i = 0; i < 3; i++) {
            turn[i] = angle * ((i == k ? 1.0 : 0.0) - z[k] * z[i]) / length;
        }
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        const double along = z[0] * jacobian[0][j] + z[1] * jacobian[1][j] + z[2] * jacobian[2][j];
        for (int i = 0; i < 3; i++) {
            jacobian[i][j] -= along * z[i];
        }
    }
}
