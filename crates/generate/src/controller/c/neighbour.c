
/* A pose beside the goal: that of a configuration beside one that is listed@or_twist@. 0 if there
   is none. */
static NOINLINE int answer_neighbour(
    double goal[4][4]@parameters_given@, double listed[][ANSWER_JOINTS], int count, int number, double beside[4][4])
{
    double both[6 * ANSWER_JOINTS + 16];
    double q[ANSWER_JOINTS];
    static const double distance[3] = {3e-3, 3e-4, 3e-5};
    const double far = distance[number % 3];
    if (count == 0) {
@twist@
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        const double by = answer_is_given[j] ? 0.0 : far * sin(1.0 + 2.4 * (ANSWER_JOINTS * number + j));
        q[j] = listed[number % count][j] + by * answer_unit[j];
    }
    answer_see(q@parameters_passed@, both);
    for (int k = 0; k < 16; k++) {
        beside[k / 4][k % 4] = both[6 * ANSWER_JOINTS + k];
    }
    (void)goal;
    return 1;
}
