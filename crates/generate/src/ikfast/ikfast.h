/*
 * The declarations of IKFast's interface that generated files and their tests need, written to its documentation.
 *
 * For the test alone: a project that takes such files has a header of this name of its own.
 */
#ifndef IKFAST_HEADER_COMMON
#define IKFAST_HEADER_COMMON

#include <vector>

#define IKFAST_VERSION 61

namespace ikfast {

/* A joint of a solution: fmul * (free value number freeind) + foffset, or foffset where freeind is -1. */
template <typename T>
struct IkSingleDOFSolutionBase {
    T fmul;
    T foffset;
    signed char freeind;
    /* 0x01 turns, 0x11 slides. */
    unsigned char jointtype;
    /* How many roots there are at most, and which of them this is; 0xff where there is none. */
    unsigned char maxsolutions;
    unsigned char indices[5];

    IkSingleDOFSolutionBase()
        : fmul(0), foffset(0), freeind(-1), jointtype(0x01), maxsolutions(1)
    {
        for (int k = 0; k < 5; k++) {
            indices[k] = 0xff;
        }
    }
};

/* A configuration, or a family of them with free values. */
template <typename T>
class IkSolutionBase {
public:
    virtual ~IkSolutionBase() {}
    virtual void GetSolution(T *solution, const T *freevalues) const = 0;
    /* The joints that are free, from 0. */
    virtual const std::vector<int> &GetFree() const = 0;
    virtual int GetDOF() const = 0;
};

/* All of them. */
template <typename T>
class IkSolutionListBase {
public:
    virtual ~IkSolutionListBase() {}
    virtual std::size_t AddSolution(
        const std::vector<IkSingleDOFSolutionBase<T> > &vinfos, const std::vector<int> &vfree) = 0;
    virtual const IkSolutionBase<T> &GetSolution(std::size_t index) const = 0;
    virtual std::size_t GetNumSolutions() const = 0;
    virtual void Clear() = 0;
};

template <typename T>
class IkSolution : public IkSolutionBase<T> {
public:
    std::vector<IkSingleDOFSolutionBase<T> > joints;
    std::vector<int> free_joints;

    void GetSolution(T *solution, const T *freevalues) const override
    {
        const T half = static_cast<T>(3.141592653589793);
        for (std::size_t j = 0; j < joints.size(); j++) {
            const IkSingleDOFSolutionBase<T> &joint = joints[j];
            solution[j] = joint.foffset;
            if (joint.freeind >= 0) {
                solution[j] += joint.fmul * freevalues[static_cast<std::size_t>(joint.freeind)];
                while (solution[j] > half) {
                    solution[j] -= 2 * half;
                }
                while (solution[j] <= -half) {
                    solution[j] += 2 * half;
                }
            }
        }
    }

    const std::vector<int> &GetFree() const override
    {
        return free_joints;
    }

    int GetDOF() const override
    {
        return static_cast<int>(joints.size());
    }
};

template <typename T>
class IkSolutionList : public IkSolutionListBase<T> {
public:
    std::size_t AddSolution(
        const std::vector<IkSingleDOFSolutionBase<T> > &vinfos,
        const std::vector<int> &vfree) override
    {
        IkSolution<T> one;
        one.joints = vinfos;
        one.free_joints = vfree;
        solutions.push_back(one);
        return solutions.size() - 1;
    }

    const IkSolutionBase<T> &GetSolution(std::size_t index) const override
    {
        return solutions.at(index);
    }

    std::size_t GetNumSolutions() const override
    {
        return solutions.size();
    }

    void Clear() override
    {
        solutions.clear();
    }

private:
    std::vector<IkSolution<T> > solutions;
};

} // namespace ikfast

#endif

/* Of the file that includes this. */
#ifdef IKFAST_HAS_LIBRARY

#if !defined(IKFAST_CLIBRARY)
#define IKFAST_API
#elif defined(_MSC_VER)
#define IKFAST_API extern "C" __declspec(dllexport)
#else
#define IKFAST_API extern "C"
#endif

#ifdef IKFAST_NAMESPACE
namespace IKFAST_NAMESPACE {
#endif

#ifdef IKFAST_REAL
typedef IKFAST_REAL IkReal;
#else
typedef double IkReal;
#endif

IKFAST_API bool ComputeIk(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions);
IKFAST_API bool ComputeIk2(
    const IkReal *eetrans,
    const IkReal *eerot,
    const IkReal *pfree,
    ikfast::IkSolutionListBase<IkReal> &solutions,
    void *manipulator);
IKFAST_API void ComputeFk(const IkReal *joints, IkReal *eetrans, IkReal *eerot);
IKFAST_API int GetNumFreeParameters();
IKFAST_API int *GetFreeParameters();
IKFAST_API const int *GetFreeIndices();
IKFAST_API int GetNumJoints();
IKFAST_API int GetIkRealSize();
IKFAST_API int GetIkType();
IKFAST_API const char *GetIkFastVersion();
IKFAST_API const char *GetKinematicsHash();

#ifdef IKFAST_NAMESPACE
}
#endif

#endif
