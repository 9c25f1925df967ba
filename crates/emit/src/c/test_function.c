
static void test_@f@(void)
{
    static real q[VARIABLES * LANES];
    static real block[@F@_RESULTS * LANES];
    for (int v = 0; v < @F@_VECTORS; v++) {
@parameters@
        real variables[VARIABLES];
        for (int j = 0; j < VARIABLES; j++) {
            variables[j] = (real)@f@_variables[v][j];
        }
        real @result@@shape@;
        @name@_@f@(variables, @address@@result@);
        const real *one = @result@@first@;

        /* The same in every @F@_VECTORS-th lane, between the other configurations. */
        for (int i = 0; i < LANES; i++) {
            for (int j = 0; j < VARIABLES; j++) {
                q[LANES * j + i] = (real)@f@_variables[(v + i) % @F@_VECTORS][j];
            }
        }
        @name@_@f@_block(q, @address@block);
        for (int k = 0; k < @F@_RESULTS; k++) {
            const double expected = @f@_results[v][k];
            const double allowed = tolerance(@f@_variables[v]) * @f@_scales[k];
            check("@f@", v, k, (double)one[k], expected, allowed);
            for (int i = 0; i < LANES; i += @F@_VECTORS) {
                const double value = (double)block[LANES * k + i];
                check("@f@_block", v, k, value, expected, allowed);
            }
        }
#if FLT_EVAL_METHOD == 0

        /* Where the routines without branches do not hold, the two agree bit by bit, or
           neither is a number. */
        for (int j = 0; j < VARIABLES; j++) {
            variables[j] = (real)1e15;
            q[LANES * j + 1] = variables[j];
        }
        @name@_@f@(variables, @address@@result@);
        @name@_@f@_block(q, @address@block);
        for (int k = 0; k < @F@_RESULTS; k++) {
            const double value = (double)block[LANES * k + 1];
            const int is_none = value != value && one[k] != one[k];
            if (value != (double)one[k] && !is_none) {
                check("@f@_block, huge", v, k, value, (double)one[k], 0.0);
            }
        }
#endif
    }
}
