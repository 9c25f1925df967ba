
enum {
    /* Joints that are given, and how many of their values are tried. */
    ANSWER_GIVEN = @given_count@,
    ANSWER_SAMPLES = @samples@,
    /* Solutions from which the arm is moved with its hand still. */
    ANSWER_STARTS = 6,
    /* Configurations from which the hand descends to the pose where nothing else is found within the limits. */
    ANSWER_DESCENTS = 24
};

/* Values of the given joints: the previous ones first, then spread over what the limits allow. */
static void answer_spread(
    const @name@_ik_limits *limits, const double *previous, int sample, double given[ANSWER_GIVEN])
{
    static const int joint[ANSWER_GIVEN] = @given@;
    for (int k = 0; k < ANSWER_GIVEN; k++) {
        const int j = joint[k];
        const double half = answer_period[j] > 0.0 ? 0.5 * answer_period[j] : answer_size;
        const double lower = fmax(limits->lower[j], fmin(previous[j], limits->upper[j]) - half);
        const double upper = fmin(limits->upper[j], fmax(previous[j], limits->lower[j]) + half);
        /* Multiples of the golden ratio and of its like, modulo 1. */
        const double x = sample * (k == 0 ? 0.6180339887498949 : 0.7548776662466927 / k);
        given[k] = sample == 0 ? fmin(fmax(previous[j], limits->lower[j]), limits->upper[j])
                               : lower + (upper - lower) * (x - floor(x));
    }
}
