@ head
/* The roots of an equation in one unknown: cosine and sine of an angle, or a number alone. */
typedef struct @p@roots {
    int count;
    /* 1 if nothing determines the unknown: one value stands for all. */
    unsigned is_free;
    int multiplicity[4];
    double x[4];
    double y[4];
} @p@roots;

/* A guard that is this small, times the size to its power, has vanished. */
#define @P@GUARD 2.842170943040401e-14
@ clamp
/* A discriminant below 0 by less than this, times its terms, is 0: the residual decides. */
#define @P@CLAMP 1e-6
@ ratio

/* denominator r = numerator. */
static @p@roots @p@ratio_roots(double numerator, double denominator, double guard, double scale)
{
    const int is_free = fabs(guard) <= @P@GUARD * scale || denominator == 0.0;
    const double r = is_free ? 0.0 : numerator / denominator;
    const @p@roots found = {1, (unsigned)is_free, {1}, {r}, {0.0}};
    return found;
}
@ direction

/* The angle of (x, y), or of (-x, -y) if the sign is negative. */
static @p@roots @p@direction_roots(double x, double y, double sign, double guard, double scale)
{
    @p@roots found = {1, 1, {1, 1}, {1.0}, {0.0}};
    const double length = sqrt(x * x + y * y);
    if (!(fabs(guard) <= @P@GUARD * scale || length == 0.0)) {
        const double divisor = sign < 0.0 ? -length : length;
        found.is_free = 0;
        found.x[0] = x / divisor;
        found.y[0] = y / divisor;
    }
    return found;
}
@ line

/* x sin = y cos: the angle of (x, y) and the opposite one. */
static @p@roots @p@line_roots(double x, double y, double guard, double scale)
{
    @p@roots found = {1, 1, {1, 1}, {1.0}, {0.0}};
    const double length = sqrt(x * x + y * y);
    if (!(fabs(guard) <= @P@GUARD * scale || length == 0.0)) {
        found.count = 2;
        found.is_free = 0;
        found.x[0] = x / length;
        found.y[0] = y / length;
        found.x[1] = -found.x[0];
        found.y[1] = -found.y[0];
    }
    return found;
}
@ length

/* r r = x x + y y. */
static @p@roots @p@length_roots(double x, double y, double guard, double scale)
{
    const double r = sqrt(x * x + y * y);
    const @p@roots two = {2, 0, {1, 1}, {r, -r}, {0.0}};
    const @p@roots twice = {1, 0, {2}, {r}, {0.0}};
    return fabs(guard) <= @P@GUARD * scale || r == 0.0 ? twice : two;
}
@ sincos

/* a cos + b sin = c, of the discriminant d = a a + b b - c c. */
static @p@roots
@p@sincos_roots(double a, double b, double c, double d, double guard, double scale)
{
    @p@roots found = {0, 0, {1, 1}, {1.0}, {0.0}};
    const double n = a * a + b * b;
    if (fabs(guard) <= @P@GUARD * scale || n == 0.0) {
        if (fabs(c) <= 1e-9 * scale) {
            found.count = 1;
            found.is_free = 1;
        }
        return found;
    }
    if (d > 0.0) {
        const double r = sqrt(d);
        found.count = 2;
        found.x[0] = (a * c - b * r) / n;
        found.y[0] = (b * c + a * r) / n;
        found.x[1] = (a * c + b * r) / n;
        found.y[1] = (b * c - a * r) / n;
    } else if (d >= -@P@CLAMP * (n + c * c)) {
        /* The nearest there is. */
        const double length = c < 0.0 ? -sqrt(n) : sqrt(n);
        found.count = 1;
        found.multiplicity[0] = 2;
        found.x[0] = a / length;
        found.y[0] = b / length;
    }
    return found;
}
@ quadratic

/* a r r + 2 b r + c = 0. */
static @p@roots @p@quadratic_roots(double a, double b, double c, double guard, double scale)
{
    @p@roots found = {1, 0, {1, 1}, {0.0}, {0.0}};
    if (fabs(guard) <= @P@GUARD * scale || a == 0.0) {
        if (!(fabs(b) <= @P@GUARD * scale)) {
            found.x[0] = -c / (2.0 * b);
        } else {
            found.is_free = fabs(c) <= 1e-9 * scale;
            found.count = (int)found.is_free;
        }
        return found;
    }
    const double d = b * b - a * c;
    if (!(d >= -@P@CLAMP * (b * b + fabs(a * c)))) {
        found.count = 0;
    } else if (d <= 0.0) {
        found.multiplicity[0] = 2;
        found.x[0] = -b / a;
    } else {
        /* b and the root have the same sign in q: nothing cancels. */
        const double q = b < 0.0 ? sqrt(d) - b : -sqrt(d) - b;
        found.count = 2;
        found.x[0] = b < 0.0 ? q / a : c / q;
        found.x[1] = b < 0.0 ? c / q : q / a;
    }
    return found;
}
@ quartic

/* The value of a polynomial. */
static double @p@polynomial(const double *p, int degree, double x)
{
    double value = p[degree];
    for (int j = degree - 1; j >= 0; j--) {
        value = value * x + p[j];
    }
    return value;
}

/* The root of a polynomial between two places of different sign: Newton's steps, or halves. */
static double @p@root_between(const double *p, int degree, double low, double high)
{
    const int rises = @p@polynomial(p, degree, low) < 0.0;
    double x = 0.5 * (low + high), step = high - low;
    for (int i = 0; i < 100 && step != 0.0; i++) {
        double value = p[degree], slope = 0.0;
        for (int j = degree - 1; j >= 0; j--) {
            slope = slope * x + value;
            value = value * x + p[j];
        }
        if ((value < 0.0) == rises) {
            low = x;
        } else {
            high = x;
        }
        double next = x - value / slope;
        if (!(next > low && next < high && fabs(next - x) <= 0.5 * fabs(step))) {
            next = 0.5 * (low + high);
        }
        step = next - x;
        x = next;
    }
    return x;
}

/*
 * f = cc cos cos + cs cos sin + c cos + s sin + one = 0.
 *
 * A quartic in t = tan(u / 2), where u is measured from the direction opposite to that in which f
 * is largest of eight: its leading coefficient is not small. The roots of each derivative separate
 * those of the one before. Where f touches 0 without changing its sign, two roots come together.
 */
static @p@roots
@p@quartic_roots(double cc, double cs, double c, double s, double one, double guard, double scale)
{
    @p@roots found = {1, 1, {1, 1, 1, 1}, {1.0}, {0.0}};
    const double largest =
        fmax(fmax(fmax(fabs(cc), fabs(cs)), fmax(fabs(c), fabs(s))), fabs(one));
    if (fmin(fabs(guard), largest) <= @P@GUARD * scale) {
        return found;
    }
    found.count = 0;
    found.is_free = 0;

    const double h = 0.7071067811865476;
    const double circle[10] = {1.0, h, 0.0, -h, -1.0, -h, 0.0, h, 1.0, h};
    double lead = 0.0, x0 = 1.0, y0 = 0.0;
    for (int k = 0; k < 8; k++) {
        const double x = circle[k], y = -circle[k + 2];
        const double f = cc * x * x + cs * x * y + c * x + s * y + one;
        if (fabs(f) > fabs(lead)) {
            lead = f;
            x0 = -x;
            y0 = -y;
        }
    }

    /* The coefficients for u, then those of t. */
    const double even = cc * (x0 * x0 - y0 * y0) + 2.0 * cs * x0 * y0;
    const double mixed = cs * (x0 * x0 - y0 * y0) - 2.0 * cc * x0 * y0;
    const double along = c * x0 + s * y0;
    const double across = s * x0 - c * y0;
    const double rest = one + cc * y0 * y0 - cs * x0 * y0;
    double p[5][5];
    p[4][0] = (even + along + rest) / lead;
    p[4][1] = 2.0 * (across + mixed) / lead;
    p[4][2] = 2.0 * (rest - even) / lead;
    p[4][3] = 2.0 * (across - mixed) / lead;
    p[4][4] = 1.0;
    double bound = 1.0;
    for (int j = 0; j < 4; j++) {
        bound += fabs(p[4][j]);
    }
    for (int degree = 3; degree > 0; degree--) {
        for (int j = 0; j <= degree; j++) {
            p[degree][j] = (j + 1) * p[degree + 1][j + 1];
        }
    }

    /* Where a derivative has no root between two places, the second place stands for it. */
    double ends[6] = {-bound, bound};
    int is_root[6] = {0};
    const double sum = fabs(cc) + fabs(cs) + fabs(c) + fabs(s) + fabs(one);
    double t[4];
    int multiplicity[4];
    int count = 0;
    for (int degree = 1; degree <= 4; degree++) {
        double next[6] = {-bound}, height[6] = {0.0};
        int is_next[6] = {0}, is_below[6] = {0};
        for (int k = 0; k <= degree; k++) {
            height[k] = @p@polynomial(p[degree], degree, ends[k]);
            is_below[k] = height[k] < 0.0;
        }
        const double rounding = 3.6e-15 * sum;
        for (int k = 1; degree == 4 && k < 4; k++) {
            /* An extremum at the height of rounding is on the side of its neighbours. */
            const double u = 1.0 + ends[k] * ends[k];
            if (is_root[k] && fabs(height[k] * lead) <= rounding * u * u
                && is_below[k - 1] == is_below[k + 1]) {
                is_below[k] = is_below[k - 1];
            }
        }
        for (int k = 0; k < degree; k++) {
            is_next[k + 1] = is_below[k] != is_below[k + 1];
            next[k + 1] = is_next[k + 1]
                              ? @p@root_between(p[degree], degree, ends[k], ends[k + 1])
                              : ends[k + 1];
            int times = degree == 4 && is_next[k + 1];
            double place = next[k + 1];
            if (degree == 4 && is_root[k] && !is_next[k] && !is_next[k + 1]) {
                /* An extremum, with no change of sign on either side. */
                const double u = 1.0 + ends[k] * ends[k];
                const double bend = @p@polynomial(p[2], 2, ends[k]);
                const int touches = is_below[k] ? bend <= 0.0 : bend >= 0.0;
                if (fabs(height[k] * lead) <= @P@CLAMP * sum * u * u && touches) {
                    times = 2;
                    place = ends[k];
                }
            }
            if (times > 0 && count < 4) {
                t[count] = place;
                multiplicity[count++] = times;
            }
        }
        next[degree + 1] = bound;
        for (int k = 0; k < 6; k++) {
            ends[k] = next[k];
            is_root[k] = is_next[k];
        }
    }

    for (int k = 0; k < count; k++) {
        const double u = 1.0 + t[k] * t[k];
        double x = (x0 * (1.0 - t[k] * t[k]) - 2.0 * y0 * t[k]) / u;
        double y = (y0 * (1.0 - t[k] * t[k]) + 2.0 * x0 * t[k]) / u;
        for (int i = 0; i < 2; i++) {
            const double f = cc * x * x + cs * x * y + c * x + s * y + one;
            const double slope = cs * (x * x - y * y) - 2.0 * cc * x * y - c * y + s * x;
            const double step = f / slope;
            if (fabs(step) <= 1e-8) {
                const double turned = x + y * step;
                y -= x * step;
                x = turned;
            }
        }
        const double length = sqrt(x * x + y * y);
        x /= length;
        y /= length;
        /* Sorted by angle: 1 - cos grows with it above the axis, cos - 1 below. */
        const double order = y < 0.0 ? x - 1.0 : 1.0 - x;
        int place = found.count++;
        while (place > 0) {
            const double before_x = found.x[place - 1], before_y = found.y[place - 1];
            if ((before_y < 0.0 ? before_x - 1.0 : 1.0 - before_x) <= order) {
                break;
            }
            found.x[place] = before_x;
            found.y[place] = before_y;
            found.multiplicity[place] = found.multiplicity[place - 1];
            place--;
        }
        found.x[place] = x;
        found.y[place] = y;
        found.multiplicity[place] = multiplicity[k];
    }
    return found;
}
@ keep

/* Adds a solution, or its multiplicity to an equal one; returns the number of solutions. */
static int @p@keep_@f@(
    @name@_@f@_solution *solutions,
    int count,
    const @name@_@f@_solution *found)
{
    static const int is_angle[@m@] = {@angles@};
    const double turn = 6.283185307179586;
    for (int k = 0; k < @m@; k++) {
        if (!(fabs(found->@result@[k]) <= 1.7976931348623157e308)) {
            return count;
        }
    }
    for (int j = 0; j < count; j++) {
        double apart = 0.0;
        for (int k = 0; k < @m@; k++) {
            double difference = solutions[j].@result@[k] - found->@result@[k];
            if (is_angle[k]) {
                difference -= turn * floor(difference / turn + 0.5);
            }
            apart = fmax(apart, fabs(difference));
        }
        if (apart <= 2e-7) {
            solutions[j].multiplicity += found->multiplicity;
            return count;
        }
    }
    solutions[count] = *found;
    return count + 1;
}
