
/* Sine and cosine of any x. */
INLINE void sine_cosine(double x, double *sine, double *cosine)
{
    if (!near_sine_cosine(x, sine, cosine)) {
        *sine = sin(x);
        *cosine = cos(x);
    }
}
