// Generated CUDA beside generated C on the same configurations: what the kernels give, and how fast.
// Prints one JSON object: the device, its copy in bytes a second, and a figure for each kernel.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "ur5_double_cuda.cu"
#include "ur5_float_cuda.cu"
#include "ur5_moving_double_cuda.cu"
#include "ur5_moving_float_cuda.cu"
#include "panda_double_cuda.cu"
#include "panda_float_cuda.cu"
#include "panda_moving_double_cuda.cu"
#include "panda_moving_float_cuda.cu"

#include "ur5_double_c.h"
#include "ur5_float_c.h"
#include "ur5_moving_double_c.h"
#include "ur5_moving_float_c.h"
#include "panda_double_c.h"
#include "panda_float_c.h"
#include "panda_moving_double_c.h"
#include "panda_moving_float_c.h"

// The same in long double, made of the text in C.
#include "truth.h"

namespace {

// Configurations that are timed, and those of them that are compared with C.
const size_t COUNT = (size_t)1 << 22, HELD = (size_t)1 << 16;
const unsigned THREADS = 128;
const int ROUNDS = 25;

void must(cudaError_t status)
{
    if (status != cudaSuccess) {
        fprintf(stderr, "%s\n", cudaGetErrorString(status));
        exit(1);
    }
}

// An array of the device.
template <class R> struct Array {
    R *place;
    explicit Array(size_t length)
    {
        must(cudaMalloc(&place, length * sizeof(R)));
    }
    ~Array()
    {
        cudaFree(place);
    }
    Array(const Array &) = delete;
};

// Median of what a launch takes, in seconds.
template <class Launch> double seconds(Launch launch)
{
    cudaEvent_t start, end;
    must(cudaEventCreate(&start));
    must(cudaEventCreate(&end));
    std::vector<float> times;
    for (int round = 0; round < ROUNDS + 3; round++) {
        must(cudaEventRecord(start));
        launch();
        must(cudaEventRecord(end));
        must(cudaEventSynchronize(end));
        float ms = 0.0f;
        must(cudaEventElapsedTime(&ms, start, end));
        if (round >= 3) {
            times.push_back(ms);
        }
    }
    must(cudaGetLastError());
    std::sort(times.begin(), times.end());
    return times[times.size() / 2] * 1e-3;
}

// Angles within 3.1, speeds and what follows them within 2, variable j of configuration i at [j * count + i].
template <class R> std::vector<R> configurations(size_t angles, size_t inputs)
{
    std::vector<R> values(inputs * COUNT);
    unsigned long long state = 1;
    for (size_t k = 0; k < values.size(); k++) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        const double unit = (double)(state >> 11) / 9007199254740992.0;
        values[k] = (R)((k < angles * COUNT ? 3.1 : 2.0) * (2.0 * unit - 1.0));
    }
    return values;
}

double bandwidth;
bool is_first = true;

void figure(const char *arm, const char *name, const char *real, double time, double bytes, double off, double own,
            double apart)
{
    printf("%s{\"arm\": \"%s\", \"name\": \"%s\", \"real\": \"%s\", \"ns\": %.4f, \"bytes\": %.0f, \"share\": %.4f, \"off\": %.3g, \"c\": %.3g, \"apart\": %.3g}",
           is_first ? "" : ", ", arm, name, real, time / (double)COUNT * 1e9, bytes,
           bytes * (double)COUNT / time / bandwidth, off, own, apart);
    is_first = false;
}

// Runs a kernel, C, and C in long double. `used` of the inputs are read; the differences of the kernel and of C from the last,
// and from each other, are the largest of all results, in units in the last place of the largest that any of them becomes.
template <class R, class Kernel, class C, class Truth>
void function(const char *arm, const char *name, size_t angles, size_t inputs, size_t used, size_t results, Kernel kernel, C c,
              Truth truth)
{
    const std::vector<R> q = configurations<R>(angles, inputs);
    Array<R> in(q.size()), out(results * COUNT);
    must(cudaMemcpy(in.place, q.data(), q.size() * sizeof(R), cudaMemcpyHostToDevice));
    const unsigned blocks = (unsigned)((COUNT + THREADS - 1) / THREADS);
    const double time = seconds([&] { kernel<<<blocks, THREADS>>>(COUNT, in.place, out.place); });
    std::vector<R> values(results * COUNT);
    must(cudaMemcpy(values.data(), out.place, values.size() * sizeof(R), cudaMemcpyDeviceToHost));
    double off = 0.0, of_c = 0.0, apart = 0.0, size = 0.0;
    std::vector<R> own(inputs), in_c(results);
    std::vector<long double> exact(inputs), right(results);
    for (size_t i = 0; i < HELD; i++) {
        for (size_t j = 0; j < inputs; j++) {
            exact[j] = own[j] = q[j * COUNT + i];
        }
        c(own.data(), in_c.data());
        truth(exact.data(), right.data());
        for (size_t k = 0; k < results; k++) {
            const double difference = (double)std::fabs((long double)values[k * COUNT + i] - right[k]);
            off = difference <= off ? off : difference; // also if it is no number
            apart = std::max(apart, std::fabs((double)values[k * COUNT + i] - (double)in_c[k]));
            of_c = std::max(of_c, (double)std::fabs((long double)in_c[k] - right[k]));
            size = std::max(size, std::fabs((double)right[k]));
        }
    }
    const double unit = size * std::numeric_limits<R>::epsilon();
    figure(arm, name, sizeof(R) == 8 ? "double" : "float", time, (double)((used + results) * sizeof(R)), off / unit,
           of_c / unit, apart / unit);
}

// The closed form, of the poses of random configurations: the difference is the share of poses whose number of solutions,
// certificate or solutions (within 1e-7) are not those of C, in parts of a million.
void inverse()
{
    const std::vector<double> q = configurations<double>(6, 6);
    const size_t width = 10, most = UR5_DOUBLE_C_SOLVE_MAX;
    std::vector<double> poses(12 * COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        double own[6], pose[4][4];
        for (size_t j = 0; j < 6; j++) {
            own[j] = q[j * COUNT + i];
        }
        ur5_double_c_fk(own, pose);
        for (size_t k = 0; k < 12; k++) {
            poses[k * COUNT + i] = pose[k / 4][k % 4];
        }
    }
    Array<double> in(poses.size()), out((2 + width * most) * COUNT);
    must(cudaMemcpy(in.place, poses.data(), poses.size() * sizeof(double), cudaMemcpyHostToDevice));
    const unsigned blocks = (unsigned)((COUNT + THREADS - 1) / THREADS);
    const double time = seconds([&] { ur5_double_cuda_ik_kernel<<<blocks, THREADS>>>(COUNT, in.place, out.place); });
    std::vector<double> values((2 + width * most) * COUNT);
    must(cudaMemcpy(values.data(), out.place, values.size() * sizeof(double), cudaMemcpyDeviceToHost));
    size_t others = 0, solutions = 0;
    for (size_t i = 0; i < COUNT; i++) {
        solutions += (size_t)values[i];
    }
    for (size_t i = 0; i < HELD; i++) {
        double pose[12];
        for (size_t k = 0; k < 12; k++) {
            pose[k] = poses[k * COUNT + i];
        }
        ur5_double_c_solve_solution found[UR5_DOUBLE_C_SOLVE_MAX];
        ur5_double_c_solve_certificate certificate;
        const int number = ur5_double_c_solve(pose, found, &certificate);
        bool is_same = number == (int)values[i] && (int)certificate == (int)values[COUNT + i];
        for (int s = 0; is_same && s < number; s++) {
            double nearest = HUGE_VAL;
            for (int t = 0; t < number; t++) {
                double apart = 0.0;
                for (size_t k = 0; k < 6; k++) {
                    const double difference = found[s].q[k] - values[(2 + width * (size_t)t + k) * COUNT + i];
                    apart = std::max(apart, std::fabs(std::remainder(difference, 6.283185307179586)));
                }
                nearest = std::min(nearest, apart);
            }
            is_same = nearest <= 1e-7;
        }
        others += !is_same;
    }
    const double written = 2.0 + 10.0 * (double)solutions / (double)COUNT;
    figure("UR5", "ik", "double", time, 8.0 * (12.0 + written), 0.0, 0.0, 1e6 * (double)others / (double)HELD);
}

} // namespace

#define KINEMATIC(title, prefix, R, N)                                                                                 \
    function<R>(title, "fk", N, N, N, 16, prefix##_cuda_fk_kernel,                                                     \
                [](const R *x, R *y) { prefix##_c_fk(x, (R(*)[4])y); },                                               \
                [](const long double *x, long double *y) { prefix##_truth_fk(x, (long double(*)[4])y); });                                               \
    function<R>(title, "jacobian", N, N, N, 6 * N, prefix##_cuda_jacobian_kernel,                                      \
                [](const R *x, R *y) { prefix##_c_jacobian(x, (R(*)[N])y); },                                          \
                [](const long double *x, long double *y) { prefix##_truth_jacobian(x, (long double(*)[N])y); });
#define DYNAMIC(title, prefix, R, N)                                                                                   \
    function<R>(title, "torque", N, 3 * N, 3 * N, N, prefix##_cuda_torque_kernel,                                      \
                [](const R *x, R *y) { prefix##_c_torque(x, y); },                                                     \
                [](const long double *x, long double *y) { prefix##_truth_torque(x, y); });                                                    \
    function<R>(title, "inertia", N, 3 * N, N, N * N, prefix##_cuda_inertia_kernel,                                    \
                [](const R *x, R *y) { prefix##_c_inertia(x, (R(*)[N])y); },                                           \
                [](const long double *x, long double *y) { prefix##_truth_inertia(x, (long double(*)[N])y); });                                          \
    function<R>(title, "acceleration", N, 3 * N, 3 * N, N, prefix##_cuda_acceleration_kernel,                          \
                [](const R *x, R *y) { prefix##_c_acceleration(x, y); },                                               \
                [](const long double *x, long double *y) { prefix##_truth_acceleration(x, y); });                                              \
    function<R>(title, "torque_with_derivatives", N, 3 * N, 3 * N, N * (3 * N + 1),                                    \
                prefix##_cuda_torque_with_derivatives_kernel,                                                          \
                [](const R *x, R *y) { prefix##_c_torque_with_derivatives(x, (R(*)[3 * N + 1])y); },                   \
                [](const long double *x, long double *y) {                                                             \
                    prefix##_truth_torque_with_derivatives(x, (long double(*)[3 * N + 1])y);                           \
                });

int main()
{
    cudaDeviceProp device;
    must(cudaGetDeviceProperties(&device, 0));
    {
        const size_t bytes = (size_t)1 << 31;
        Array<char> from(bytes), to(bytes);
        must(cudaMemset(from.place, 1, bytes));
        bandwidth = 2.0 * (double)bytes
            / seconds([&] { must(cudaMemcpyAsync(to.place, from.place, bytes, cudaMemcpyDeviceToDevice)); });
    }
    printf("{\"device\": \"%s\", \"copy\": %.4g, \"count\": %zu, \"held\": %zu, \"figures\": [", device.name, bandwidth, COUNT, HELD);
    KINEMATIC("UR5", ur5_double, double, 6)
    KINEMATIC("UR5", ur5_float, float, 6)
    inverse();
    DYNAMIC("UR5", ur5_moving_double, double, 6)
    DYNAMIC("UR5", ur5_moving_float, float, 6)
    KINEMATIC("Panda", panda_double, double, 7)
    KINEMATIC("Panda", panda_float, float, 7)
    DYNAMIC("Panda", panda_moving_double, double, 7)
    DYNAMIC("Panda", panda_moving_float, float, 7)
    printf("]}\n");
    return 0;
}
