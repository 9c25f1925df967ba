
/*
 * What may belong to the roots: completed, polished, and kept if it reaches the pose and is new.
 */

/* Configurations that may have the pose, waiting until there are enough to be polished side by side. */
typedef struct ik_batch {
    const ik_split *split;
    const ik_rigid *goal;
    ik_work *work;
    int count;
    ik_values values;
} ik_batch;

/* Puts a configuration behind those that are found, unless it is there: 1 if it is new. */
static int ik_add(ik_work *work, const ik_values *values, int lane, double residual)
{
    double axes[6];
    for (int i = 0; i < 6; i++) {
        const double c = values->v[i][0][lane];
        axes[i] = ik_slides[i] ? c : atan2(values->v[i][1][lane], c);
    }
    for (int n = 0; n < work->count; n++) {
        double apart = 0.0;
        for (int i = 0; i < 6; i++) {
            const double known = work->found[n].q[i];
            const double by = fabs(known - axes[i]);
            const double turn = by > 0.5 * IK_TURN ? IK_TURN - by : by;
            const double away = ik_slides[i] ? by / (1.0 + fabs(known)) : turn;
            apart = away > apart ? away : apart;
        }
        if (apart < 1e-6) {
            return 0;
        }
    }
    if (work->count == @NAME@_SOLVE_MAX) {
        work->is_over = 1;
        return 0;
    }
    memcpy(work->found[work->count].q, axes, sizeof axes);
    work->found[work->count++].residual = residual;
    return 1;
}

/* Polishes the configurations that wait, and keeps those that reach the pose and are new. */
static NOINLINE void ik_flush(ik_batch *batch)
{
    ik_work *work = batch->work;
    const int before = work->count;
    int lane[IK_FEW] = {0};
    double residual[IK_FEW];
    if (batch->count == 0) {
        return;
    }
    for (int l = batch->count; l < IK_FEW; l++) {
        for (int i = 0; i < 6; i++) {
            batch->values.v[i][0][l] = batch->values.v[i][0][0];
            batch->values.v[i][1][l] = batch->values.v[i][1][0];
        }
    }
    ik_polish(batch->goal, &batch->values, residual);
    for (int l = 0; l < batch->count; l++) {
        if (residual[l] <= 1e-10 && ik_add(work, &batch->values, l, residual[l])) {
            lane[work->count - 1 - before] = l;
        }
    }
    if (work->count > before) {
        double singular[IK_FEW];
        ik_singular_values(&batch->values, singular);
        for (int n = before; n < work->count; n++) {
            const double own = singular[lane[n - before]];
            work->found[n].singular = own < HUGE_VAL ? own : 0.0;
        }
    }
    batch->count = 0;
}

/* Takes what may be a solution: a value of the hidden joint and a null vector there. */
static NOINLINE void ik_offer(ik_batch *batch, const double hidden[2], const double *x)
{
    const ik_eliminated *e = &batch->work->eliminated;
    const int branches = e->is_open ? 2 : 1;
    for (int branch = 0; branch < branches; branch++) {
        double own[6][2];
        ik_complete(batch->split, e, branch == 0 ? 1.0 : -1.0, hidden, x, own);
        for (int i = 0; i < 6; i++) {
            batch->values.v[i][0][batch->count] = own[i][0];
            batch->values.v[i][1][batch->count] = own[i][1];
        }
        batch->count++;
        if (batch->count == IK_FEW) {
            ik_flush(batch);
        }
    }
}

/* Null vectors at the first of some values of the hidden joint, and how small the pivots are. */
INLINE void ik_nulls_at(
    const ik_eliminated *e, int slides, double near[][2], int count, double x[IK_UNKNOWNS][IK_FEW],
    double small[IK_FEW])
{
    double c[IK_FEW], s[IK_FEW];
    for (int l = 0; l < IK_FEW; l++) {
        c[l] = near[l < count ? l : count - 1][0];
        s[l] = near[l < count ? l : count - 1][1];
    }
    ik_null_vectors(e, slides, c, s, x, small);
}

/* Drops the middles that are no shared roots, and the roots beside a middle that is one; how many are left. */
static NOINLINE int ik_without_parts(
    const ik_eliminated *e, int slides, double near[IK_NEARBY][2],
    const unsigned char is_middle[IK_NEARBY], int count)
{
    unsigned char is_shared[IK_NEARBY] = {0};
    unsigned char is_left[IK_NEARBY];
    int left = 0;
    for (int k = 0; k < count; k++) {
        if (is_middle[k]) {
            double x[IK_UNKNOWNS][IK_FEW], small[IK_FEW];
            ik_nulls_at(e, slides, near + k, 1, x, small);
            is_shared[k] = !(small[0] > 1e-5);
        }
    }
    for (int k = 0; k < count; k++) {
        int is_kept = !is_middle[k] || is_shared[k];
        for (int j = 0; j < count && !is_middle[k]; j++) {
            const double away = fabs(near[j][0] - near[k][0]) + fabs(near[j][1] - near[k][1]);
            is_kept = is_kept && !(is_shared[j] && away < 6e-4);
        }
        is_left[k] = (unsigned char)is_kept;
    }
    for (int k = 0; k < count; k++) {
        if (is_left[k]) {
            near[left][0] = near[k][0];
            near[left][1] = near[k][1];
            left++;
        }
    }
    return left;
}

/* The roots near the circle as cosines and sines of the hidden joint, with the middles of those that are
   close together (marked): a root that several configurations share falls apart by the root of
   the noise, its middle does not. */
static NOINLINE int ik_near_roots(
    const ik_work *work, int slides, const ik_chart *chart, double near[IK_NEARBY][2])
{
    unsigned char is_middle[IK_NEARBY];
    int has_middles = 0;
    int count = 0;
    for (int k = 0; k < work->roots; k++) {
        const double modulus = sqrt(work->x[k] * work->x[k] + work->y[k] * work->y[k]);
        const double x = work->x[k] / modulus;
        const double y = work->y[k] / modulus;
        double middle[2] = {0.0, 0.0};
        if (!(fabs(modulus - 1.0) < 0.02 && ik_answers_for(chart, x + 0.1))) {
            continue;
        }
        for (int j = 0; j < count; j++) {
            if (fabs(x - near[j][0]) + fabs(y - near[j][1]) < 3e-4) {
                const double c = x + near[j][0];
                const double s = y + near[j][1];
                const double length = sqrt(c * c + s * s);
                middle[0] = c / length;
                middle[1] = s / length;
            }
        }
        near[count][0] = x;
        near[count][1] = y;
        is_middle[count++] = 0;
        if (middle[0] != 0.0 || middle[1] != 0.0) {
            near[count][0] = middle[0];
            near[count][1] = middle[1];
            is_middle[count++] = 1;
            has_middles = 1;
        }
    }
    for (int k = 0; k < count; k++) {
        double pair[2];
        ik_outside(chart, near[k][0], near[k][1], pair);
        near[k][0] = pair[0];
        near[k][1] = pair[1];
    }
    return has_middles ? ik_without_parts(&work->eliminated, slides, near, is_middle, count) : count;
}

/* Takes all null vectors at a value that solutions share. */
static NOINLINE void ik_offer_shared(ik_batch *batch, int slides, const double hidden[2])
{
    double all[IK_SHARED][IK_UNKNOWNS];
    const int count = ik_shared(&batch->work->eliminated, slides, hidden[0], hidden[1], all);
    for (int n = 0; n < count; n++) {
        ik_offer(batch, hidden, all[n]);
    }
}

/* Offers the null vectors at the roots. */
static NOINLINE void ik_narrow_candidates(const ik_chart *chart, ik_batch *batch)
{
    const ik_eliminated *e = &batch->work->eliminated;
    const int slides = ik_multiplied_slides(batch->split);
    double near[IK_NEARBY][2];
    const int count = ik_near_roots(batch->work, slides, chart, near);
    for (int from = 0; from < count; from += IK_FEW) {
        double x[IK_UNKNOWNS][IK_FEW], small[IK_FEW];
        ik_nulls_at(e, slides, near + from, count - from, x, small);
        for (int l = 0; l < IK_FEW && from + l < count; l++) {
            double own[IK_UNKNOWNS];
            for (int k = 0; k < IK_UNKNOWNS; k++) {
                own[k] = x[k][l];
            }
            ik_offer(batch, near[from + l], own);
            if (!(small[l] > 1e-5)) {
                ik_offer_shared(batch, slides, near[from + l]);
            }
        }
    }
}

/* The polynomial of a chart; 0 if the samples are of no use. */
static NOINLINE int ik_narrow_samples(
    const ik_split *split, const ik_chart *chart, ik_work *work)
{
    const int slides = ik_multiplied_slides(split);
    double samples[IK_SAMPLES];
    for (int from = 0; from < IK_SAMPLES; from += IK_LANES) {
        double c[IK_LANES], s[IK_LANES], weight[IK_LANES];
        ik_nodes(chart, ik_cosines + from, ik_sines + from, c, s, weight);
        ik_determinant(&work->eliminated, slides, c, s, samples + from);
        for (int l = 0; l < IK_LANES; l++) {
            const double square = weight[l] * weight[l];
            samples[from + l] *= square * square * square * square;
        }
    }
    return ik_fit(work, IK_DEGREE, IK_SAMPLES, &ik_transform[0][0], samples);
}
