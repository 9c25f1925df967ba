
/*
 * Newton's method on the pose, some candidates side by side, and the smallest singular value there.
 */

typedef struct ik_values {
    double v[6][2][IK_FEW];
} ik_values;

typedef struct ik_motion {
    double r[3][3][IK_FEW];
    double p[3][IK_FEW];
} ik_motion;

/* The pose; and, in the first six of n columns, for each joint a point on its axis (rows 0 to 2) and the
   axis (rows 3 to 5). */
INLINE void ik_forward(
    const ik_values *RESTRICT values, ik_motion *RESTRICT at, double *RESTRICT m, int n)
{
    for (int x = 0; x < 3; x++) {
        for (int l = 0; l < IK_FEW; l++) {
            at->r[x][0][l] = ik_base.r[x][0];
            at->r[x][1][l] = ik_base.r[x][1];
            at->r[x][2][l] = ik_base.r[x][2];
            at->p[x][l] = ik_base.t[x];
        }
    }
    for (int i = 0; i < 6; i++) {
        const ik_rigid *link = &ik_links[i];
        const double *RESTRICT c = values->v[i][0];
        const double *RESTRICT s = values->v[i][1];
        const double slides = ik_slides[i] ? 1.0 : 0.0;
        for (int x = 0; x < 3; x++) {
            double(*RESTRICT r)[IK_FEW] = at->r[x];
            double *RESTRICT p = at->p[x];
            double *RESTRICT axis = m + ((3 + x) * n + i) * IK_FEW;
            double *RESTRICT point = m + (x * n + i) * IK_FEW;
            for (int l = 0; l < IK_FEW; l++) {
                const double turned[2] = {
                    IK_ADD(s[l], r[1][l], c[l] * r[0][l]), IK_ADD(-s[l], r[0][l], c[l] * r[1][l])};
                const double a = slides != 0.0 ? r[0][l] : turned[0];
                const double b = slides != 0.0 ? r[1][l] : turned[1];
                const double z = r[2][l];
                axis[l] = z;
                point[l] = p[l];
                p[l] = IK_ADD(
                    a, link->t[0],
                    IK_ADD(b, link->t[1], IK_ADD(z, link->t[2], IK_ADD(slides * c[l], z, p[l]))));
                r[0][l] = IK_ADD(z, link->r[2][0], IK_ADD(b, link->r[1][0], a * link->r[0][0]));
                r[1][l] = IK_ADD(z, link->r[2][1], IK_ADD(b, link->r[1][1], a * link->r[0][1]));
                r[2][l] = IK_ADD(z, link->r[2][2], IK_ADD(b, link->r[1][2], a * link->r[0][2]));
            }
        }
    }
}

/* The twist that is left to the pose, and the square of the distance. */
static void ik_error(
    const ik_motion *RESTRICT at, const ik_rigid *goal, double twist[6][IK_FEW],
    double *RESTRICT square)
{
    for (int l = 0; l < IK_FEW; l++) {
        square[l] = twist[3][l] = twist[4][l] = twist[5][l] = 0.0;
    }
    for (int k = 0; k < 3; k++) {
        for (int x = 0; x < 3; x++) {
            const int y = (x + 1) % 3;
            const int z = (x + 2) % 3;
            const double *RESTRICT cx = at->r[x][k];
            const double *RESTRICT cy = at->r[y][k];
            const double *RESTRICT cz = at->r[z][k];
            double *RESTRICT out = twist[3 + x];
            for (int l = 0; l < IK_FEW; l++) {
                const double away = cx[l] - goal->r[x][k];
                out[l] = IK_ADD(cy[l], 0.5 * goal->r[z][k], out[l]);
                out[l] = IK_ADD(cz[l], -0.5 * goal->r[y][k], out[l]);
                square[l] = IK_ADD(0.5 * away, away, square[l]);
            }
        }
    }
    for (int x = 0; x < 3; x++) {
        for (int l = 0; l < IK_FEW; l++) {
            const double away = goal->t[x] - at->p[x][l];
            twist[x][l] = away;
            square[l] = IK_ADD(away, away, square[l]);
        }
    }
}

/* Points and axes, in the first six of n columns, become the geometric Jacobian. */
INLINE void ik_jacobian(const ik_motion *RESTRICT at, double *RESTRICT m, int n)
{
    for (int i = 0; i < 6; i++) {
        double *RESTRICT px = m + i * IK_FEW;
        double *RESTRICT py = m + (n + i) * IK_FEW;
        double *RESTRICT pz = m + (2 * n + i) * IK_FEW;
        double *RESTRICT ax = m + (3 * n + i) * IK_FEW;
        double *RESTRICT ay = m + (4 * n + i) * IK_FEW;
        double *RESTRICT az = m + (5 * n + i) * IK_FEW;
        for (int l = 0; l < IK_FEW; l++) {
            const double x = at->p[0][l] - px[l];
            const double y = at->p[1][l] - py[l];
            const double z = at->p[2][l] - pz[l];
            const double moment[3] = {
                IK_ADD(-az[l], y, ay[l] * z), IK_ADD(-ax[l], z, az[l] * x), IK_ADD(-ay[l], x, ax[l] * y)};
            px[l] = ik_slides[i] ? ax[l] : moment[0];
            py[l] = ik_slides[i] ? ay[l] : moment[1];
            pz[l] = ik_slides[i] ? az[l] : moment[2];
            ax[l] = ik_slides[i] ? 0.0 : ax[l];
            ay[l] = ik_slides[i] ? 0.0 : ay[l];
            az[l] = ik_slides[i] ? 0.0 : az[l];
        }
    }
}

/* Cosine and sine after a turn by at most 0.6 rad: Taylor's polynomials, then back to length 1. */
INLINE void ik_turned(double *RESTRICT c, double *RESTRICT s, const double *RESTRICT step)
{
    static const double reciprocal[14] = {
        1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0,
        1.0 / 40320.0, 1.0 / 362880.0, 1.0 / 3628800.0, 1.0 / 39916800.0, 1.0 / 479001600.0,
        1.0 / 6227020800.0};
    double a[IK_FEW], b[IK_FEW];
    for (int l = 0; l < IK_FEW; l++) {
        a[l] = reciprocal[12];
        b[l] = reciprocal[13];
    }
    for (int k = 5; k >= 0; k--) {
        for (int l = 0; l < IK_FEW; l++) {
            const double square = step[l] * step[l];
            a[l] = IK_ADD(-a[l], square, reciprocal[2 * k]);
            b[l] = IK_ADD(-b[l], square, reciprocal[2 * k + 1]);
        }
    }
    for (int l = 0; l < IK_FEW; l++) {
        const double turn = b[l] * step[l];
        const double x = IK_ADD(-turn, s[l], a[l] * c[l]);
        const double y = IK_ADD(turn, c[l], a[l] * s[l]);
        const double back = 1.5 - 0.5 * IK_ADD(y, y, x * x);
        c[l] = x * back;
        s[l] = y * back;
    }
}

/* One step from where the chain is, with points and axes in the first six columns. */
INLINE void ik_newton_step(
    const ik_motion *at, double m[6][7][IK_FEW], double twist[6][IK_FEW], ik_values *now)
{
    double step[6][IK_FEW], longest[IK_FEW], product[IK_FEW];
    ik_jacobian(at, &m[0][0][0], 7);
    for (int k = 0; k < 6; k++) {
        for (int l = 0; l < IK_FEW; l++) {
            m[k][6][l] = twist[k][l];
        }
    }
    ik_reduce(&m[0][0][0], 7, 7, 6, IK_FEW, product);
    for (int l = 0; l < IK_FEW; l++) {
        longest[l] = 0.6;
    }
    for (int k = 5; k >= 0; k--) {
        for (int c = k + 1; c < 6; c++) {
            ik_subtract(m[k][6], m[k][c], step[c], IK_FEW);
        }
        for (int l = 0; l < IK_FEW; l++) {
            const double quotient = m[k][6][l] / m[k][k][l];
            step[k][l] = fabs(m[k][k][l]) < 1e-13 ? 0.0 : quotient;
            longest[l] = fabs(step[k][l]) > longest[l] ? fabs(step[k][l]) : longest[l];
        }
    }
    for (int i = 0; i < 6; i++) {
        for (int l = 0; l < IK_FEW; l++) {
            step[i][l] *= 0.6 / longest[l];
        }
        if (ik_slides[i]) {
            for (int l = 0; l < IK_FEW; l++) {
                now->v[i][0][l] += step[i][l];
                now->v[i][1][l] = 0.0;
            }
        } else {
            ik_turned(now->v[i][0], now->v[i][1], step[i]);
        }
    }
}

/* Newton's method on all lanes, each kept at its best; the distances that are left. */
static NOINLINE void ik_polish(const ik_rigid *goal, ik_values *values, double *residual)
{
    double best[IK_FEW], patience[IK_FEW];
    ik_values now = *values;
    for (int l = 0; l < IK_FEW; l++) {
        best[l] = HUGE_VAL;
        patience[l] = 4.0;
    }
    for (int turn = 0; turn < 24; turn++) {
        ik_motion at;
        double m[6][7][IK_FEW], twist[6][IK_FEW], square[IK_FEW], better[IK_FEW];
        int is_open = 0;
        ik_forward(&now, &at, &m[0][0][0], 7);
        ik_error(&at, goal, twist, square);
        for (int l = 0; l < IK_FEW; l++) {
            patience[l] -= square[l] < 0.25 * best[l] ? 0.0 : 1.0;
            better[l] = square[l] < best[l] ? 1.0 : 0.0;
            best[l] = square[l] < best[l] ? square[l] : best[l];
            is_open |= !(square[l] < 4e-30) && patience[l] > 0.0;
        }
        for (int i = 0; i < 6; i++) {
            for (int k = 0; k < 2; k++) {
                for (int l = 0; l < IK_FEW; l++) {
                    values->v[i][k][l] = better[l] != 0.0 ? now.v[i][k][l] : values->v[i][k][l];
                }
            }
        }
        if (!is_open) {
            break;
        }
        ik_newton_step(&at, m, twist, &now);
    }
    for (int l = 0; l < IK_FEW; l++) {
        residual[l] = sqrt(best[l]);
    }
}

/* The squares of the lengths of vectors. */
INLINE void ik_squares(double v[6][IK_FEW], double *RESTRICT out)
{
    for (int l = 0; l < IK_FEW; l++) {
        out[l] = 0.0;
    }
    for (int c = 0; c < 6; c++) {
        for (int l = 0; l < IK_FEW; l++) {
            out[l] = IK_ADD(v[c][l], v[c][l], out[l]);
        }
    }
}

/* The smallest singular value of the Jacobian in each lane: power iterations with the inverse. */
static NOINLINE void ik_singular_values(const ik_values *values, double *out)
{
    ik_motion at;
    double m[6][12][IK_FEW];
    double inverse[6][6][IK_FEW];
    double product[IK_FEW];
    ik_forward(values, &at, &m[0][0][0], 12);
    ik_jacobian(&at, &m[0][0][0], 12);
    for (int k = 0; k < 6; k++) {
        for (int c = 0; c < 6; c++) {
            for (int l = 0; l < IK_FEW; l++) {
                m[k][6 + c][l] = c == k ? 1.0 : 0.0;
            }
        }
    }
    ik_reduce(&m[0][0][0], 12, 12, 6, IK_FEW, product);
    for (int k = 5; k >= 0; k--) {
        for (int j = 0; j < 6; j++) {
            for (int c = k + 1; c < 6; c++) {
                ik_subtract(m[k][6 + j], m[k][c], inverse[c][j], IK_FEW);
            }
            for (int l = 0; l < IK_FEW; l++) {
                const double pivot = fabs(m[k][k][l]) < 1e-15 ? 1e-15 : m[k][k][l];
                inverse[k][j][l] = m[k][6 + j][l] / pivot;
            }
        }
    }
    /* x <- the longest row, then x <- X' X x: the length grows by the square of what is sought. */
    double x[6][IK_FEW], longest[IK_FEW], growth[IK_FEW];
    for (int l = 0; l < IK_FEW; l++) {
        longest[l] = -1.0;
        growth[l] = 1.0;
        x[0][l] = x[1][l] = x[2][l] = x[3][l] = x[4][l] = x[5][l] = 0.0;
    }
    for (int k = 0; k < 6; k++) {
        double square[IK_FEW];
        ik_squares(inverse[k], square);
        for (int c = 0; c < 6; c++) {
            for (int l = 0; l < IK_FEW; l++) {
                x[c][l] = longest[l] < square[l] ? inverse[k][c][l] : x[c][l];
            }
        }
        for (int l = 0; l < IK_FEW; l++) {
            longest[l] = longest[l] < square[l] ? square[l] : longest[l];
        }
    }
    for (int turn = 0; turn < 4; turn++) {
        double square[IK_FEW], image[6][IK_FEW];
        ik_squares(x, square);
        for (int k = 0; k < 6; k++) {
            for (int l = 0; l < IK_FEW; l++) {
                image[k][l] = 0.0;
            }
            for (int c = 0; c < 6; c++) {
                for (int l = 0; l < IK_FEW; l++) {
                    image[k][l] = IK_ADD(inverse[k][c][l], x[c][l], image[k][l]);
                }
            }
        }
        ik_squares(image, growth);
        for (int l = 0; l < IK_FEW; l++) {
            growth[l] /= square[l];
            x[0][l] = x[1][l] = x[2][l] = x[3][l] = x[4][l] = x[5][l] = 0.0;
        }
        for (int k = 0; k < 6; k++) {
            for (int c = 0; c < 6; c++) {
                for (int l = 0; l < IK_FEW; l++) {
                    x[c][l] = IK_ADD(inverse[k][c][l], image[k][l], x[c][l]);
                }
            }
        }
        /* Only the direction counts. */
        for (int l = 0; l < IK_FEW; l++) {
            square[l] = 1.0 / (growth[l] * square[l]);
        }
        for (int c = 0; c < 6; c++) {
            for (int l = 0; l < IK_FEW; l++) {
                x[c][l] *= square[l];
            }
        }
    }
    for (int l = 0; l < IK_FEW; l++) {
        out[l] = 1.0 / sqrt(growth[l]);
    }
}
