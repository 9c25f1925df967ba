
/* 2^20 pi/2. The routine without branches holds for |x| up to here. */
#define SINE_COSINE_LIMIT 1647099.3291652855

/*
 * Sine and cosine of x, each within 0.78 units in the last place. Returns 1 if they are valid, 0 if
 * |x| is above the limit or x is not a number. No branch: a loop over it becomes vector code.
 *
 * Reduction after Cody and Waite: n is the integer nearest to |x| 2/pi, and pi/2 is cut into pieces
 * so short that the remainder |x| - n pi/2 = r + lo is exact almost to twice the precision. Then a
 * minimax polynomial each on |r| <= pi/4, an exchange in odd quadrants, and signs by exclusive or.
 */
INLINE int near_sine_cosine(double x, double *sine, double *cosine)
{
    const double shift = 6755399441055744.0; /* 1.5 2^52: a sum with it is rounded to an integer */
    const double size = fabs(x);
#if FUSED
    const double big = fma(size, 0.6366197723675814, shift);
    const double n = big - shift;
    const double first = fma(-n, 1.5707963267948966, size);
    const double r = fma(-n, 6.12323399538461e-17, first);
    const double rest = fma(-n, 6.12323399538461e-17, first - r);
    const double lo = fma(-n, 3.5215598651832e-27, rest);
#else
    const double big = size * 0.6366197723675814 + shift;
    const double n = big - shift;
    const double first = size - n * 1.5707963267341256;
    const double head = first - n * 6.077100506303966e-11;
    const double d = ((first - head) - n * 6.077100506303966e-11) - n * 2.0222662487111665e-21;
    const double r = head + d;
    const double lo = ((head - r) + d) - n * 8.4784276603689e-32;
#endif

    const double z = r * r;
    const double w = MULTIPLY_ADD(-0.5, z, 1.0);
    const double w_lo = MULTIPLY_ADD(-0.5, z, 1.0 - w);
    double s = 1.5895419876445903e-10;
    s = MULTIPLY_ADD(s, z, -2.5050734242904226e-08);
    s = MULTIPLY_ADD(s, z, 2.7557313538085872e-06);
    s = MULTIPLY_ADD(s, z, -0.00019841269829358333);
    s = MULTIPLY_ADD(s, z, 0.00833333333332184);
    s = MULTIPLY_ADD(s, z, -0.1666666666666663);
    s = r + MULTIPLY_ADD(lo, w, z * r * s);
    double c = -1.1358748258777913e-11;
    c = MULTIPLY_ADD(c, z, 2.0875705384029636e-09);
    c = MULTIPLY_ADD(c, z, -2.755731421698574e-07);
    c = MULTIPLY_ADD(c, z, 2.4801587289002005e-05);
    c = MULTIPLY_ADD(c, z, -0.0013888888888873342);
    c = MULTIPLY_ADD(c, z, 0.041666666666666595);
#if FUSED
    c = w + fma(z * z, c, fma(-r, lo, w_lo));
#else
    c = w + (w_lo + (z * z * c - r * lo));
#endif

    /* The low bits of big are those of n: the quadrant. */
    const uint64_t top = (uint64_t)1 << 63;
    uint64_t quadrant, x_bits, s_bits, c_bits;
    memcpy(&quadrant, &big, sizeof quadrant);
    memcpy(&x_bits, &x, sizeof x_bits);
#if FUSED
    const double exchanged = (quadrant & 1) != 0 ? c : s;
    c = (quadrant & 1) != 0 ? s : c;
    s = exchanged;
    memcpy(&s_bits, &s, sizeof s_bits);
    memcpy(&c_bits, &c, sizeof c_bits);
#else
    /* By masks: processors this old have no instruction that selects. */
    memcpy(&s_bits, &s, sizeof s_bits);
    memcpy(&c_bits, &c, sizeof c_bits);
    const uint64_t exchange = (s_bits ^ c_bits) & (0 - (quadrant & 1));
    s_bits ^= exchange;
    c_bits ^= exchange;
#endif
    s_bits ^= (quadrant << 62 ^ x_bits) & top;
    c_bits ^= (quadrant + 1) << 62 & top;
    memcpy(sine, &s_bits, sizeof *sine);
    memcpy(cosine, &c_bits, sizeof *cosine);
    return size <= SINE_COSINE_LIMIT;
}
