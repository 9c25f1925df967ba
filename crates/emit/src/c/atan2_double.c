
/*
 * The angle of the point (x, y), within 1.6 units in the last place. Returns 1 if it is valid, 0 if
 * |x| + |y| is so large or small, but not 0, that the library has to be asked.
 *
 * Measured from the nearest of the eight half axes and diagonals, whose angle is hi + lo: an odd
 * minimax polynomial for atan t, -1/3 <= t <= 1/2. All is selected before the one division.
 */
INLINE int near_atan2(double y, double x, double *angle)
{
    const double height = fabs(y);
    const double width = fabs(x);
    const int steep = height > width;
    const int left = copysign(1.0, x) < 0.0;
    const double shorter = steep ? width : height;
    const double longer = steep ? height : width;
    const int diagonal = shorter + shorter > longer;
    double above = diagonal ? shorter - longer : shorter;
    double below = diagonal ? shorter + longer : longer;
    above = steep ? -above : above;
    above = left ? -above : above;
    below = below == 0.0 ? 1.0 : below;
    const double t = above / below;

    /* 0, pi/2, pi; pi/4, 3 pi/4: what is nearest, and what it lacks. */
    const double axis = left ? 3.141592653589793 : 0.0;
    const double axis_lo = left ? 1.2246467991473532e-16 : 0.0;
    const double upright = steep ? 1.5707963267948966 : axis;
    const double upright_lo = steep ? 6.123233995736766e-17 : axis_lo;
    const double slope = left ? 2.356194490192345 : 0.7853981633974483;
    const double slope_lo = left ? 9.184850993605148e-17 : 3.061616997868383e-17;
    const double hi = diagonal ? slope : upright;
    const double lo = diagonal ? slope_lo : upright_lo;

    const double z = t * t;
    double a = 0.010113108500692448;
    a = MULTIPLY_ADD(a, z, -0.02743118071680663);
    a = MULTIPLY_ADD(a, z, 0.041863633476533164);
    a = MULTIPLY_ADD(a, z, -0.05121986004695245);
    a = MULTIPLY_ADD(a, z, 0.05858300195173544);
    a = MULTIPLY_ADD(a, z, -0.06663811402905982);
    a = MULTIPLY_ADD(a, z, 0.07692074014627054);
    a = MULTIPLY_ADD(a, z, -0.09090896250375825);
    a = MULTIPLY_ADD(a, z, 0.1111111065974466);
    a = MULTIPLY_ADD(a, z, -0.14285714276385697);
    a = MULTIPLY_ADD(a, z, 0.19999999999903104);
    a = MULTIPLY_ADD(a, z, -0.3333333333333298);
    const double sum = hi + t;
    const double rest = ((hi - sum) + t) + MULTIPLY_ADD(t * z, a, lo);
    *angle = copysign(sum + rest, y);

    const double size = width + height;
    return (size == 0.0) | ((size >= 1e-290) & (size <= 1e290));
}

/* The angle of any point. */
INLINE double any_atan2(double y, double x)
{
    double angle;
    if (!near_atan2(y, x, &angle)) {
        angle = atan2(y, x);
    }
    return angle;
}
