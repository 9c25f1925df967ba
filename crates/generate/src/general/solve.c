
/*
 * One split of the loop after the other, until one certifies that nothing is missing.
 */

/* The configurations that belong to the roots. */
static NOINLINE void ik_collect(
    const ik_split *split, int is_wide, const ik_rigid *goal, const ik_chart *chart, ik_work *work)
{
    ik_batch batch;
    batch.split = split;
    batch.goal = goal;
    batch.work = work;
    batch.count = 0;
    if (is_wide) {
        ik_wide_candidates(chart, &batch);
    } else {
        ik_narrow_candidates(chart, &batch);
    }
    ik_flush(&batch);
}

/* Finds the roots that a chart shows, and the configurations that belong to them; where something does not
   fit, the arcs where it does not. */
static int ik_solve_chart(
    const ik_split *split, int is_wide, const ik_rigid *goal, const ik_chart *chart, ik_work *work,
    double arcs[IK_ARCS][2], int *crowds)
{
    *crowds = 0;
    if (!(is_wide ? ik_wide_samples(chart, work) : ik_narrow_samples(split, chart, work))) {
        return IK_UNCERTAIN;
    }
    ik_find_roots(work);
    ik_collect(split, is_wide, goal, chart, work);
    return ik_verdict(split, chart, work, arcs, crowds);
}

/* The whole circle first, then charts of the arcs where something does not fit. */
static NOINLINE int ik_solve_split(
    const ik_split *split, int is_wide, const ik_rigid *goal, ik_work *work)
{
    const int deepest = is_wide ? IK_WIDE_DEPTH : IK_DEPTH;
    ik_chart list[IK_CHARTS];
    int count = 1;
    int total = IK_CERTIFIED;
    ik_eliminate(split, goal, &work->eliminated);
    if (is_wide) {
        ik_halve_rows(split, &work->eliminated);
    }
    list[0] = ik_whole;
    for (int k = 0; k < count && !work->is_over; k++) {
        double arcs[IK_ARCS][2];
        int crowds;
        const int verdict = ik_solve_chart(split, is_wide, goal, &list[k], work, arcs, &crowds);
        if (verdict == IK_CERTIFIED) {
            continue;
        }
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
    work.is_over = 0;
    work.found = solutions;
    for (int k = 0; k < IK_SPLITS && last != IK_CERTIFIED && !work.is_over; k++) {
        last = ik_solve_split(&ik_splits[k], 0, &goal, &work);
    }
    /* The wider matrices last: they take ten times as long, and their determinants never vanish. */
    for (int k = 0; k < IK_SPLITS && last == IK_UNCERTAIN && !work.is_over; k++) {
        last = ik_solve_split(&ik_splits[k], 1, &goal, &work);
    }
    for (int n = 0; n < work.count; n++) {
        @name@_solve_solution *out = &solutions[n];
        double axes[6];
        for (int i = 0; i < 6; i++) {
            axes[i] = ik_slides[i] ? out->q[i] * ik_size : out->q[i];
        }
        ik_variables(axes, out->q);
        out->multiplicity = out->singular < 1e-6 ? 2 : 1;
        /* Newton and Kantorovich: a root of its own lies near if 2 K residual <= singular^2, where
           K = 20 bounds the second derivative. */
        is_isolated = is_isolated && out->multiplicity == 1
            && 40.0 * out->residual <= out->singular * out->singular;
    }
    if (certificate) {
        if (work.is_over) {
            *certificate = @NAME@_SOLVE_UNDECIDED;
        } else if (!is_isolated || last == IK_PAIRS) {
            *certificate = @NAME@_SOLVE_NEAR_DOUBLE_ROOT;
        } else {
            *certificate = last == IK_CERTIFIED ? @NAME@_SOLVE_COMPLETE : @NAME@_SOLVE_UNDECIDED;
        }
    }
    return work.count;
}
