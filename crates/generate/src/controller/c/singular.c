
/* Eigenvalues (on the diagonal) and eigenvectors (columns of v) of a symmetric matrix, by Jacobi's rotations. */
static void answer_eigen(double a[ANSWER_JOINTS][ANSWER_JOINTS], double v[ANSWER_JOINTS][ANSWER_JOINTS])
{
    for (int i = 0; i < ANSWER_JOINTS; i++) {
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            v[i][j] = i == j ? 1.0 : 0.0;
        }
    }
    for (int sweep = 0; sweep < 12; sweep++) {
        for (int p = 0; p < ANSWER_JOINTS; p++) {
            for (int q = p + 1; q < ANSWER_JOINTS; q++) {
                if (fabs(a[p][q]) > 1e-18 * (fabs(a[p][p]) + fabs(a[q][q]))) {
                    const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
                    const double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
                    const double c = 1.0 / sqrt(t * t + 1.0);
                    const double s = t * c;
                    for (int k = 0; k < ANSWER_JOINTS; k++) {
                        const double x = a[k][p];
                        const double y = a[k][q];
                        a[k][p] = c * x - s * y;
                        a[k][q] = s * x + c * y;
                    }
                    for (int k = 0; k < ANSWER_JOINTS; k++) {
                        const double x = a[p][k];
                        const double y = a[q][k];
                        a[p][k] = c * x - s * y;
                        a[q][k] = s * x + c * y;
                    }
                    for (int k = 0; k < ANSWER_JOINTS; k++) {
                        const double x = v[k][p];
                        const double y = v[k][q];
                        v[k][p] = c * x - s * y;
                        v[k][q] = s * x + c * y;
                    }
                }
            }
        }
    }
}

/* The configuration with the goal's pose nearest to one that is a step along a direction; 1 if it is about so far away.
   Another solution nearby is not: it is as far away whatever the step. */
static int answer_steps(
    double goal[4][4], const double *q@parameters_given@, const double *direction, double by, double moved[ANSWER_JOINTS])
{
    double square = 0.0;
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        moved[j] = q[j] + by * answer_unit[j] * direction[j];
    }
    if (!(answer_correct(goal, moved@parameters_passed@, 1, 40) <= 1e-10)) {
        return 0;
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        const double part = (moved[j] - q[j]) / answer_unit[j];
        square += part * part;
    }
    return sqrt(square) >= 0.5 * fabs(by) && sqrt(square) <= 1.5 * fabs(by);
}

/* Follows a direction in which the hand hardly moves: if the arm moves there with its hand still, the
   direction becomes the one that it takes, and 1 is returned. */
static int answer_follows(double goal[4][4], const double *q@parameters_given@, double direction[ANSWER_JOINTS])
{
    for (int side = 1; side >= -1; side -= 2) {
        double moved[ANSWER_JOINTS];
        if (answer_steps(goal, q@parameters_passed@, direction, side * 0.02, moved)
            && answer_steps(goal, q@parameters_passed@, direction, side * 0.009, moved)
            && answer_steps(goal, q@parameters_passed@, direction, side * 0.004, moved)
            && answer_steps(goal, q@parameters_passed@, direction, side * 1e-4, moved)) {
            double square = 0.0;
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                direction[j] = side * (moved[j] - q[j]) / answer_unit[j];
                square += direction[j] * direction[j];
            }
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                direction[j] /= sqrt(square);
            }
            return 1;
        }
    }
    return 0;
}

/* Directions in which the hand hardly moves, up to three, orthogonal to each other; and the smallest singular value of
   the Jacobian beside the largest. Joints that are given stand still. */
typedef struct answer_kernel {
    int count;
    double direction[3][ANSWER_JOINTS];
    double least;
} answer_kernel;

static answer_kernel answer_still(double goal[4][4], const double *q@parameters_given@)
{
    answer_kernel kernel;
    double error[ANSWER_ROWS], jacobian[ANSWER_ROWS][ANSWER_JOINTS];
    double a[ANSWER_JOINTS][ANSWER_JOINTS], v[ANSWER_JOINTS][ANSWER_JOINTS];
    double most = 0.0;
    (void)answer_error(goal, q@parameters_passed@, 1, error, jacobian);
    for (int i = 0; i < ANSWER_JOINTS; i++) {
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            a[i][j] = 0.0;
            for (int r = 0; r < ANSWER_ROWS; r++) {
                a[i][j] += jacobian[r][i] * jacobian[r][j];
            }
        }
    }
    answer_eigen(a, v);
    for (int i = 0; i < ANSWER_JOINTS; i++) {
        most = fmax(most, a[i][i]);
    }
    kernel.count = 0;
    kernel.least = 1.0;
    for (int i = 0; i < ANSWER_JOINTS; i++) {
        int is_given = 0;
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            is_given |= answer_is_given[j] && fabs(v[j][i]) > 0.5;
        }
        if (is_given) {
            continue;
        }
        kernel.least = fmin(kernel.least, sqrt(fmax(a[i][i], 0.0) / fmax(most, 1e-300)));
        if (a[i][i] <= 1e-8 * most && kernel.count < 3) {
            for (int j = 0; j < ANSWER_JOINTS; j++) {
                kernel.direction[kernel.count][j] = v[j][i];
            }
            kernel.count++;
        }
    }
    return kernel;
}

/* The sums and differences of the directions of a kernel, by a number below ANSWER_MIXTURES: unit vectors. 0 if the number
   stands for none, or for the opposite of another. */
enum { ANSWER_MIXTURES = 27 };

static int answer_mixture(const answer_kernel *kernel, int number, double direction[ANSWER_JOINTS])
{
    const int part[3] = {number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1};
    double square = 0.0;
    int first = 0;
    for (int k = 2; k >= 0; k--) {
        if (part[k] != 0 && k >= kernel->count) {
            return 0;
        }
        first = part[k] != 0 ? part[k] : first;
    }
    if (first != 1) {
        return 0;
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        direction[j] = 0.0;
        for (int k = 0; k < kernel->count; k++) {
            direction[j] += part[k] * kernel->direction[k][j];
        }
        square += direction[j] * direction[j];
    }
    for (int j = 0; j < ANSWER_JOINTS; j++) {
        direction[j] /= sqrt(square);
    }
    return 1;
}

/* In how many directions the joints can move with the hand still, and one of them. */
static int answer_family(
    double goal[4][4], const double *q@parameters_given@, const answer_kernel *kernel, double motion[ANSWER_JOINTS])
{
    int count = 0;
    memset(motion, 0, ANSWER_JOINTS * sizeof *motion);
    for (int k = 0; k < kernel->count; k++) {
        double direction[ANSWER_JOINTS];
        memcpy(direction, kernel->direction[k], sizeof direction);
        if (answer_follows(goal, q@parameters_passed@, direction)) {
            if (count == 0) {
                memcpy(motion, direction, sizeof direction);
            }
            count++;
        }
    }
    /* A curve need not leave along one of the directions that were chosen. */
    for (int number = 0; number < ANSWER_MIXTURES && kernel->count > 1 && count == 0; number++) {
        double direction[ANSWER_JOINTS];
        if (answer_mixture(kernel, number, direction) && answer_follows(goal, q@parameters_passed@, direction)) {
            memcpy(motion, direction, sizeof direction);
            count = 1;
        }
    }
    return count;
}

/* A member of a family: the one that is known (0), or another, some way along its motion or against it (1, 2). */
static void answer_aside(
    double goal[4][4], const @name@_ik_solution *family, int start@parameters_given@, double member[ANSWER_JOINTS])
{
    memcpy(member, family->q, sizeof family->q);
    if (start > 0) {
        double aside[ANSWER_JOINTS];
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            aside[j] = member[j] + (start == 1 ? 2.0 : -2.0) * answer_unit[j] * family->motion[j];
        }
        (void)answer_slide(goal, member@parameters_passed@, 1, aside);
    }
}

/* Whether a configuration is a member of the family of a solution. */
static int answer_is_member(
    double goal[4][4], const @name@_ik_solution *family, const double *q@parameters_given@)
{
    /* Half a turn away the shorter way of each joint need not be that of the family: start from elsewhere, too. */
    for (int start = 0; start < 3; start++) {
        double member[ANSWER_JOINTS];
        answer_aside(goal, family, start@parameters_passed@, member);
        if (answer_slide(goal, member@parameters_passed@, 1, q) <= 1e-4) {
            return 1;
        }
    }
    return 0;
}

/* Members of families are found so near to them that singular values are below this beside the largest. */
static const double answer_flat = 2e-6;

/* Adds a configuration that has the pose, unless it is there, or a family of which it is a member, or there is no
   room. */
static void answer_add(
    double goal[4][4]@parameters_given@, @name@_ik_result *result, const @name@_ik_solution *found)
{
    @name@_ik_solution own = *found;
    answer_kernel kernel;
    double close;
    answer_wrap(own.q);
    for (int k = 0; k < result->count; k++) {
        if (answer_apart(result->solutions[k].q, own.q) <= 1e-6) {
            return;
        }
    }
    kernel = answer_still(goal, own.q@parameters_passed@);
    /* Where it is flat, a configuration is known to what is missing divided by the slope. */
    close = fmin(1e-3, 1e-6 + 10.0 * own.residual / fmax(kernel.least, 1e-12));
    for (int k = 0; k < result->count; k++) {
        const @name@_ik_solution *known = &result->solutions[k];
        if (answer_apart(known->q, own.q) <= close) {
            return;
        }
        if (known->dimension > 0 && kernel.least < answer_flat
            && answer_is_member(goal, known, own.q@parameters_passed@)) {
            return;
        }
    }
    own.dimension = answer_family(goal, own.q@parameters_passed@, &kernel, own.motion);
    if (own.dimension > 0) {
        /* What is known already may be a member of it. */
        int left = 0;
        for (int k = 0; k < result->count; k++) {
            const @name@_ik_solution *known = &result->solutions[k];
            const answer_kernel beside = answer_still(goal, known->q@parameters_passed@);
            if (!(beside.least < answer_flat && answer_is_member(goal, &own, known->q@parameters_passed@))) {
                result->solutions[left++] = *known;
            }
        }
        result->count = left;
    }
    if (result->count < @NAME@_IK_MAX) {
        result->solutions[result->count++] = own;
    }
}
@neighbour@
/* Where the arm hardly moves its hand, and no motion with the hand still is seen, several may cross: what lies farther along
   is on one of them, or is another solution. */
static NOINLINE void answer_probe(
    double goal[4][4]@parameters_given@, @name@_ik_result *result, const @name@_ik_solution *from)
{
    const answer_kernel kernel = answer_still(goal, from->q@parameters_passed@);
    for (int number = 0; number < 2 * ANSWER_MIXTURES && kernel.count > 1; number++) {
        @name@_ik_solution found = *from;
        double direction[ANSWER_JOINTS];
        if (!answer_mixture(&kernel, number / 2, direction)) {
            continue;
        }
        for (int j = 0; j < ANSWER_JOINTS; j++) {
            found.q[j] += (number % 2 == 0 ? 0.3 : -0.3) * answer_unit[j] * direction[j];
        }
        found.residual = answer_correct(goal, found.q@parameters_passed@, 1, 40);
        found.branch = -1;
        found.multiplicity = 1;
        if (found.residual <= 1e-12) {
            answer_add(goal@parameters_passed@, result, &found);
        }
    }
}

/* What lies beside a pose, followed to the goal. */
static NOINLINE void answer_gather(
    double goal[4][4], double beside[4][4],@given_local@@parameters_local@
    @name@_ik_result *result)
{
    @name@_solve_solution other[@NAME@_SOLVE_MAX];
    int is_all;
    const int count = answer_list(beside@given_passed@@parameters_passed@, other, &is_all);
    for (int s = 0; s < count; s++) {
        @name@_ik_solution found;
        memcpy(found.q, other[s].@solve_result@, sizeof found.q);
        memset(found.motion, 0, sizeof found.motion);
        found.residual = answer_correct(goal, found.q@parameters_passed@, 1, 20);
        found.multiplicity = 1;
        found.branch = -1;
        found.dimension = 0;
        if (found.residual <= 1e-12) {
            answer_add(goal@parameters_passed@, result, &found);
        }
    }
}

/* What is listed of a singular pose, made precise, takes its own place again; the first of it as it was. */
static NOINLINE void answer_sharpen(
    double goal[4][4]@parameters_given@, @name@_ik_result *result, double listed[][ANSWER_JOINTS])
{
    const int count = result->count;
    result->count = 0;
    for (int k = 0; k < count; k++) {
        @name@_ik_solution found = result->solutions[k];
        double q[ANSWER_JOINTS];
        memcpy(q, found.q, sizeof q);
        if (k < ANSWER_NEIGHBOURS) {
            memcpy(listed[k], q, sizeof q);
        }
        if (found.residual > 1e-12) {
            const double residual = answer_correct(goal, found.q@parameters_passed@, 1, 8);
            if (residual <= found.residual && answer_apart(found.q, q) <= 0.01) {
                found.residual = residual;
            } else {
                memcpy(found.q, q, sizeof q);
            }
        }
        answer_add(goal@parameters_passed@, result, &found);
    }
}

/* Singular poses: what @name@_solve lists is made precise, families are found, and solutions that it does not see
   there are followed from poses beside it. */
static NOINLINE @name@_ik_status answer_singular(
    double goal[4][4],@given_local@@parameters_local@
    @name@_ik_result *result)
{
    double listed[ANSWER_NEIGHBOURS + 1][ANSWER_JOINTS] = {{0.0}};
    const int count = result->count;
    int is_family = 0;
    if (ANSWER_NEIGHBOURS == 0) {
        return @NAME@_IK_UNDECIDED;
    }
    answer_sharpen(goal@parameters_passed@, result, listed);
    for (int k = 0; k < ANSWER_NEIGHBOURS; k++) {
        double beside[4][4];
        if (answer_neighbour(goal@parameters_passed@, listed, count, k, beside)) {
            answer_gather(goal, beside@given_passed@@parameters_passed@, result);
        }
    }
    for (int k = 0; k < result->count; k++) {
        if (result->solutions[k].dimension == 0) {
            const @name@_ik_solution from = result->solutions[k];
            answer_probe(goal@parameters_passed@, result, &from);
        }
    }
    for (int k = 0; k < result->count; k++) {
        is_family |= result->solutions[k].dimension > 0;
    }
    return is_family ? @NAME@_IK_FAMILY : @NAME@_IK_UNDECIDED;
}

@name@_ik_status @name@_ik(
    double pose[4][4],@given_declaration@@parameters_declaration@
    @name@_ik_result *result)
{
    double goal[4][4];
    @name@_ik_status status;
    result->count = 0;
    result->off = 0.0;
    status = answer_goal(pose, goal, &result->off);@given_check@@parameters_check@
    if (status != @NAME@_IK_SOLVED) {
        return status;
    }
    if (answer_solve(@solve_goal@@given_passed@@parameters_passed@, result)) {
        return result->count > 0 ? @NAME@_IK_SOLVED : @NAME@_IK_NO_SOLUTION;
    }
    return answer_singular(goal@given_passed@@parameters_passed@, result);
}
