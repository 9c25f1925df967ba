
/*
 * From samples on the circle to a trigonometric polynomial, and all its complex roots.
 */

/* The polynomial through the samples, the largest of them 1; 0 if they are of no use. */
static NOINLINE int ik_fit(
    ik_work *work, int degree, int count, const double *transform, const double *samples)
{
    double top = 0.0;
    double sums[IK_WIDE_SAMPLES];
    double noise = 0.0;
    for (int k = 0; k < count; k++) {
        top = fabs(samples[k]) > top ? fabs(samples[k]) : top;
        sums[k] = 0.0;
    }
    if (!(top > 1e-250 && top < 1e250)) {
        return 0;
    }
    for (int node = 0; node < count; node++) {
        for (int k = 0; k < count; k++) {
            sums[k] = IK_ADD(transform[node * count + k], samples[node], sums[k]);
        }
    }
    work->degree = degree;
    work->re[0] = sums[0] / top;
    work->im[0] = 0.0;
    for (int k = 1; k <= degree; k++) {
        work->re[k] = sums[k] / top;
        work->im[k] = sums[degree + k] / top;
    }
    for (int k = 2 * degree + 1; k < count; k++) {
        noise += (sums[k] / top) * (sums[k] / top);
    }
    work->noise = sqrt(noise);
    return work->noise <= 1e-5;
}

/* What the discs allow for. */
INLINE double ik_noise(const ik_work *work)
{
    return 4.0 * work->noise > 2e-14 ? 4.0 * work->noise : 2e-14;
}

/* max(1, |z|^n) from |z|^2 */
INLINE void ik_growth(const double *RESTRICT modulus, int degree, double *RESTRICT out)
{
    for (int l = 0; l < IK_LANES; l++) {
        out[l] = modulus[l];
    }
    for (int k = 1; k < degree; k++) {
        for (int l = 0; l < IK_LANES; l++) {
            out[l] *= modulus[l];
        }
    }
    for (int l = 0; l < IK_LANES; l++) {
        out[l] = out[l] > 1.0 ? out[l] : 1.0;
    }
}

/* Aberth's step for eight of the roots; the square of the largest relative one. */
static double ik_step(
    const ik_work *work, const double *re, const double *im, int degree, int from,
    const double *RESTRICT live, double *RESTRICT next_x, double *RESTRICT next_y)
{
    const int count = 2 * degree;
    const double *x = work->x + from;
    const double *y = work->y + from;
    double pr[IK_LANES], pi[IK_LANES], dr[IK_LANES], di[IK_LANES];
    double sr[IK_LANES], si[IK_LANES], modulus[IK_LANES], scale[IK_LANES], step[IK_LANES];
    double largest = 0.0;
    for (int l = 0; l < IK_LANES; l++) {
        pr[l] = re[count];
        pi[l] = im[count];
        dr[l] = di[l] = sr[l] = si[l] = 0.0;
        modulus[l] = IK_ADD(y[l], y[l], x[l] * x[l]);
    }
    for (int k = count - 1; k >= 0; k--) {
        for (int l = 0; l < IK_LANES; l++) {
            /* P' <- P' z + P, P <- P z + c */
            const double d = IK_ADD(dr[l], x[l], IK_ADD(-di[l], y[l], pr[l]));
            const double p = IK_ADD(pr[l], x[l], IK_ADD(-pi[l], y[l], re[k]));
            di[l] = IK_ADD(dr[l], y[l], IK_ADD(di[l], x[l], pi[l]));
            pi[l] = IK_ADD(pr[l], y[l], IK_ADD(pi[l], x[l], im[k]));
            dr[l] = d;
            pr[l] = p;
        }
    }
    for (int k = 0; k < count; k++) {
        const double u = work->x[k];
        const double v = work->y[k];
        for (int l = 0; l < IK_LANES; l++) {
            const double dx = x[l] - u;
            const double dy = y[l] - v;
            const double square = IK_ADD(dy, dy, dx * dx);
            const double quotient = 1.0 / square;
            const double inverse = square == 0.0 ? 0.0 : quotient;
            sr[l] = IK_ADD(dx, inverse, sr[l]);
            si[l] = IK_ADD(-dy, inverse, si[l]);
        }
    }
    ik_growth(modulus, degree, scale);
    for (int l = 0; l < IK_LANES; l++) {
        /* P / (P' - P S); none where P is at its rounding error */
        const double er = IK_ADD(pi[l], si[l], IK_ADD(-pr[l], sr[l], dr[l]));
        const double ei = IK_ADD(-pi[l], sr[l], IK_ADD(-pr[l], si[l], di[l]));
        const double square = IK_ADD(ei, ei, er * er);
        const double quotient = 1.0 / square;
        const double inverse = square == 0.0 ? 0.0 : quotient;
        const double value = IK_ADD(pi[l], pi[l], pr[l] * pr[l]);
        const double least = scale[l] * 1e-16;
        const double go = value < least * least ? 0.0 : live[l];
        const double across = IK_ADD(pi[l], ei, pr[l] * er) * inverse;
        const double along = IK_ADD(-pr[l], ei, pi[l] * er) * inverse;
        const double step_x = go == 0.0 ? 0.0 : across;
        const double step_y = go == 0.0 ? 0.0 : along;
        next_x[l] = x[l] - step_x;
        next_y[l] = y[l] - step_y;
        step[l] = IK_ADD(step_y, step_y, step_x * step_x) / modulus[l];
    }
    for (int l = 0; l < IK_LANES; l++) {
        largest = step[l] > largest ? step[l] : largest;
    }
    return largest;
}

/* Upper bounds of the distances from the true roots (Smith 1970). */
static void ik_bound(
    ik_work *work, const double *re, const double *im, int degree, double noise, int from)
{
    const int count = 2 * degree;
    const double *x = work->x + from;
    const double *y = work->y + from;
    const double leading = re[count] * re[count] + im[count] * im[count];
    double pr[IK_LANES], pi[IK_LANES], product[IK_LANES], modulus[IK_LANES], scale[IK_LANES];
    for (int l = 0; l < IK_LANES; l++) {
        pr[l] = re[count];
        pi[l] = im[count];
        product[l] = leading;
        modulus[l] = IK_ADD(y[l], y[l], x[l] * x[l]);
    }
    for (int k = count - 1; k >= 0; k--) {
        for (int l = 0; l < IK_LANES; l++) {
            const double p = IK_ADD(pr[l], x[l], IK_ADD(-pi[l], y[l], re[k]));
            pi[l] = IK_ADD(pr[l], y[l], IK_ADD(pi[l], x[l], im[k]));
            pr[l] = p;
        }
    }
    for (int k = 0; k < count; k++) {
        double factor[IK_LANES];
        for (int l = 0; l < IK_LANES; l++) {
            const double dx = x[l] - work->x[k];
            const double dy = y[l] - work->y[k];
            const double square = IK_ADD(dy, dy, dx * dx);
            factor[l] = square > 1e-30 ? square : 1e-30;
        }
        if (k >= from && k < from + IK_LANES) {
            factor[k - from] = 1.0;
        }
        for (int l = 0; l < IK_LANES; l++) {
            product[l] *= factor[l];
        }
    }
    ik_growth(modulus, degree, scale);
    for (int l = 0; l < IK_LANES; l++) {
        const double value = sqrt(IK_ADD(pi[l], pi[l], pr[l] * pr[l]));
        work->radius[from + l] = IK_ADD(scale[l], noise, value) * count / sqrt(product[l]);
    }
}

/* All roots at once (Aberth 1973, Ehrlich 1967); not inlined, so that compilers make one copy of it. */
static NOINLINE void ik_find_roots(ik_work *work)
{
    const int room = work->degree == IK_DEGREE ? IK_ROOTS : IK_WIDE_ROOTS;
    double re[2 * IK_WIDE_DEGREE + 1], im[2 * IK_WIDE_DEGREE + 1];
    double live[IK_WIDE_ROOTS], next_x[IK_WIDE_ROOTS], next_y[IK_WIDE_ROOTS];
    int degree = work->degree;
    while (degree > 0
           && work->re[degree] * work->re[degree] + work->im[degree] * work->im[degree] < 1e-28) {
        degree--;
    }
    const int count = 2 * degree;
    work->roots = count;
    if (count == 0) {
        return;
    }
    for (int k = 0; k <= degree; k++) {
        re[degree + k] = re[degree - k] = work->re[k];
        im[degree + k] = work->im[k];
        im[degree - k] = -work->im[k];
    }
    for (int k = 0; k < room; k++) {
        const double angle = IK_TURN * (k + 0.3) / count;
        const double radius = k % 2 == 0 ? 1.05 : 1.0 / 1.05;
        const int exists = k < count;
        const int is_known = room == IK_ROOTS && count == IK_ROOTS;
        const double c = is_known ? ik_start[k][0] : cos(angle);
        const double s = is_known ? ik_start[k][1] : sin(angle);
        work->x[k] = exists ? radius * c : 1e30;
        work->y[k] = exists ? radius * s : 1e30 * (k + 1);
        live[k] = exists ? 1.0 : 0.0;
    }
    for (int turn = 0; turn < 40; turn++) {
        double largest = 0.0;
        for (int from = 0; from < room; from += IK_LANES) {
            const double step =
                ik_step(work, re, im, degree, from, live + from, next_x + from, next_y + from);
            largest = step > largest ? step : largest;
        }
        memcpy(work->x, next_x, (size_t)room * sizeof *next_x);
        memcpy(work->y, next_y, (size_t)room * sizeof *next_y);
        if (largest < 1e-22) {
            break;
        }
    }
    for (int from = 0; from < room; from += IK_LANES) {
        ik_bound(work, re, im, degree, ik_noise(work), from);
    }
}
