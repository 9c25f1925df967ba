
/*
 * The matrix of the hidden joint, some of its values side by side.
 *
 * With u = cos(q/2), v = sin(q/2) of the multiplied joint (1, q if it slides) each equation reads
 * (A u^2 + B u v + C v^2) w = 0, w = (1, c, s) of the other joint. The unknowns
 * (u^3, r u^2 v, r u v^2, v^3) x w obey [A B/r C/r 0; 0 A/r B/r C] x = 0 with r = sqrt(3).
 */

INLINE int ik_multiplied_slides(const ik_split *split)
{
    return split->slides[split->last_multiplied ? 4 : 3];
}

INLINE int ik_other_slides(const ik_split *split)
{
    return split->slides[split->last_multiplied ? 3 : 4];
}

/* A strip, [A | B/r C/r] or [C | A/r B/r]: so many lanes, and so many entries from a row to the next. */
INLINE void ik_strip(
    const ik_eliminated *e, int slides, int is_lower, const double *RESTRICT c,
    const double *RESTRICT s, int lanes, int next, double *RESTRICT m)
{
    const double r = slides ? 1.0 : 1.0 / sqrt(3.0);
    const double half = slides ? 0.0 : 1.0;
    const double second_scale = slides ? 1.0 : 2.0 * r;
    for (int i = 0; i < 6; i++) {
        const double *row = e->rows[i];
        for (int w = 0; w < 3; w++) {
            double *RESTRICT left = m + (next * i + w) * lanes;
            double *RESTRICT middle = left + 3 * lanes;
            double *RESTRICT right = left + 6 * lanes;
            for (int l = 0; l < lanes; l++) {
                const double one = IK_ADD(s[l], row[18 + w], IK_ADD(c[l], row[9 + w], row[w]));
                const double first =
                    IK_ADD(s[l], row[21 + w], IK_ADD(c[l], row[12 + w], row[3 + w]));
                const double second =
                    IK_ADD(s[l], row[24 + w], IK_ADD(c[l], row[15 + w], row[6 + w]));
                /* A = one + first, B = 2 second, C = one - first; or one, first, second. */
                const double a = one + half * first;
                const double b = half * (second_scale * second) + (1.0 - half) * first;
                const double d = half * (one - first) + (1.0 - half) * second;
                left[l] = is_lower ? d : a;
                middle[l] = is_lower ? a * r : b;
                right[l] = is_lower ? b : d * r;
            }
        }
    }
}

/* Exchanges the lanes where all bits are set, without branches that would keep compilers from vectors. */
INLINE void ik_swap(
    double *RESTRICT a, double *RESTRICT b, const uint64_t *RESTRICT where, int lanes)
{
    for (int l = 0; l < lanes; l++) {
        uint64_t x, y;
        memcpy(&x, a + l, sizeof x);
        memcpy(&y, b + l, sizeof y);
        const uint64_t both = (x ^ y) & where[l];
        x ^= both;
        y ^= both;
        memcpy(a + l, &x, sizeof x);
        memcpy(b + l, &y, sizeof y);
    }
}

/* row - factor pivot */
INLINE void ik_subtract(
    double *RESTRICT row, const double *RESTRICT factor, const double *RESTRICT pivot, int lanes)
{
    for (int l = 0; l < lanes; l++) {
        row[l] = IK_ADD(-factor[l], pivot[l], row[l]);
    }
}

/* Eliminates the first columns of six rows of n with partial pivoting; the product of the pivots. From one
   row to the next there are so many entries. */
INLINE void ik_reduce(double *m, int next, int n, int columns, int lanes, double *product)
{
    for (int l = 0; l < lanes; l++) {
        product[l] = 1.0;
    }
    for (int k = 0; k < columns; k++) {
        double *pivot = m + (k * next + k) * lanes;
        double inverse[IK_LANES];
        for (int r = k + 1; r < 6; r++) {
            const double *other = m + (r * next + k) * lanes;
            uint64_t where[IK_LANES];
            for (int l = 0; l < lanes; l++) {
                where[l] = fabs(pivot[l]) < fabs(other[l]) ? IK_ALL : 0;
            }
            for (int l = 0; l < lanes; l++) {
                product[l] = fabs(pivot[l]) < fabs(other[l]) ? -product[l] : product[l];
            }
            for (int c = k; c < n; c++) {
                ik_swap(m + (k * next + c) * lanes, m + (r * next + c) * lanes, where, lanes);
            }
        }
        for (int l = 0; l < lanes; l++) {
            const double quotient = 1.0 / pivot[l];
            inverse[l] = pivot[l] == 0.0 ? 0.0 : quotient;
            product[l] *= pivot[l];
        }
        for (int r = k + 1; r < 6; r++) {
            double *own = m + (r * next + k) * lanes;
            double factor[IK_LANES];
            for (int l = 0; l < lanes; l++) {
                factor[l] = own[l] * inverse[l];
                own[l] = factor[l];
            }
            for (int c = k + 1; c < n; c++) {
                ik_subtract(
                    m + (r * next + c) * lanes, factor, m + (k * next + c) * lanes, lanes);
            }
        }
    }
}

static NOINLINE void ik_reduce_strip(double *m, double *product)
{
    ik_reduce(m, IK_WIDTH, IK_WIDTH, 3, IK_LANES, product);
}

/* The determinants. What remains of the upper strip makes room for the lower one: then what remains of
   both is one matrix. */
static NOINLINE void ik_determinant(
    const ik_eliminated *e, int slides, const double *c, const double *s, double *out)
{
    double m[9][IK_WIDTH][IK_LANES];
    double first[IK_LANES], second[IK_LANES], third[IK_LANES];
    ik_strip(e, slides, 0, c, s, IK_LANES, IK_WIDTH, &m[0][0][0]);
    ik_reduce_strip(&m[0][0][0], first);
    memcpy(m[6], m[3], 3 * sizeof m[3]);
    ik_strip(e, slides, 1, c, s, IK_LANES, IK_WIDTH, &m[0][0][0]);
    ik_reduce_strip(&m[0][0][0], second);
    ik_reduce(&m[3][3][0], IK_WIDTH, 6, 6, IK_LANES, third);
    for (int l = 0; l < IK_LANES; l++) {
        out[l] = first[l] * second[l] * third[l];
    }
}
