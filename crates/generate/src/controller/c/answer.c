
/*
 * Inverse kinematics for controllers: all solutions with a status, around @name@_solve.
 */

enum {
    ANSWER_JOINTS = @n@,
    /* Numbers that functions of the joints take. */
    ANSWER_VARIABLES = @variables@,
    /* Rows of an error: a shift and a turn. */
    ANSWER_ROWS = 6,
    /* Poses beside a singular one that are solved. */
    ANSWER_NEIGHBOURS = @NAME@_IK_NEIGHBOURS
};

/* What lengths are compared with (m): the sum of the arm's lengths. */
static const double answer_size = @size@;
/* For each joint what its numbers are divided by. */
static const double answer_unit[ANSWER_JOINTS] = @units@;
/* By what a joint can move so that all links come back; 0 for one that slides. */
static const double answer_period[ANSWER_JOINTS] = @periods@;
/* The range in which angles are listed. */
static const double answer_window[ANSWER_JOINTS] = @windows@;
/* The joints whose values are given beside the pose. */
static const int answer_is_given[ANSWER_JOINTS] = @is_given@;

const @name@_ik_limits @name@_limits = {
    @lower@,
    @upper@
};

static int answer_is_finite(const double *x, int count)
{
    for (int k = 0; k < count; k++) {
        if (!(fabs(x[k]) < HUGE_VAL)) {
            return 0;
        }
    }
    return 1;
}

/* How a joint goes from x to y, divided by its unit; an angle by the shorter way. */
static double answer_way(int joint, double x, double y)
{
    const double period = answer_period[joint];
    double way = y - x;
    if (period > 0.0) {
        way -= period * floor(way / period + 0.5);
    }
    return way / answer_unit[joint];
}

/* The largest of the ways. */
static double answer_apart(const double *a, const double *b)
{
    double apart = 0.0;
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        apart = fmax(apart, fabs(answer_way(j, a[j], b[j])));
    }
    return apart;
}

/* Angles into the range in which they are listed. */
static void answer_wrap(double *q)
{
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        const double window = answer_window[j];
        if (window > 0.0) {
            q[j] -= window * floor(q[j] / window + 0.5);
            q[j] = q[j] <= -0.5 * window ? q[j] + window : q[j];
        }
    }
}

@goal@
/* Pose and Jacobian in one pass. */
static void answer_see(const double *q@parameters_given@, double both[6 * ANSWER_JOINTS + 16])
{
    double variables[ANSWER_VARIABLES] = {0.0};
    memcpy(variables, q, ANSWER_JOINTS * sizeof *q);@parameters_unread@
    @name@_jacobian_fk(variables@jacobian_fk_parameters@, both);
}

/* What is missing from a configuration to the goal (a shift divided by the arm's size, a turn), and how it
   changes with the joints divided by their units; given joints stand still if they are held. Returns the
   length of the error. */
static double answer_error(
    double goal[4][4],
    const double *q@parameters_given@,
    int is_held,
    double error[ANSWER_ROWS],
    double jacobian[ANSWER_ROWS][ANSWER_JOINTS])
{
    double both[6 * ANSWER_JOINTS + 16];
    const double *pose = both + 6 * ANSWER_JOINTS;
    double square = 0.0;
    answer_see(q@parameters_passed@, both);
    for (int i = 0; i < ANSWER_ROWS; i++) {
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            const double entry = both[ANSWER_JOINTS * i + j] * answer_unit[j];
            jacobian[i][j] = is_held && answer_is_given[j] ? 0.0 : (i < 3 ? entry / answer_size : entry);
        }
    }
    for (int i = 0; i < 3; i++) {
        error[i] = (goal[i][3] - pose[4 * i + 3]) / answer_size;
    }
    answer_turned(goal, pose, error + 3, jacobian + 3);
    for (int i = 0; i < ANSWER_ROWS; i++) {
        square += error[i] * error[i];
    }
    return sqrt(square);
}

/* Solves (J J' + damping) y = x and returns J' y: the smallest motion of the joints that makes x. */
static void answer_pull(
    double jacobian[ANSWER_ROWS][ANSWER_JOINTS],
    const double x[ANSWER_ROWS],
    double damping,
    double motion[ANSWER_JOINTS])
{
    double l[ANSWER_ROWS][ANSWER_ROWS];
    double y[ANSWER_ROWS];
    for (int i = 0; i < ANSWER_ROWS; i++) {
        for (int k = 0; k <= i; k++) {
            double sum = i == k ? damping : 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                sum += jacobian[i][j] * jacobian[k][j];
            }
            for (int j = 0; j < k; j++) {
                sum -= l[i][j] * l[k][j];
            }
            if (i == k) {
                /* Rounding must not make it negative. */
                l[i][i] = sqrt(fmax(sum, damping > 0.0 ? 0.5 * damping : 1e-300));
            } else {
                l[i][k] = sum / l[k][k];
            }
        }
    }
    memcpy(y, x, sizeof y);
    for (int i = 0; i < ANSWER_ROWS; i++) {
        for (int k = 0; k < i; k++) {
            y[i] -= l[i][k] * y[k];
        }
        y[i] /= l[i][i];
    }
    for (int i = ANSWER_ROWS - 1; i >= 0; i--) {
        for (int k = i + 1; k < ANSWER_ROWS; k++) {
            y[i] -= l[k][i] * y[k];
        }
        y[i] /= l[i][i];
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        motion[j] = 0.0;
        for (int i = 0; i < ANSWER_ROWS; i++) {
            motion[j] += jacobian[i][j] * y[i];
        }
    }
}

/* Newton's method with the smallest motion; returns how far the pose is from the goal in the end. */
static double answer_correct(double goal[4][4], double *q@parameters_given@, int is_held, int steps)
{
    double error[ANSWER_ROWS], motion[ANSWER_JOINTS];
    double jacobian[ANSWER_ROWS][ANSWER_JOINTS];
    double best[ANSWER_JOINTS];
    double least = HUGE_VAL;
    double before = HUGE_VAL;
    memcpy(best, q, sizeof best);
    for (int step = 0; step <= steps; step++) {
        const double length = answer_error(goal, q@parameters_passed@, is_held, error, jacobian);
        double largest = 0.0;
        /* Where roots come together an error falls by a quarter or more a step; what falls less in four leads nowhere. */
        if (step % 4 == 3) {
            if (!(length < 0.7 * before)) {
                steps = step;
            }
            before = length;
        }
        if (length < least) {
            least = length;
            memcpy(best, q, sizeof best);
        }
        if (!(length > 1e-15) || step == steps || length > 1e3 * least) {
            break;
        }
        answer_pull(jacobian, error, 1e-13 + 1e-3 * fmin(1.0, length * length), motion);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            largest = fmax(largest, fabs(motion[j]));
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            q[j] += answer_unit[j] * motion[j] * (largest > 0.5 ? 0.5 / largest : 1.0);
        }
    }
    memcpy(q, best, sizeof best);
    return least;
}

/* Moves a configuration that has the pose, with the hand still, to where it is nearest to the target;
   returns how far it is then. */
static double answer_slide(
    double goal[4][4], double *q@parameters_given@, int is_held, const double *target)
{
    double error[ANSWER_ROWS], seen[ANSWER_ROWS], way[ANSWER_JOINTS], back[ANSWER_JOINTS];
    double jacobian[ANSWER_ROWS][ANSWER_JOINTS];
    double size = 1.0;
    for (int step = 0; step < 40; step++) {
        double trial[ANSWER_JOINTS], ahead[ANSWER_JOINTS];
        double before = 0.0;
        double largest = 0.0;
        (void)answer_error(goal, q@parameters_passed@, is_held, error, jacobian);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            way[j] = is_held && answer_is_given[j] ? 0.0 : answer_way(j, q[j], target[j]);
            before += way[j] * way[j];
        }
        for (int i = 0; i < ANSWER_ROWS; i++) {
            seen[i] = 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                seen[i] += jacobian[i][j] * way[j];
            }
        }
        answer_pull(jacobian, seen, 1e-9, back);
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            way[j] -= back[j];
            largest = fmax(largest, fabs(way[j]));
        }
        if (!(largest > 1e-8)) {
            break;
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            trial[j] = q[j] + answer_unit[j] * size * way[j] * (largest > 0.4 ? 0.4 / largest : 1.0);
        }
        memcpy(ahead, trial, sizeof ahead);
        largest = fmin(largest, 0.4) * size;
        /* What lies far from where the tangent leads is another solution. */
        if (answer_correct(goal, trial@parameters_passed@, is_held, 8) <= 1e-10
            && answer_apart(trial, ahead) <= 0.5 * largest) {
            double after = 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                const double left = is_held && answer_is_given[j] ? 0.0 : answer_way(j, trial[j], target[j]);
                after += left * left;
            }
            if (after < before) {
                memcpy(q, trial, sizeof trial);
                size = fmin(1.0, 2.0 * size);
                continue;
            }
        }
        size *= 0.25;
        if (size < 1e-3) {
            break;
        }
    }
    return answer_apart(q, target);
}
