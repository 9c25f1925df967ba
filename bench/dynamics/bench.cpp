// Generated dynamics beside Pinocchio in C++, in one program: a UR5 and a Panda with the numbers of their URDFs.
// Prints one JSON object: the unit in ns, and a figure for each entry. With GENERATED Pinocchio's generated code is there, too, with
// DYNIBO the crate dynibo, for the arms in the folder that is named.
#include <pinocchio/fwd.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "ur5v3.h"
#include "ur5v4.h"
#include "pandav3.h"
#include "pandav4.h"

#include "model.hpp"
#include "ur5.inc"
#include "panda.inc"

extern "C" {
#ifdef GENERATED
// What CppADCodeGen declares in each file; no atomic functions are called.
struct LangCAtomicFun {
    void *model, *forward, *reverse;
};
#define GENERATED_FOR(arm)                                                                                             \
    void arm##_rnea_forward_zero(const double *const *, double *const *, LangCAtomicFun);                              \
    void arm##_crba_forward_zero(const double *const *, double *const *, LangCAtomicFun);                              \
    void arm##_aba_forward_zero(const double *const *, double *const *, LangCAtomicFun);                               \
    void arm##_derivatives_forward_zero(const double *const *, double *const *, LangCAtomicFun);
GENERATED_FOR(ur5)
GENERATED_FOR(panda)
#endif
#ifdef DYNIBO
void *dynibo_robot(const char *path, size_t joints);
void dynibo_torque(void *robot, const double *state, double *torques);
void dynibo_inertia(void *robot, const double *state, double *matrix);
void dynibo_acceleration(void *robot, const double *state, double *accelerations);
#endif
}

namespace {

const int STATES = 1024, ROUNDS = 25, RUNS = 5;

void keep(double x)
{
    asm volatile("" : : "x"(x) : "memory");
}

double seconds(const std::function<void()> &run)
{
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double least(const std::function<void()> &run)
{
    double best = 1e9;
    for (int i = 0; i < RUNS; i++) {
        best = std::min(best, seconds(run));
    }
    return best;
}

struct Entry {
    std::string group, name;
    double limit; // none if 0
    std::function<void()> run;
    std::vector<double> ratios, times;
};

// States of an arm, one by one and side by side, and where results go.
template <int N> struct Arm {
    std::vector<double> states, blocks, out;
    const int lanes;
    pinocchio::Model model;
    pinocchio::Data data;
    std::vector<Eigen::VectorXd> q, v, a;
    void *robot = nullptr; // dynibo's

    Arm(const Link *links, unsigned seed, int lanes)
        : states(3 * N * STATES), blocks(3 * N * STATES), out(64 * (3 * N + 1) * N), lanes(lanes), model(model_of(links, N)), data(model)
    {
        unsigned long long state = seed;
        for (int i = 0; i < STATES; i++) {
            for (int j = 0; j < 3 * N; j++) {
                state = state * 6364136223846793005ull + 1442695040888963407ull;
                const double unit = (double)(state >> 11) / 9007199254740992.0;
                const double x = (j < N ? 3.1 : 2.0) * (2.0 * unit - 1.0);
                states[3 * N * i + j] = x;
                blocks[lanes * (3 * N * (i / lanes) + j) + i % lanes] = x;
            }
            const double *s = &states[3 * N * i];
            q.push_back(Eigen::Map<const Eigen::VectorXd>(s, N));
            v.push_back(Eigen::Map<const Eigen::VectorXd>(s + N, N));
            a.push_back(Eigen::Map<const Eigen::VectorXd>(s + 2 * N, N));
        }
    }
};

std::vector<Entry> entries;
double worst;

void hold(const double *ours, const double *theirs, int count)
{
    double size = 1e-3;
    for (int k = 0; k < count; k++) {
        size = std::max(size, std::fabs(theirs[k]));
    }
    for (int k = 0; k < count; k++) {
        const double off = std::fabs(ours[k] - theirs[k]) / size;
        worst = off <= worst ? worst : off;
    }
}

template <int N, class F> void one(Arm<N> &arm, const char *group, const std::string &name, double limit, F f)
{
    entries.push_back({group, name + ", one state", limit,
                       [&arm, f] {
                           for (int i = 0; i < STATES; i++) {
                               f(&arm.states[3 * N * i], &arm.out[0]);
                               keep(arm.out[0]);
                           }
                       },
                       {},
                       {}});
}

template <int N, class F> void block(Arm<N> &arm, const char *group, const std::string &name, double limit, F f)
{
    entries.push_back({group, name + ", blocks of " + std::to_string(arm.lanes), limit,
                       [&arm, f] {
                           for (int i = 0; i < STATES / arm.lanes; i++) {
                               f(&arm.blocks[3 * N * arm.lanes * i], &arm.out[0]);
                               keep(arm.out[0]);
                           }
                       },
                       {},
                       {}});
}

template <int N, class F> void peer(Arm<N> &arm, const std::string &group, const char *name, F f)
{
    entries.push_back({group, name, 0,
                       [&arm, f] {
                           for (int i = 0; i < STATES; i++) {
                               f(i);
                           }
                       },
                       {},
                       {}});
}

// Pinocchio's generated code: the states are its inputs as they stand.
template <int N, class F> void generated(Arm<N> &arm, const std::string &group, const char *name, F f)
{
    peer<N>(arm, group, name, [&arm, f](int i) {
        f(&arm.states[3 * N * i], &arm.out[0]);
        keep(arm.out[0]);
    });
}

#ifdef GENERATED
#define CALL(f)                                                                                                        \
    [](const double *x, double *y) {                                                                                   \
        const double *in[1] = {x};                                                                                     \
        double *out[1] = {y};                                                                                          \
        f(in, out, LangCAtomicFun());                                                                                  \
    }
#define GENERATED_CODE(arm, N, group, f, name)                                                                         \
    generated<N>(arm, group, "Pinocchio, generated code, " name, CALL(f##_forward_zero));
#else
#define GENERATED_CODE(arm, N, group, f, name)
#endif
#ifdef DYNIBO
#define DYNIBO_CODE(arm, N, group, f, name)                                                                            \
    generated<N>(arm, group, "dynibo, " name, [&arm](const double *x, double *y) { f(arm.robot, x, y); });
#else
#define DYNIBO_CODE(arm, N, group, f, name)
#endif

const bool is_wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");

// Entries of one function, generated for both levels of instructions: limits of one state and of blocks with AVX-512.
#define BOTH(arm, N, group, prefix, f, RESULT, first, second)                                                          \
    one<N>(arm, group, "generated C, AVX2", 0, [](const double *x, double *y) { prefix##v3_##f(x, RESULT y); });       \
    block<N>(arm, group, "generated C, AVX2", 0, [](const double *x, double *y) { prefix##v3_##f##_block(x, y); });    \
    if (is_wide) {                                                                                                     \
        one<N>(arm, group, "generated C, AVX-512", first,                                                              \
               [](const double *x, double *y) { prefix##v4_##f(x, RESULT y); });                                       \
        block<N>(arm, group, "generated C, AVX-512", second,                                                           \
                 [](const double *x, double *y) { prefix##v4_##f##_block(x, y); });                                    \
    }

// The torques and their derivatives, as Pinocchio has them together.
#define LEVEL(arm, N, group, own, name, first, second)                                                                 \
    one<N>(arm, group, name, first, [](const double *x, double *y) {                                                   \
        own##_torque_with_derivatives(x, (double(*)[3 * N + 1])y);                                                     \
    });                                                                                                                \
    block<N>(arm, group, name, second, [](const double *x, double *y) {                                                \
        own##_torque_with_derivatives_block(x, y);                                                                     \
    });
#define DERIVED(arm, N, group, prefix, first, second)                                                                  \
    LEVEL(arm, N, group, prefix##v3, "generated C, AVX2", 0, 0)                                                        \
    if (is_wide) {                                                                                                     \
        LEVEL(arm, N, group, prefix##v4, "generated C, AVX-512", first, second)                                        \
    }

// Torques, matrices and accelerations of the other peers, held against Pinocchio's.
template <int N> void hold_dynibo(Arm<N> &arm, const std::string &folder, const char *name)
{
#ifdef DYNIBO
    arm.robot = dynibo_robot((folder + "/" + name + ".urdf").c_str(), N);
    if (!arm.robot) {
        fprintf(stderr, "dynibo has other joints for %s\n", name);
        exit(1);
    }
    pinocchio::Model model = arm.model;
    model.gravity.linear() = Eigen::Vector3d(0, 0, -9.80665); // as dynibo has it
    double y[N * N];
    for (int i = 0; i < STATES; i++) {
        const double *x = &arm.states[3 * N * i];
        dynibo_torque(arm.robot, x, y);
        hold(y, pinocchio::rnea(model, arm.data, arm.q[i], arm.v[i], arm.a[i]).data(), N);
        dynibo_acceleration(arm.robot, x, y);
        const Eigen::VectorXd qdd = pinocchio::aba(model, arm.data, arm.q[i], arm.v[i], arm.a[i]);
        hold(y, qdd.data(), N);
        dynibo_inertia(arm.robot, x, y);
        pinocchio::crba(model, arm.data, arm.q[i]);
        for (int r = 0; r < N; r++) {
            for (int c = r; c < N; c++) {
                const double theirs = arm.data.M(r, c);
                hold(y + N * r + c, &theirs, 1);
            }
        }
    }
#else
    (void)arm, (void)folder, (void)name;
#endif
}

#ifdef GENERATED
#define OTHERS(arm, N, prefix)                                                                                         \
    for (int i = 0; i < STATES; i++) {                                                                                 \
        const double *x = &arm.states[3 * N * i];                                                                      \
        double y[3 * N * N];                                                                                           \
        CALL(prefix##_rnea_forward_zero)(x, y);                                                                        \
        hold(y, pinocchio::rnea(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]).data(), N);                         \
        CALL(prefix##_aba_forward_zero)(x, y);                                                                         \
        const Eigen::VectorXd qdd = pinocchio::aba(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);                 \
        hold(y, qdd.data(), N);                                                                                        \
        CALL(prefix##_derivatives_forward_zero)(x, y);                                                                 \
        pinocchio::computeRNEADerivatives(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);                          \
        for (int r = 0; r < N; r++) {                                                                                  \
            const Eigen::VectorXd row = arm.data.dtau_dq.row(r);                                                       \
            hold(y + N * r, row.data(), N);                                                                            \
        }                                                                                                              \
    }
#else
#define OTHERS(arm, N, prefix)
#endif

#define ARM(prefix, N, title, L, lanes)                                                                                \
    static Arm<N> prefix(prefix##_links, N, lanes);                                                                    \
    {                                                                                                                  \
        auto &arm = prefix;                                                                                            \
        hold_dynibo<N>(arm, folder, #prefix);                                                                          \
        double tau[N], inertia[N][N], qdd[N], by[N][3 * N], all[N][3 * N + 1];                                          \
        for (int i = 0; i < STATES; i++) {                                                                             \
            const double *x = &arm.states[3 * N * i];                                                                  \
            prefix##v3_torque(x, tau);                                                                                 \
            hold(tau, pinocchio::rnea(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]).data(), N);                   \
            prefix##v3_acceleration(x, qdd);                                                                           \
            const Eigen::VectorXd theirs = pinocchio::aba(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);          \
            hold(qdd, theirs.data(), N);                                                                               \
            pinocchio::computeRNEADerivatives(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);                      \
            prefix##v3_torque_derivatives(x, by);                                                                      \
            prefix##v3_torque_with_derivatives(x, all);                                                                \
            prefix##v3_inertia(x, inertia);                                                                            \
            for (int r = 0; r < N; r++) {                                                                              \
                const Eigen::VectorXd first = arm.data.dtau_dq.row(r), second = arm.data.dtau_dv.row(r);               \
                hold(by[r], first.data(), N);                                                                          \
                hold(by[r] + N, second.data(), N);                                                                     \
                hold(by[r] + 2 * N, inertia[r], N);                                                                    \
                hold(all[r], tau + r, 1);                                                                              \
                hold(all[r] + 1, by[r], 3 * N);                                                                        \
            }                                                                                                          \
        }                                                                                                              \
        OTHERS(arm, N, prefix)                                                                                         \
        BOTH(arm, N, title ": torque", prefix, torque, , L[0], L[1])                                                   \
        peer<N>(arm, title ": torque", "Pinocchio, rnea", [&arm](int i) {                                              \
            pinocchio::rnea(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);                                        \
            keep(arm.data.tau[0]);                                                                                     \
        });                                                                                                            \
        GENERATED_CODE(arm, N, title ": torque", prefix##_rnea, "rnea")                                                \
        DYNIBO_CODE(arm, N, title ": torque", dynibo_torque, "inverse_dynamics")                                       \
        BOTH(arm, N, title ": inertia matrix", prefix, inertia, (double(*)[N]), L[2], L[3])                            \
        peer<N>(arm, title ": inertia matrix", "Pinocchio, crba (half of it)", [&arm](int i) {                         \
            pinocchio::crba(arm.model, arm.data, arm.q[i], pinocchio::Convention::LOCAL);                              \
            keep(arm.data.M(0, 0));                                                                                    \
        });                                                                                                            \
        GENERATED_CODE(arm, N, title ": inertia matrix", prefix##_crba, "crba (half of it)")                           \
        DYNIBO_CODE(arm, N, title ": inertia matrix", dynibo_inertia, "mass_matrix")                                   \
        BOTH(arm, N, title ": acceleration", prefix, acceleration, , L[4], L[5])                                       \
        peer<N>(arm, title ": acceleration", "Pinocchio, aba", [&arm](int i) {                                         \
            pinocchio::aba(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i], pinocchio::Convention::LOCAL);           \
            keep(arm.data.ddq[0]);                                                                                     \
        });                                                                                                            \
        GENERATED_CODE(arm, N, title ": acceleration", prefix##_aba, "aba")                                            \
        DYNIBO_CODE(arm, N, title ": acceleration", dynibo_acceleration, "forward_dynamics")                           \
        DERIVED(arm, N, title ": torque with derivatives", prefix, L[6], L[7])                                         \
        peer<N>(arm, title ": torque with derivatives", "Pinocchio, computeRNEADerivatives", [&arm](int i) {           \
            pinocchio::computeRNEADerivatives(arm.model, arm.data, arm.q[i], arm.v[i], arm.a[i]);                      \
            keep(arm.data.dtau_dq(0, 0));                                                                              \
        });                                                                                                            \
        GENERATED_CODE(arm, N, title ": torque with derivatives", prefix##_derivatives, "computeRNEADerivatives")      \
    }

double quantile(std::vector<double> list, double part)
{
    std::sort(list.begin(), list.end());
    return list[(size_t)(part * (double)(list.size() - 1) + 0.5)];
}

} // namespace

int main(int count, char **arguments)
{
    const std::string folder = count > 1 ? arguments[1] : ".";
    const double ur5_limits[8] = {0.75, 0.16, 0.75, 0.15, 1.6, 0.3, 2.6, 0.5};
    const double panda_limits[8] = {1.4, 0.32, 0, 0, 0, 0, 0, 0};
    ARM(ur5, 6, "UR5", ur5_limits, UR5V3_LANES)
    ARM(panda, 7, "Panda", panda_limits, PANDAV3_LANES)
    if (!(worst <= 1e-9)) {
        fprintf(stderr, "generated code and Pinocchio differ by %g of the size\n", worst);
        return 1;
    }
    std::vector<double> angles;
    for (int i = 0; i < STATES; i++) {
        angles.insert(angles.end(), &ur5.states[18 * i], &ur5.states[18 * i] + 6);
    }
    std::vector<double> sines(angles.size()), cosines(angles.size());
    const std::function<void()> unit = [&] {
        for (size_t k = 0; k < angles.size(); k++) {
            sincos(angles[k], &sines[k], &cosines[k]);
        }
        keep(sines[0]);
    };
    std::vector<double> units;
    for (int round = 0; round < ROUNDS; round++) {
        for (Entry &entry : entries) {
            const double u = least(unit), own = least(entry.run);
            units.push_back(u / STATES * 1e9);
            entry.times.push_back(own / STATES * 1e9);
            entry.ratios.push_back(own / u);
        }
    }
    printf("{\"unit_ns\": %.3f, \"worst\": %g, \"figures\": [", quantile(units, 0.5), worst);
    for (size_t k = 0; k < entries.size(); k++) {
        const Entry &e = entries[k];
        printf("%s{\"group\": \"%s\", \"name\": \"%s\", \"ratio\": %.4f, \"quartiles\": [%.4f, %.4f], \"ns\": %.2f", k ? ", " : "",
               e.group.c_str(), e.name.c_str(), quantile(e.ratios, 0.5), quantile(e.ratios, 0.25), quantile(e.ratios, 0.75),
               quantile(e.times, 0.5));
        if (e.limit > 0) {
            printf(", \"limit\": %g", e.limit);
        }
        printf("}");
    }
    printf("], \"beside\": [");
    // What the better of our two levels takes of the time of Pinocchio's generated code.
    const std::string level = is_wide ? "generated C, AVX-512, " : "generated C, AVX2, ";
    bool is_first = true;
    for (const Entry &theirs : entries) {
        if (theirs.name.find("Pinocchio, generated code") != 0) {
            continue;
        }
        for (const Entry &own : entries) {
            if (own.group != theirs.group || own.name.find(level) != 0) {
                continue;
            }
            std::vector<double> parts;
            for (int round = 0; round < ROUNDS; round++) {
                parts.push_back(own.times[(size_t)round] / theirs.times[(size_t)round]);
            }
            printf("%s{\"group\": \"%s\", \"name\": \"%s\", \"part\": %.4f}", is_first ? "" : ", ", own.group.c_str(),
                   own.name.c_str(), quantile(parts, 0.5));
            is_first = false;
        }
    }
    printf("]}\n");
    return 0;
}
