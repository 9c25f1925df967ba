
/*
 * The matrix of the hidden joint, eight of its values side by side.
 *
 * With u = cos(q/2), v = sin(q/2) of the multiplied joint (1, q if it slides) each equation reads
 * (A u^2 + B u v + C v^2) w = 0, w = (1, c, s) of the other joint. The unknowns
 * (u^3, r u^2 v, r u v^2, v^3) x w obey [A B/r C/r 0; 0 A/r B/r C] x = 0 with r = sqrt(3).
 */

typedef struct ik_strip {
    double m[6][9][IK_LANES];
} ik_strip;

INLINE int ik_multiplied_slides(const ik_split *split)
{
    return split->slides[split->last_multiplied ? 4 : 3];
}

INLINE int ik_other_slides(const ik_split *split)
{
    return split->slides[split->last_multiplied ? 3 : 4];
}

/* The strips [A | B/r C/r] and [C | A/r B/r]. */
static void ik_strips(
    const ik_eliminated *e, int slides, const double *RESTRICT c, const double *RESTRICT s,
    ik_strip *RESTRICT upper, ik_strip *RESTRICT lower)
{
    const double r = slides ? 1.0 : 1.0 / sqrt(3.0);
    const double half = slides ? 0.0 : 1.0;
    const double second_scale = slides ? 1.0 : 2.0 * r;
    for (int i = 0; i < 6; i++) {
        const double *row = e->rows[i];
        for (int w = 0; w < 3; w++) {
            for (int l = 0; l < IK_LANES; l++) {
                const double one = IK_ADD(s[l], row[18 + w], IK_ADD(c[l], row[9 + w], row[w]));
                const double first =
                    IK_ADD(s[l], row[21 + w], IK_ADD(c[l], row[12 + w], row[3 + w]));
                const double second =
                    IK_ADD(s[l], row[24 + w], IK_ADD(c[l], row[15 + w], row[6 + w]));
                /* A = one + first, B = 2 second, C = one - first; or one, first, second. */
                const double a = one + half * first;
                const double b = half * (second_scale * second) + (1.0 - half) * first;
                const double d = half * (one - first) + (1.0 - half) * second;
                upper->m[i][w][l] = a;
                upper->m[i][3 + w][l] = b;
                upper->m[i][6 + w][l] = d * r;
                lower->m[i][w][l] = d;
                lower->m[i][3 + w][l] = a * r;
                lower->m[i][6 + w][l] = b;
            }
        }
    }
}

/* Exchanges the lanes where all bits are set, without branches that would keep compilers from vectors. */
INLINE void ik_swap(double *RESTRICT a, double *RESTRICT b, const uint64_t *RESTRICT where)
{
    for (int l = 0; l < IK_LANES; l++) {
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
    double *RESTRICT row, const double *RESTRICT factor, const double *RESTRICT pivot)
{
    for (int l = 0; l < IK_LANES; l++) {
        row[l] = IK_ADD(-factor[l], pivot[l], row[l]);
    }
}

/* Eliminates the first columns of six rows of n with partial pivoting; the product of the pivots. */
INLINE void ik_reduce(double *m, int n, int columns, double *product)
{
    for (int l = 0; l < IK_LANES; l++) {
        product[l] = 1.0;
    }
    for (int k = 0; k < columns; k++) {
        double *pivot = m + (k * n + k) * IK_LANES;
        double inverse[IK_LANES];
        for (int r = k + 1; r < 6; r++) {
            const double *other = m + (r * n + k) * IK_LANES;
            uint64_t where[IK_LANES];
            for (int l = 0; l < IK_LANES; l++) {
                where[l] = fabs(pivot[l]) < fabs(other[l]) ? IK_ALL : 0;
            }
            for (int l = 0; l < IK_LANES; l++) {
                product[l] = fabs(pivot[l]) < fabs(other[l]) ? -product[l] : product[l];
            }
            for (int c = k; c < n; c++) {
                ik_swap(m + (k * n + c) * IK_LANES, m + (r * n + c) * IK_LANES, where);
            }
        }
        for (int l = 0; l < IK_LANES; l++) {
            const double quotient = 1.0 / pivot[l];
            inverse[l] = pivot[l] == 0.0 ? 0.0 : quotient;
            product[l] *= pivot[l];
        }
        for (int r = k + 1; r < 6; r++) {
            double *own = m + (r * n + k) * IK_LANES;
            double factor[IK_LANES];
            for (int l = 0; l < IK_LANES; l++) {
                factor[l] = own[l] * inverse[l];
                own[l] = factor[l];
            }
            for (int c = k + 1; c < n; c++) {
                ik_subtract(m + (r * n + c) * IK_LANES, factor, m + (k * n + c) * IK_LANES);
            }
        }
    }
}

static void ik_reduce_strip(ik_strip *strip, double *product)
{
    ik_reduce(&strip->m[0][0][0], 9, 3, product);
}

/* The 6 x 6 matrix that remains of two reduced strips. */
static void ik_core(
    const ik_strip *RESTRICT upper, const ik_strip *RESTRICT lower, double out[6][6][IK_LANES])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 6; k++) {
            for (int l = 0; l < IK_LANES; l++) {
                out[i][k][l] = upper->m[3 + i][3 + k][l];
                out[3 + i][k][l] = lower->m[3 + i][3 + k][l];
            }
        }
    }
}

static void ik_determinant(
    const ik_eliminated *e, int slides, const double *c, const double *s, double *out)
{
    ik_strip upper, lower;
    double rest[6][6][IK_LANES];
    double first[IK_LANES], second[IK_LANES], third[IK_LANES];
    ik_strips(e, slides, c, s, &upper, &lower);
    ik_reduce_strip(&upper, first);
    ik_reduce_strip(&lower, second);
    ik_core(&upper, &lower, rest);
    ik_reduce(&rest[0][0][0], 6, 6, third);
    for (int l = 0; l < IK_LANES; l++) {
        out[l] = first[l] * second[l] * third[l];
    }
}
