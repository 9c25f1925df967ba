#define IKFAST_HAS_LIBRARY
#include "ikfast.h"

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

/* Not every version of the header declares these. */
IKFAST_API bool ComputeIk2(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions,
    void *manipulator);
IKFAST_API int *GetFreeParameters();

/* Goals: translations, rotations or directions or angles, values of joints that are given. */
enum { GOALS = @goals@, KNOWN = @known_count@, CONFIGURATIONS = @configurations@ };

static const double goals[GOALS][12 + @given_count@] = {
@goal_rows@
};

/* All configurations, those of goal v from first[v] on, and which of them are one of a family. */
static const int first[GOALS + 1] = {
@first@
};

static const double known[KNOWN][@n@] = {
@known@
};

static const int is_member[KNOWN] = {
@is_member@
};

/* What a joint may be off by. */
static const double tolerances[GOALS] = {
@tolerances@
};

/* How far poses of solutions may be from the goal, lengths divided by the arm's size. */
static const double offs[GOALS] = {
@offs@
};

/* Configurations, and their translations and rotations from the product of the link transforms. */
static const double configurations[CONFIGURATIONS][@n@] = {
@configuration_rows@
};

static const double poses[CONFIGURATIONS][12] = {
@pose_rows@
};

/* What these may be off by. */
static const double pose_tolerances[12] = {
@pose_tolerances@
};

static const bool turns[@n@] = {@turns@};
static const int rotation_count = @rotation_count@;

static int failures;

static void fail(const char *what, int where, double off)
{
    std::printf("%s %d: %.3g\n", what, where, off);
    failures++;
}

static double difference(double a, double b, bool is_angle)
{
    const double turn = 6.283185307179586;
    const double off = a - b;
    return std::fabs(is_angle ? off - turn * std::floor(off / turn + 0.5) : off);
}

/* Keeps what it is told. */
struct Kept : ikfast::IkSolutionList<double> {
    std::vector<std::vector<ikfast::IkSingleDOFSolutionBase<double> > > joints;

    std::size_t AddSolution(
        const std::vector<ikfast::IkSingleDOFSolutionBase<double> > &vinfos,
        const std::vector<int> &vfree) override
    {
        joints.push_back(vinfos);
        return ikfast::IkSolutionList<double>::AddSolution(vinfos, vfree);
    }
};

/* The configuration of a solution whose free joints have the values that they have in q. */
static std::vector<double> at(const ikfast::IkSolutionBase<double> &solution, const double *q)
{
    std::vector<double> values(solution.GetFree().size() + 1);
    for (std::size_t k = 0; k < solution.GetFree().size(); k++) {
        values[k] = q[solution.GetFree()[k]];
    }
    std::vector<double> joints(@n@);
    solution.GetSolution(&joints[0], &values[0]);
    return joints;
}

static void test_goal(int v)
{
    double joint_values[@given_count@ + 1] = {0};
    for (int k = 0; k < @given_count@; k++) {
        joint_values[k] = goals[v][12 + k];
    }
    Kept found;
    const bool is_reached = ComputeIk(goals[v], goals[v] + 3, joint_values, found);
    const int expected = first[v + 1] - first[v];
    const int count = static_cast<int>(found.GetNumSolutions());
    if (is_reached != (expected > 0)) {
        fail("answer to goal", v, is_reached ? 1.0 : 0.0);
    }
    /* Members of one family may be known apart. */
    int families = 0;
    for (std::size_t s = 0; s < found.GetNumSolutions(); s++) {
        families += found.GetSolution(s).GetFree().empty() ? 0 : 1;
    }
    if (families == 0 ? count != expected : count > expected) {
        fail("number of solutions of goal", v, count);
    }
    for (int e = first[v]; e < first[v + 1]; e++) {
        double nearest = HUGE_VAL;
        for (std::size_t s = 0; s < found.GetNumSolutions(); s++) {
            const std::vector<double> joints = at(found.GetSolution(s), known[e]);
            double apart = found.GetSolution(s).GetFree().empty() || is_member[e] ? 0.0 : HUGE_VAL;
            for (int j = 0; j < @n@; j++) {
                apart = std::fmax(
                    apart, difference(joints[static_cast<std::size_t>(j)], known[e][j], turns[j]));
            }
            nearest = std::fmin(nearest, apart);
        }
        if (!(nearest <= tolerances[v])) {
            fail("solution of goal", v, nearest);
        }
    }
    /* Members of families, wherever their free joints are. */
    for (std::size_t s = 0; s < found.GetNumSolutions(); s++) {
        for (int step = -2; step <= 2; step++) {
            const double q[@n@] = {@steps@};
            double trans[3] = {0, 0, 0};
            double rot[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            ComputeFk(&at(found.GetSolution(s), q)[0], trans, rot);
            double off = 0.0;
            for (int k = 0; k < 3 + rotation_count; k++) {
                const double value = k < 3 ? trans[k] / @size@ : rot[k - 3];
                const double wanted = k < 3 ? goals[v][k] / @size@ : goals[v][k];
                off = std::fmax(off, difference(value, wanted, rotation_count == 1 && k == 3));
            }
            if (!(off <= offs[v])) {
                fail("pose of a solution of goal", v, off);
            }
        }
    }
    /* No two have the same roots. */
    for (std::size_t s = 0; s < found.joints.size(); s++) {
        for (std::size_t t = 0; t < s; t++) {
            bool is_same = families == 0;
            for (std::size_t j = 0; j < @n@; j++) {
                is_same = is_same && found.joints[s][j].indices[0] == found.joints[t][j].indices[0];
            }
            if (is_same) {
                fail("roots of goal", v, static_cast<double>(s));
            }
        }
        for (std::size_t j = 0; j < @n@; j++) {
            const int most = found.joints[s][j].maxsolutions;
            if (most > 0 ? found.joints[s][j].indices[0] >= most
                         : found.joints[s][j].indices[0] != 0xff) {
                fail("root of goal", v, found.joints[s][j].indices[0]);
            }
        }
    }
    Kept again;
    if (ComputeIk2(goals[v], goals[v] + 3, joint_values, again, nullptr) != is_reached
        || again.GetNumSolutions() != found.GetNumSolutions()) {
        fail("ComputeIk2, goal", v, 0.0);
    }
}

static void test_configuration(int v)
{
    double pose[12] = {0};
    ComputeFk(configurations[v], pose, pose + 3);
    for (int k = 0; k < 3 + rotation_count; k++) {
        const double off = difference(pose[k], poses[v][k], rotation_count == 1 && k == 3);
        if (!(off <= pose_tolerances[k])) {
            fail("pose of configuration", v, off);
        }
    }
}

int main()
{
    static const int given[@given_count@ + 1] = {@given@};
    if (GetNumJoints() != @n@ || GetNumFreeParameters() != @given_count@
        || GetIkRealSize() != static_cast<int>(sizeof(double)) || GetIkType() != @type@
        || std::strcmp(GetIkFastVersion(), "61") != 0 || std::strcmp(GetKinematicsHash(), "") != 0) {
        fail("facts of the arm", 0, 0.0);
    }
    for (int k = 0; k < @given_count@; k++) {
        if (GetFreeParameters()[k] != given[k]) {
            fail("given joint", k, GetFreeParameters()[k]);
        }
    }
    for (int v = 0; v < GOALS; v++) {
        test_goal(v);
    }
    for (int v = 0; v < CONFIGURATIONS; v++) {
        test_configuration(v);
    }
    if (failures == 0) {
        std::puts("@name@: all configurations agree");
    }
    return failures != 0;
}
