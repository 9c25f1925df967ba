
/*
 * The angle of the point (x, y), within 1.6 units in the last place. Returns 1 if it is valid, 0 if
 * |x| + |y| is so large or small, but not 0, that the library has to be asked.
 *
 * Measured from the nearest of the eight half axes and diagonals, whose angle is hi + lo: an odd
 * minimax polynomial for atan t, -1/3 <= t <= 1/2. All is selected before the one division.
 */
INLINE int near_atan2(float y, float x, float *angle)
{
    const float height = fabsf(y);
    const float width = fabsf(x);
    const int steep = height > width;
    const int left = copysignf(1.0f, x) < 0.0f;
    const float shorter = steep ? width : height;
    const float longer = steep ? height : width;
    const int diagonal = shorter + shorter > longer;
    float above = diagonal ? shorter - longer : shorter;
    float below = diagonal ? shorter + longer : longer;
    above = steep ? -above : above;
    above = left ? -above : above;
    below = below == 0.0f ? 1.0f : below;
    const float t = above / below;

    /* 0, pi/2, pi; pi/4, 3 pi/4: what is nearest, and what it lacks. */
    const float axis = left ? 3.1415927f : 0.0f;
    const float axis_lo = left ? -8.742278e-08f : 0.0f;
    const float upright = steep ? 1.5707964f : axis;
    const float upright_lo = steep ? -4.371139e-08f : axis_lo;
    const float slope = left ? 2.3561945f : 0.7853982f;
    const float slope_lo = left ? -5.9624403e-09f : -2.1855694e-08f;
    const float hi = diagonal ? slope : upright;
    const float lo = diagonal ? slope_lo : upright_lo;

    const float z = t * t;
    float a = -0.051243987f;
    a = MULTIPLY_ADD(a, z, 0.10155528f);
    a = MULTIPLY_ADD(a, z, -0.14174175f);
    a = MULTIPLY_ADD(a, z, 0.19994166f);
    a = MULTIPLY_ADD(a, z, -0.33333233f);
    const float sum = hi + t;
    const float rest = ((hi - sum) + t) + MULTIPLY_ADD(t * z, a, lo);
    *angle = copysignf(sum + rest, y);

    const float size = width + height;
    return (size == 0.0f) | ((size >= 1e-30f) & (size <= 1e30f));
}

/* The angle of any point. */
INLINE float any_atan2(float y, float x)
{
    float angle;
    if (!near_atan2(y, x, &angle)) {
        angle = atan2f(y, x);
    }
    return angle;
}
