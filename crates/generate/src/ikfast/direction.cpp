/* The direction may have any length but 0. */
static void read_goal(const IkReal *eetrans, const IkReal *eerot, double *goal)
{
    double direction[3];
    double size = 0.0;
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        direction[i] = static_cast<double>(eerot[i]);
        size = fmax(size, fabs(direction[i]));
    }
    for (int i = 0; i < 3; i++) {
        direction[i] /= size;
        square += direction[i] * direction[i];
    }
    for (int i = 0; i < 3; i++) {
        goal[2 * i] = direction[i] / sqrt(square);
        goal[2 * i + 1] = static_cast<double>(eetrans[i]);
    }
}

static void write_goal(double pose[4][4], IkReal *eetrans, IkReal *eerot)
{
    for (int i = 0; i < 3; i++) {
        eerot[i] = static_cast<IkReal>(pose[i][2]);
        eetrans[i] = static_cast<IkReal>(pose[i][3]);
    }
}
