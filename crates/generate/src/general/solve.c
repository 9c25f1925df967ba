
/*
 * One split of the loop after the other, until one certifies that nothing is missing.
 */

/* Adds a configuration unless it is there; those for which there is no room are counted. */
static void ik_add(ik_work *work, double values[6][2], double residual)
{
    const int known = work->count < IK_FOUND ? work->count : IK_FOUND;
    for (int n = 0; n < known; n++) {
        double apart = 0.0;
        for (int i = 0; i < 6; i++) {
            const double *a = work->found[n].values[i];
            const double scale = ik_slides[i] ? 1.0 + fabs(a[0]) : 1.0;
            const double away = (fabs(a[0] - values[i][0]) + fabs(a[1] - values[i][1])) / scale;
            apart = away > apart ? away : apart;
        }
        if (apart < 1e-6) {
            return;
        }
    }
    if (known < IK_FOUND) {
        memcpy(work->found[known].values, values, sizeof work->found[known].values);
        work->found[known].residual = residual;
        work->count++;
    }
}

/* The roots near the circle as cosines and sines of the hidden joint, with the middles of those that
   are close together (marked): a root that several configurations share falls apart by the root of
   the noise, its middle does not. */
static int ik_near_roots(
    const ik_work *work, const ik_chart *chart, double near[IK_NEARBY][2], int is_middle[IK_NEARBY])
{
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
        }
    }
    for (int k = 0; k < count; k++) {
        double pair[2];
        ik_outside(chart, near[k][0], near[k][1], pair);
        near[k][0] = pair[0];
        near[k][1] = pair[1];
    }
    return count;
}

/* Candidates from the null vectors at the roots. */
static void ik_candidates(const ik_split *split, const ik_chart *chart, ik_work *work)
{
    const int slides = ik_multiplied_slides(split);
    double near[IK_NEARBY][2], small[IK_NEARBY + IK_LANES];
    double vectors[IK_NEARBY][IK_UNKNOWNS];
    int is_middle[IK_NEARBY];
    const int count = ik_near_roots(work, chart, near, is_middle);
    work->candidates = 0;
    for (int from = 0; from < count; from += IK_LANES) {
        double c[IK_LANES], s[IK_LANES];
        double x[IK_UNKNOWNS][IK_LANES];
        for (int l = 0; l < IK_LANES; l++) {
            const int k = from + l < count ? from + l : count - 1;
            c[l] = near[k][0];
            s[l] = near[k][1];
        }
        ik_null_vectors(&work->eliminated, slides, c, s, x, small + from);
        for (int l = 0; l < IK_LANES && from + l < count; l++) {
            for (int k = 0; k < IK_UNKNOWNS; k++) {
                vectors[from + l][k] = x[k][l];
            }
        }
    }
    for (int k = 0; k < count; k++) {
        const int is_shared = !(small[k] > 1e-5);
        int is_replaced = 0;
        for (int j = 0; j < count && !is_middle[k]; j++) {
            const double away = fabs(near[j][0] - near[k][0]) + fabs(near[j][1] - near[k][1]);
            is_replaced |= is_middle[j] && small[j] <= 1e-5 && away < 6e-4;
        }
        if (is_replaced || (is_middle[k] && !is_shared)) {
            continue;
        }
        ik_candidate *own = &work->candidate[work->candidates++];
        memcpy(own->hidden, near[k], sizeof own->hidden);
        memcpy(own->x, vectors[k], sizeof own->x);
        if (is_shared) {
            double all[IK_SHARED][IK_UNKNOWNS];
            const int found = ik_shared(&work->eliminated, slides, near[k][0], near[k][1], all);
            for (int n = 0; n < found; n++) {
                own = &work->candidate[work->candidates++];
                memcpy(own->hidden, near[k], sizeof own->hidden);
                memcpy(own->x, all[n], sizeof own->x);
            }
        }
    }
}

/* Completes and polishes the candidates, and keeps those that reach the pose and are new. */
static void ik_accept(const ik_split *split, const ik_rigid *goal, ik_work *work)
{
    const int branches = work->eliminated.is_open ? 2 : 1;
    for (int from = 0; from < work->candidates; from += IK_LANES) {
        for (int branch = 0; branch < branches; branch++) {
            ik_values values;
            double residual[IK_LANES];
            for (int l = 0; l < IK_LANES; l++) {
                const int k = from + l < work->candidates ? from + l : work->candidates - 1;
                double own[6][2];
                ik_complete(
                    split, &work->eliminated, branch == 0 ? 1.0 : -1.0, &work->candidate[k], own);
                for (int i = 0; i < 6; i++) {
                    values.v[i][0][l] = own[i][0];
                    values.v[i][1][l] = own[i][1];
                }
            }
            ik_polish(goal, &values, residual);
            for (int l = 0; l < IK_LANES && from + l < work->candidates; l++) {
                double own[6][2];
                for (int i = 0; i < 6; i++) {
                    own[i][0] = values.v[i][0][l];
                    own[i][1] = values.v[i][1][l];
                }
                if (residual[l] <= 1e-10) {
                    ik_add(work, own, residual[l]);
                }
            }
        }
    }
}

/* Finds the roots that a chart shows, and what may belong to them; 0 if the samples are of no use. */
INLINE int ik_narrow_candidates(const ik_split *split, const ik_chart *chart, ik_work *work)
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
    if (!ik_fit(work, IK_DEGREE, IK_SAMPLES, &ik_transform[0][0], samples)) {
        return 0;
    }
    ik_find_roots(work);
    ik_candidates(split, chart, work);
    return 1;
}

/* Finds the roots that a chart shows, and the configurations that belong to them. */
INLINE int ik_solve_chart(
    const ik_split *split, int is_wide, const ik_rigid *goal, const ik_chart *chart, ik_work *work)
{
    work->marks = 0;
    work->candidates = 0;
    if (!(is_wide ? ik_wide_candidates(split, chart, work)
                  : ik_narrow_candidates(split, chart, work))) {
        return IK_UNCERTAIN;
    }
    ik_accept(split, goal, work);
    return ik_verdict(split, chart, work);
}

/* The whole circle first, then charts of the arcs where something does not fit. */
static int ik_solve_split(
    const ik_split *split, int is_wide, const ik_rigid *goal, ik_work *work)
{
    const int deepest = is_wide ? IK_WIDE_DEPTH : IK_DEPTH;
    ik_chart list[IK_CHARTS];
    int count = 1;
    int total = IK_CERTIFIED;
    const ik_rigid back = ik_inverse(goal);
    ik_rigid closing = ik_then(&ik_links[5], &back);
    closing = ik_then(&closing, &ik_base);
    ik_eliminate(split, &closing, &work->eliminated);
    if (is_wide) {
        ik_fill_wide(split, work);
    }
    list[0] = ik_whole;
    for (int k = 0; k < count; k++) {
        double arcs[8][2];
        const int verdict = ik_solve_chart(split, is_wide, goal, &list[k], work);
        if (verdict == IK_CERTIFIED) {
            continue;
        }
        const int crowds = ik_crowds(work, arcs);
        if (crowds == 0 || list[k].depth == deepest || count + crowds > IK_CHARTS) {
            total = total == IK_UNCERTAIN ? total : verdict;
            continue;
        }
        for (int j = 0; j < crowds; j++) {
            list[count++] = ik_part(&list[k], arcs[j][0], arcs[j][1]);
        }
    }
    /* Configurations come in even numbers. */
    return total == IK_CERTIFIED && work->count % 2 != 0 ? IK_UNCERTAIN : total;
}

/* The joint variables at values of the axes. */
static void ik_variables(const double axes[6], double q[6])
{
    for (int j = 0; j < 6; j++) {
        q[j] = 0.0;
        for (int k = 0; k < 6; k++) {
            q[j] += ik_coupling[j][k] * (axes[k] - ik_offsets[k]);
        }
        if (ik_is_angle[j]) {
            q[j] -= IK_TURN * floor(q[j] / IK_TURN + 0.5);
            q[j] = q[j] <= -0.5 * IK_TURN ? q[j] + IK_TURN : q[j];
        }
    }
}

/* Brings a matrix to the rotation nearest to it; 0 if it is none, not even to a tenth. */
static int ik_nearest_rotation(double r[3][3])
{
    for (int step = 0; step < 4; step++) {
        double product[3][3];
        double next[3][3];
        double defect = 0.0;
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                product[i][j] = (i == j ? 1.0 : 0.0)
                    - (r[0][i] * r[0][j] + r[1][i] * r[1][j] + r[2][i] * r[2][j]);
                defect = fabs(product[i][j]) > defect ? fabs(product[i][j]) : defect;
                if (!(fabs(product[i][j]) <= 0.1)) {
                    return 0;
                }
            }
        }
        if (defect <= 1e-15) {
            break;
        }
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                next[i][j] = r[i][j]
                    + 0.5 * (r[i][0] * product[0][j] + r[i][1] * product[1][j] + r[i][2] * product[2][j]);
            }
        }
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                r[i][j] = next[i][j];
            }
        }
    }
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1])
        - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0])
        + r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]) > 0.0;
}

int @name@_solve(
    const double pose[12],
    @name@_solve_solution solutions[@NAME@_SOLVE_MAX],
    @name@_solve_certificate *certificate)
{
    ik_work work;
    ik_rigid goal;
    int last = IK_UNCERTAIN;
    int is_isolated = 1;
    int is_number = 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            goal.r[i][k] = pose[4 * i + k];
        }
        goal.t[i] = pose[4 * i + 3] / ik_size;
        is_number = is_number && fabs(goal.t[i]) < HUGE_VAL;
    }
    if (!is_number || !ik_nearest_rotation(goal.r)) {
        if (certificate) {
            *certificate = @NAME@_SOLVE_NOT_A_POSE;
        }
        return 0;
    }
    work.count = 0;
    for (int k = 0; k < IK_SPLITS && last != IK_CERTIFIED; k++) {
        last = ik_solve_split(&ik_splits[k], 0, &goal, &work);
    }
    /* The wider matrices last: they take ten times as long, and their determinants never vanish. */
    for (int k = 0; k < IK_SPLITS && last == IK_UNCERTAIN; k++) {
        last = ik_solve_split(&ik_splits[k], 1, &goal, &work);
    }
    const int count = work.count < @NAME@_SOLVE_MAX ? work.count : @NAME@_SOLVE_MAX;
    for (int from = 0; from < count; from += IK_LANES) {
        ik_values values;
        double singular[IK_LANES];
        for (int l = 0; l < IK_LANES; l++) {
            const ik_found *found = &work.found[from + l < count ? from + l : count - 1];
            for (int i = 0; i < 6; i++) {
                values.v[i][0][l] = found->values[i][0];
                values.v[i][1][l] = found->values[i][1];
            }
        }
        ik_singular_values(&values, singular);
        for (int l = 0; l < IK_LANES && from + l < count; l++) {
            const ik_found *found = &work.found[from + l];
            @name@_solve_solution *out = &solutions[from + l];
            double axes[6];
            for (int i = 0; i < 6; i++) {
                const double *value = found->values[i];
                axes[i] = ik_slides[i] ? value[0] * ik_size : atan2(value[1], value[0]);
            }
            ik_variables(axes, out->q);
            out->residual = found->residual;
            out->singular = singular[l] < HUGE_VAL ? singular[l] : 0.0;
            out->multiplicity = out->singular < 1e-6 ? 2 : 1;
            /* Newton and Kantorovich: a root of its own lies near if 2 K residual <= singular^2, where
               K = 20 bounds the second derivative. */
            is_isolated = is_isolated && out->multiplicity == 1
                && 40.0 * out->residual <= out->singular * out->singular;
        }
    }
    if (certificate) {
        if (work.count > count) {
            *certificate = @NAME@_SOLVE_UNDECIDED;
        } else if (!is_isolated || last == IK_PAIRS) {
            *certificate = @NAME@_SOLVE_NEAR_DOUBLE_ROOT;
        } else {
            *certificate = last == IK_CERTIFIED ? @NAME@_SOLVE_COMPLETE : @NAME@_SOLVE_UNDECIDED;
        }
    }
    return count;
}
