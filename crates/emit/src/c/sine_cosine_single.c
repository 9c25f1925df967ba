
/* 2^12 pi/2. The routine without branches holds for |x| up to here. */
#define SINE_COSINE_LIMIT 6433.982f

/*
 * Sine and cosine of x, each within 0.81 units in the last place. Returns 1 if they are valid, 0 if
 * |x| is above the limit or x is not a number. No branch: a loop over it becomes vector code.
 *
 * Reduction after Cody and Waite: n is the integer nearest to |x| 2/pi, and pi/2 is cut into pieces
 * so short that the remainder |x| - n pi/2 = r + lo is exact almost to twice the precision. Then a
 * minimax polynomial each on |r| <= pi/4, an exchange in odd quadrants, and signs by exclusive or.
 */
INLINE int near_sine_cosine(float x, float *sine, float *cosine)
{
    const float shift = 12582912.0f; /* 1.5 2^23: a sum with it is rounded to an integer */
    const float size = fabsf(x);
#if FUSED
    const float big = fmaf(size, 0.63661975f, shift);
    const float n = big - shift;
    const float first = fmaf(-n, 1.5707964f, size);
    const float r = fmaf(-n, -4.3713953e-08f, first);
    const float rest = fmaf(-n, -4.3713953e-08f, first - r);
    const float lo = fmaf(-n, 2.563344e-12f, rest);
#else
    const float big = size * 0.63661975f + shift;
    const float n = big - shift;
    const float first = size - n * 1.5708008f;
    const float head = first - n * -4.4535846e-06f;
    const float d = ((first - head) - n * -4.4535846e-06f) - n * -8.706138e-10f;
    const float r = head + d;
    const float lo = ((head - r) + d) - n * 6.223372e-14f;
#endif

    const float z = r * r;
    const float w = MULTIPLY_ADD(-0.5f, z, 1.0f);
    const float w_lo = MULTIPLY_ADD(-0.5f, z, 1.0f - w);
    float s = -0.00019517895f;
    s = MULTIPLY_ADD(s, z, 0.008332187f);
    s = MULTIPLY_ADD(s, z, -0.16666655f);
    s = r + MULTIPLY_ADD(lo, w, z * r * s);
    float c = 2.4432326e-05f;
    c = MULTIPLY_ADD(c, z, -0.001388731f);
    c = MULTIPLY_ADD(c, z, 0.041666646f);
#if FUSED
    c = w + fmaf(z * z, c, fmaf(-r, lo, w_lo));
#else
    c = w + (w_lo + (z * z * c - r * lo));
#endif

    /* The low bits of big are those of n: the quadrant. */
    const uint32_t top = (uint32_t)1 << 31;
    uint32_t quadrant, x_bits, s_bits, c_bits;
    memcpy(&quadrant, &big, sizeof quadrant);
    memcpy(&x_bits, &x, sizeof x_bits);
#if FUSED
    const float exchanged = (quadrant & 1) != 0 ? c : s;
    c = (quadrant & 1) != 0 ? s : c;
    s = exchanged;
    memcpy(&s_bits, &s, sizeof s_bits);
    memcpy(&c_bits, &c, sizeof c_bits);
#else
    /* By masks: processors this old have no instruction that selects. */
    memcpy(&s_bits, &s, sizeof s_bits);
    memcpy(&c_bits, &c, sizeof c_bits);
    const uint32_t exchange = (s_bits ^ c_bits) & (0 - (quadrant & 1));
    s_bits ^= exchange;
    c_bits ^= exchange;
#endif
    s_bits ^= (quadrant << 30 ^ x_bits) & top;
    c_bits ^= (quadrant + 1) << 30 & top;
    memcpy(sine, &s_bits, sizeof *sine);
    memcpy(cosine, &c_bits, sizeof *cosine);
    return size <= SINE_COSINE_LIMIT;
}
