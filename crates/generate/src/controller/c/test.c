

/* The most configurations that are looked at of a pose, copies of turns included. */
enum { CONTROLLED_ROOM = 4096 };

static void controlled(int v, int is_right, const char *what)
{
    if (!is_right) {
        printf("ik, pose %d: %s\n", v, what);
        failures++;
    }
}

static const double controlled_unit[@n@] = @units@;

/* How far two configurations are apart, angles modulo whole turns. */
static double controlled_apart(const double *a, const double *b)
{
    static const double window[@n@] = @windows@;
    double apart = 0.0;
    for (int j = 0; j < @n@; j++) {
        double way = b[j] - a[j];
        if (window[j] > 0.0) {
            way -= window[j] * floor(way / window[j] + 0.5);
        }
        apart = fmax(apart, fabs(way) / controlled_unit[j]);
    }
    return apart;
}

static void test_ik(void)
{
    static const double configurations[@count@][@n@] = {
@configurations@
    };
    static const int solutions[@count@] = @solutions@;
    static double all[CONTROLLED_ROOM][@n@];@parameters_test@
    @name@_ik_limits none;
    for (int j = 0; j < @n@; j++) {
        none.lower[j] = -HUGE_VAL;
        none.upper[j] = HUGE_VAL;
    }
    for (int v = 0; v < @count@; v++) {
        const double *q = configurations[v];
        double variables[@variables@] = {0.0};
        double both[@columns@ + 16];
        double pose[4][4], wrong[4][4], previous[@n@], nearest = HUGE_VAL;
        int count;
        @name@_ik_result result;
        @name@_ik_choice choice;
        @name@_ik_status status;@given_test@
        memcpy(variables, q, @n@ * sizeof *q);
        @name@_jacobian_fk(variables@jacobian_fk_parameters@, both);
        memcpy(pose, both + @columns@, sizeof pose);
        status = @name@_ik(pose@given_passed@@parameters_passed@, &result);
        controlled(v, status == @NAME@_IK_SOLVED && result.count == solutions[v], "is not solved as it is known");
        for (int s = 0; s < result.count; s++) {
            nearest = fmin(nearest, controlled_apart(result.solutions[s].q, q));
        }
        controlled(v, nearest <= 1e-6, "its configuration is not found");
        /* The nearest one to a configuration beside it is itself, and what is nearer has the pose, too. */
        for (int j = 0; j < @n@; j++) {
            previous[j] = q[j] + (j % 2 == 0 ? 1e-3 : -1e-3) * controlled_unit[j];
        }
        status = @name@_ik_nearest(pose, previous, &none@parameters_passed@, &choice);
        controlled(v, status == @NAME@_IK_SOLVED && choice.is_found && choice.distance <= 4e-3
            && choice.missed_shift <= 1e-8 * @size@ && choice.missed_turn <= 1e-8, "the nearest one is another");
        /* Limits around it allow it, and nothing else if they are narrow. */
        @name@_ik_limits narrow;
        for (int j = 0; j < @n@; j++) {
            narrow.lower[j] = q[j] - 1e-4 * controlled_unit[j];
            narrow.upper[j] = q[j] + 1e-4 * controlled_unit[j];
        }
        status = @name@_ik_all_within_limits(
            pose@given_passed@, &narrow@parameters_passed@, CONTROLLED_ROOM, all, &count);
        controlled(v, status == @NAME@_IK_SOLVED && count >= 1 && controlled_apart(all[0], q) <= 1e-6,
            "limits around its configuration leave it out");
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) {
                wrong[i][j] = i < 3 && j < 3 ? 1.01 * pose[i][j] : pose[i][j];
            }
        }
@wrong@        wrong[1][3] = HUGE_VAL;
        controlled(v, @name@_ik(wrong@given_passed@@parameters_passed@, &result) == @NAME@_IK_NOT_FINITE
            && result.count == 0, "an infinite position is taken for a pose");
    }
}
