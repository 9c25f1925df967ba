
enum { IK_VECTORS = @count@ };

static const double ik_poses[IK_VECTORS][12] = {
@poses@
};

/* All configurations, those of pose v from first[v] on. */
static const int ik_first[IK_VECTORS + 1] = {
@first@
};

static const double ik_known[@known_count@][6] = {
@known@
};

/* The configurations whose poses these are, where there is one. */
static const double ik_given[IK_VECTORS][6] = {
@given@
};

static const int ik_has_given[IK_VECTORS] = {
@has_given@
};

/* What lengths are compared with, m. */
static const double ik_unit = @unit@;

/* How far the nearest of the solutions is. */
static double ik_nearest(const @name@_solve_solution *found, int count, const double *known)
{
    static const int is_angle[6] = {@angles@};
    const double turn = 6.283185307179586;
    double nearest = HUGE_VAL;
    for (int j = 0; j < count; j++) {
        double apart = 0.0;
        for (int k = 0; k < 6; k++) {
            double difference = found[j].q[k] - known[k];
            if (is_angle[k]) {
                difference -= turn * floor(difference / turn + 0.5);
            } else {
                difference /= ik_unit;
            }
            apart = fmax(apart, fabs(difference));
        }
        nearest = fmin(nearest, apart);
    }
    return nearest;
}

static void test_solve(void)
{
    for (int v = 0; v < IK_VECTORS; v++) {
        @name@_solve_solution found[@NAME@_SOLVE_MAX];
        @name@_solve_certificate certificate = @NAME@_SOLVE_UNDECIDED;
        const int count = @name@_solve(ik_poses[v], found, &certificate);
        const int expected = ik_first[v + 1] - ik_first[v];
        if (count != expected || certificate != @NAME@_SOLVE_COMPLETE) {
            printf("ik, pose %d: %d solutions, expected %d", v, count, expected);
            printf("; certificate %d\n", (int)certificate);
            failures++;
        }
        for (int j = 0; j < count; j++) {
            if (!(found[j].residual <= 1e-10) || found[j].multiplicity != 1) {
                printf("ik, pose %d: residual %.2g\n", v, found[j].residual);
                failures++;
            }
        }
        for (int e = ik_first[v]; e < ik_first[v + 1]; e++) {
            const double nearest = ik_nearest(found, count, ik_known[e]);
            if (!(nearest <= 1e-9)) {
                printf("ik, pose %d: solution %d is off by %.2g\n", v, e - ik_first[v], nearest);
                failures++;
            }
        }
        if (ik_has_given[v] && !(ik_nearest(found, count, ik_given[v]) <= 1e-9)) {
            printf("ik, pose %d: its configuration is not found\n", v);
            failures++;
        }
        /* A pose of six decimals is that of nearby configurations; what is no rotation has none. */
        double rounded[12];
        for (int k = 0; k < 12; k++) {
            const double unit = k % 4 == 3 ? ik_unit : 1.0;
            rounded[k] = floor(1e6 * ik_poses[v][k] / unit + 0.5) / 1e6 * unit;
        }
        const int again = @name@_solve(rounded, found, &certificate);
        for (int e = ik_first[v]; e < ik_first[v + 1]; e++) {
            if (!(ik_nearest(found, again, ik_known[e]) <= 1e-2)) {
                printf("ik, pose %d of six decimals: solution %d is not found\n", v, e - ik_first[v]);
                failures++;
            }
        }
        rounded[0] += 1.0;
        if (@name@_solve(rounded, found, &certificate) != 0 || certificate != @NAME@_SOLVE_NOT_A_POSE) {
            printf("ik, pose %d: what is no rotation has solutions\n", v);
            failures++;
        }
    }
}
