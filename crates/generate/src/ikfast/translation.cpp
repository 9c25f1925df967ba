/* There is no rotation: it may be NULL. */
static void read_goal(const IkReal *eetrans, const IkReal * /* eerot */, double *goal)
{
    for (int i = 0; i < 3; i++) {
        goal[i] = static_cast<double>(eetrans[i]);
    }
}

static void write_goal(double pose[4][4], IkReal *eetrans, IkReal * /* eerot */)
{
    for (int i = 0; i < 3; i++) {
        eetrans[i] = static_cast<IkReal>(pose[i][3]);
    }
}
