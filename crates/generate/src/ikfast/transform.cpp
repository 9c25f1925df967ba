static void read_goal(const IkReal *eetrans, const IkReal *eerot, double *goal)
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            goal[4 * i + k] = static_cast<double>(eerot[3 * i + k]);
        }
        goal[4 * i + 3] = static_cast<double>(eetrans[i]);
    }
}

static void write_goal(double pose[4][4], IkReal *eetrans, IkReal *eerot)
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            eerot[3 * i + k] = static_cast<IkReal>(pose[i][k]);
        }
        eetrans[i] = static_cast<IkReal>(pose[i][3]);
    }
}
