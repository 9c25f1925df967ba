
/* Sines and cosines of eight angles, whatever they are. */
CLONES static NOINLINE void
eight_sines_and_cosines(const double *RESTRICT x, double *RESTRICT sines, double *RESTRICT cosines)
{
    int in_range = 1;
    for (int i = 0; i < 8; i++) {
        in_range &= near_sine_cosine(x[i], &sines[i], &cosines[i]);
    }
    if (!in_range) {
        for (int i = 0; i < 8; i++) {
            sine_cosine(x[i], &sines[i], &cosines[i]);
        }
    }
}
