
static void test_@f@()
{
    /* Enough for several thread blocks, the last one not full. */
    const size_t count = 1000;
    for (size_t v = 0; v < @F@_VECTORS; v++) {
@parameters@
        std::vector<real> q(VARIABLES * count);
        for (size_t i = 0; i < count; i++) {
            for (size_t j = 0; j < VARIABLES; j++) {
                q[j * count + i] = (real)@f@_variables[(v + i) % @F@_VECTORS][j];
            }
        }
        const auto launch = [&](const real *in, real *out) {
            const unsigned blocks = (unsigned)((count + 255) / 256);
            @name@_@f@_kernel<<<blocks, 256>>>(count, in, @argument@out);
        };
        const std::vector<real> values = run(q, @F@_RESULTS * count, launch);
        for (size_t k = 0; k < @F@_RESULTS; k++) {
            const double expected = @f@_results[v][k];
            const double allowed = tolerance(@f@_variables[v]) * @f@_scales[k];
            for (size_t i = 0; i < count; i += @F@_VECTORS) {
                const double value = (double)values[k * count + i];
                if (!(std::fabs(value - expected) <= allowed)) {
                    std::printf("@f@, configuration %d, result %d: ", (int)v, (int)k);
                    std::printf("%.17g, expected %.17g within %.2g\n", value, expected, allowed);
                    failures++;
                }
            }
        }
    }
}
