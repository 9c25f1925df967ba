
/* The configurations of a goal; false if none is found. */
IKFAST_API bool ComputeIk(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions)
{
    return @name@_solver::all(eetrans, eerot, pfree, solutions);
}

/* The same; the manipulator of OpenRAVE is not looked at. */
IKFAST_API bool ComputeIk2(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions,
    void * /* manipulator */)
{
    return @name@_solver::all(eetrans, eerot, pfree, solutions);
}

/* What ComputeIk takes, at a configuration. */
IKFAST_API void ComputeFk(const IkReal *joints, IkReal *eetrans, IkReal *eerot)
{
    @name@_solver::forward(joints, eetrans, eerot);
}

IKFAST_API int GetNumFreeParameters()
{
    return @given_count@;
}

/* The joints whose values stand in pfree, counted from 0. */
IKFAST_API int *GetFreeParameters()
{
@free_parameters@}

/* The same, as later versions of the interface call it. */
IKFAST_API const int *GetFreeIndices()
{
    return GetFreeParameters();
}

IKFAST_API int GetNumJoints()
{
    return @n@;
}

IKFAST_API int GetIkRealSize()
{
    return static_cast<int>(sizeof(IkReal));
}

/* @type_name@ */
IKFAST_API int GetIkType()
{
    return @type@;
}

/* The version of the interface, in whose sense the tool is part of the transform. */
IKFAST_API const char *GetIkFastVersion()
{
    return "61";
}

/* Empty: nothing to compare. OpenRAVE's hash is of its own model of a robot. */
IKFAST_API const char *GetKinematicsHash()
{
    return "";
}

#ifdef IKFAST_NAMESPACE
} // namespace
#endif

#ifndef IKFAST_NO_MAIN
#include <cstdio>
#include <cstdlib>
#ifdef IKFAST_NAMESPACE
using namespace IKFAST_NAMESPACE;
#endif

/* Prints all configurations of the goal in the arguments. */
int main(int count, char **words)
{
    IkReal eetrans[3] = {0, 0, 0};
    IkReal eerot[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    IkReal pfree[@given_count@ + 1] = {0};
    if (count != 1 + @arguments_count@) {
        std::printf("usage: %s @usage@\n", words[0]);
        return 1;
    }
@arguments@    for (int k = 0; k < @given_count@; k++) {
        pfree[k] = static_cast<IkReal>(std::atof(words[1 + @goal_count@ + k]));
    }
    ikfast::IkSolutionList<IkReal> solutions;
    if (!ComputeIk(eetrans, eerot, pfree, solutions)) {
        std::puts("no configuration");
        return 2;
    }
    for (std::size_t s = 0; s < solutions.GetNumSolutions(); s++) {
        const ikfast::IkSolutionBase<IkReal> &solution = solutions.GetSolution(s);
        const std::vector<IkReal> none(solution.GetFree().size() + 1);
        IkReal joints[@n@];
        solution.GetSolution(joints, &none[0]);
        for (int j = 0; j < @n@; j++) {
            std::printf("%s%.17g", j == 0 ? "" : " ", static_cast<double>(joints[j]));
        }
        std::puts(solution.GetFree().empty() ? "" : " (one of a family)");
    }
    return 0;
}
#endif
