/* The rotation at an angle of 0. */
static const double at_zero[3][3] = {@at_zero@};

static void read_goal(const IkReal *eetrans, const IkReal *eerot, double *goal)
{
    const double c = cos(static_cast<double>(eerot[0]));
    const double s = sin(static_cast<double>(eerot[0]));
    for (int k = 0; k < 3; k++) {
        goal[4 * @u@ + k] = at_zero[@u@][k];
        goal[4 * @v@ + k] = c * at_zero[@v@][k] - s * at_zero[@w@][k];
        goal[4 * @w@ + k] = s * at_zero[@v@][k] + c * at_zero[@w@][k];
        goal[4 * k + 3] = static_cast<double>(eetrans[k]);
    }
}

static void write_goal(double pose[4][4], IkReal *eetrans, IkReal *eerot)
{
    for (int i = 0; i < 3; i++) {
        eetrans[i] = static_cast<IkReal>(pose[i][3]);
    }
    eerot[0] = static_cast<IkReal>(atan2(pose[@w@][@v@], pose[@v@][@v@]));
}
