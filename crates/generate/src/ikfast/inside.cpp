
/*
 * What the interface adds: goals of translations and rotations, and configurations joint by joint.
 */

/* 1 for joints that turn, 0x11 for those that slide, as IKFast numbers them. */
static const unsigned char joint_types[@n@] = {@joint_types@};
/* Joints whose values are given. */
static const bool is_given[@n@] = {@is_given@};
/* Joints that can be free: not given, and all links come back after a whole turn. */
static const bool can_be_free[@n@] = {@can_be_free@};
/* How many roots the equation has that finds a joint, and what they add to the number of a branch. */
static const unsigned char joint_roots[@n@] = {@joint_roots@};
static const int joint_strides[@n@] = {@joint_strides@};
/* The columns of the pose that the goal is about. */
static const bool is_wanted[4] = {@is_wanted@};

@kind@
/* A configuration, and how its joints follow free values. */
struct member {
    double q[@n@];
    /* The free value that a joint follows, or -1; and how. */
    int follows[@n@];
    double factors[@n@];
    int free_values;
};

/* The configuration with free values that are all t. */
static void moved(const member &from, double t, double q[@n@])
{
    for (int j = 0; j < @n@; j++) {
        q[j] = from.q[j] + from.factors[j] * t;
    }
}

/* Whether the hand stands still where joints i and j turn, one by t and the other by factor t. */
static bool is_still(const member &from, int i, int j, double factor)
{
    static const double steps[4] = {0.9, 2.0, -1.3, -2.6};
    for (int s = 0; s < 4; s++) {
        double q[@n@];
        double pose[4][4], other[4][4];
        moved(from, s < 2 ? 0.0 : 0.7, q);
        @name@_fk(q, pose);
        q[j] += factor * steps[s];
        q[i] += steps[s];
        @name@_fk(q, other);
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 4; column++) {
                const double off = fabs(other[row][column] - pose[row][column]);
                if (is_wanted[column] && !(off <= (column == 3 ? @near@ : 1e-9))) {
                    return false;
                }
            }
        }
    }
    return true;
}

static double in_one_turn(double angle)
{
    const double turn = 6.283185307179586;
    const double rest = angle - turn * floor(angle / turn + 0.5);
    return rest <= -0.5 * turn ? rest + turn : rest;
}

/* Looks for joints whose turns cancel, or do not matter, and brings the member with free values of 0. */
static void widen(member &found)
{
    for (int i = 0; i < @n@; i++) {
        for (int k = 0; k < 2 * (@n@ - i) - 1; k++) {
            /* Alone, or with a later joint, in either sense. */
            const int j = i + (k + 1) / 2;
            const double factor = k == 0 ? 0.0 : k % 2 == 0 ? 1.0 : -1.0;
            const bool are_left = can_be_free[i] && can_be_free[j] && found.follows[i] < 0
                && found.follows[j] < 0;
            if (are_left && is_still(found, i, j, factor)) {
                found.q[j] = in_one_turn(found.q[j] - factor * found.q[i]);
                found.follows[j] = found.free_values;
                found.factors[j] = factor;
                found.q[i] = 0.0;
                found.follows[i] = found.free_values++;
                found.factors[i] = 1.0;
            }
        }
    }
}

static bool are_same(const member &a, const member &b)
{
    for (int j = 0; j < @n@; j++) {
        const double off = joint_types[j] == 0x01 ? in_one_turn(a.q[j] - b.q[j]) : a.q[j] - b.q[j];
        if (a.follows[j] != b.follows[j] || !(fabs(off) <= 1e-6)) {
            return false;
        }
    }
    return true;
}

/* Adds a configuration, a branch each, to the solutions of the interface. */
static void add(
    const member &found,
    int branch,
    std::vector<ikfast::IkSingleDOFSolutionBase<IkReal> > &joints,
    ikfast::IkSolutionListBase<IkReal> &solutions)
{
    std::vector<int> free_joints(static_cast<std::size_t>(found.free_values));
    for (int j = 0; j < @n@; j++) {
        ikfast::IkSingleDOFSolutionBase<IkReal> &joint = joints[static_cast<std::size_t>(j)];
        const int follows = found.follows[j];
        const bool is_fixed = follows < 0 && !is_given[j];
        joint.jointtype = joint_types[j];
        joint.foffset = static_cast<IkReal>(found.q[j]);
        joint.fmul = static_cast<IkReal>(found.factors[j]);
        joint.freeind = static_cast<signed char>(follows);
        joint.maxsolutions = static_cast<unsigned char>(is_fixed ? joint_roots[j] : 0);
        joint.indices[0] = static_cast<unsigned char>(
            is_fixed ? branch / joint_strides[j] % joint_roots[j] : 0xff);
    }
    /* Of those that follow a value the first is the free one: the last to write here. */
    for (int j = @n@ - 1; j >= 0; j--) {
        if (found.follows[j] >= 0) {
            free_joints[static_cast<std::size_t>(found.follows[j])] = j;
        }
    }
    solutions.AddSolution(joints, free_joints);
}

static bool all(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions)
{
    @name@_solve_solution found[@NAME@_SOLVE_MAX];
    @name@_solve_certificate certificate;
    double goal[@goal_size@];
    solutions.Clear();
    read_goal(eetrans, eerot, goal);
@read_given@    const int count = @name@_solve(goal, found, &certificate);
#ifdef IKFAST_ASSERT
    IKFAST_ASSERT(certificate != @NAME@_SOLVE_NOT_A_POSE);
#endif
    std::vector<ikfast::IkSingleDOFSolutionBase<IkReal> > joints(@n@);
    member families[@NAME@_SOLVE_MAX];
    int known = 0;
    for (int s = 0; s < count; s++) {
        member &own = families[known];
        own.free_values = 0;
        for (int j = 0; j < @n@; j++) {
            own.q[j] = found[s].q[j];
            own.follows[j] = -1;
            own.factors[j] = 0.0;
        }
        if (@is_family@) {
            widen(own);
        }
        bool is_new = true;
        for (int k = 0; k < known && own.free_values > 0; k++) {
            is_new = is_new && !are_same(own, families[k]);
        }
        if (is_new) {
            add(own, @branch@, joints, solutions);
            known += own.free_values > 0 ? 1 : 0;
        }
    }
    return count > 0;
}

static void forward(const IkReal *joints, IkReal *eetrans, IkReal *eerot)
{
    double q[@n@];
    double pose[4][4];
    for (int j = 0; j < @n@; j++) {
        q[j] = static_cast<double>(joints[j]);
    }
    @name@_fk(q, pose);
    write_goal(pose, eetrans, eerot);
}
