#include "@name@.cu"

#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cuda_runtime.h>
#include <vector>

static int failures;

static void must(cudaError_t status)
{
    if (status != cudaSuccess) {
        std::printf("%s\n", cudaGetErrorString(status));
        std::exit(1);
    }
}

/* Runs a kernel on configurations side by side and returns the results side by side. */
template <class Launch>
static std::vector<real> run(const std::vector<real> &q, size_t results, Launch launch)
{
    real *device_q, *device_results;
    std::vector<real> values(results);
    must(cudaMalloc(&device_q, q.size() * sizeof(real)));
    must(cudaMalloc(&device_results, results * sizeof(real)));
    must(cudaMemcpy(device_q, q.data(), q.size() * sizeof(real), cudaMemcpyHostToDevice));
    launch(device_q, device_results);
    must(cudaGetLastError());
    must(cudaMemcpy(values.data(), device_results, results * sizeof(real), cudaMemcpyDeviceToHost));
    must(cudaFree(device_q));
    must(cudaFree(device_results));
    return values;
}
