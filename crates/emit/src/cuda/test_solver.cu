
static void test_@f@()
{
    static const int is_angle[@m@] = {@angles@};
    const double turn = 6.283185307179586;
    const size_t count = 1000;
    for (size_t v = 0; v < @F@_VECTORS; v++) {
@parameters@
        std::vector<double> given(@n@ * count);
        for (size_t i = 0; i < count; i++) {
            for (size_t j = 0; j < @n@; j++) {
                given[j * count + i] = @f@_variables[(v + i) % @F@_VECTORS][j];
            }
        }
        const auto launch = [&](const double *in, double *out) {
            const unsigned blocks = (unsigned)((count + 255) / 256);
            @name@_@f@_kernel<<<blocks, 256>>>(count, in, @argument@out);
        };
        const size_t width = 2 + @MAX@ * (@m@ + 4);
        const std::vector<double> values = run(given, width * count, launch);
        for (size_t i = 0; i < count; i += @F@_VECTORS) {
            const int number = (int)values[i];
            bool is_right = number == @f@_first[v + 1] - @f@_first[v];
            is_right = is_right && (int)values[count + i] == @f@_certificates[v];
            for (int e = @f@_first[v]; e < @f@_first[v + 1]; e++) {
                double nearest = HUGE_VAL;
                for (int s = 0; s < number; s++) {
                    const double *place = &values[(size_t)(2 + (@m@ + 4) * s) * count + i];
                    double apart = 0.0;
                    for (int k = 0; k < @m@; k++) {
                        double difference = place[(size_t)k * count] - @f@_known[e][k];
                        if (is_angle[k]) {
                            difference -= turn * std::floor(difference / turn + 0.5);
                        }
                        apart = std::fmax(apart, std::fabs(difference));
                    }
                    if (place[@m@ * count] <= 1e-9
                        && place[(@m@ + 1) * count] == @f@_multiplicity[e]
                        && place[(@m@ + 3) * count] == @f@_free[e]) {
                        nearest = std::fmin(nearest, apart);
                    }
                }
                is_right = is_right && nearest <= @f@_tolerance[v];
            }
            if (!is_right) {
                std::printf("@f@, configuration %d: ", (int)v);
                std::printf("%d solutions, or others\n", number);
                failures++;
            }
        }
    }
}
