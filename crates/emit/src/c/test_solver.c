
static void test_@f@(void)
{
    static const int is_angle[@m@] = {@angles@};
    const double turn = 6.283185307179586;
    for (int v = 0; v < @F@_VECTORS; v++) {
@parameters@
        @name@_@f@_solution found[@MAX@];
        @name@_@f@_certificate certificate;
        const int count =
            @name@_@f@(@f@_variables[v], @address@found, &certificate);
        if ((int)certificate != @f@_certificates[v]) {
            printf("@f@, configuration %d: certificate %d, ", v, (int)certificate);
            printf("expected %d\n", @f@_certificates[v]);
            failures++;
        }
        if (count != @f@_first[v + 1] - @f@_first[v]) {
            printf("@f@, configuration %d: %d solutions, ", v, count);
            printf("expected %d\n", @f@_first[v + 1] - @f@_first[v]);
            failures++;
        }
        /* Each known solution is found, in any order. */
        for (int e = @f@_first[v]; e < @f@_first[v + 1]; e++) {
            double nearest = HUGE_VAL;
            for (int j = 0; j < count; j++) {
                double apart = 0.0;
                for (int k = 0; k < @m@; k++) {
                    double difference = found[j].@result@[k] - @f@_known[e][k];
                    if (is_angle[k]) {
                        difference -= turn * floor(difference / turn + 0.5);
                    }
                    apart = fmax(apart, fabs(difference));
                }
                if (found[j].multiplicity == @f@_multiplicity[e]
                    && found[j].free == @f@_free[e] && found[j].residual <= 1e-9
                    && @name@_@f@_branches[found[j].branch] != 0) {
                    nearest = fmin(nearest, apart);
                }
            }
            if (!(nearest <= @f@_tolerance[v])) {
                printf("@f@, configuration %d: the nearest to solution ", v);
                printf("%d is off by %.2g\n", e - @f@_first[v], nearest);
                failures++;
            }
        }
    }
}
