
/*
 * Null vectors of the matrix at known values of the hidden joint: some at a time, or all of a shared one.
 */

static NOINLINE void ik_reduce_few(double *m, int next, double *product)
{
    ik_reduce(m, next, IK_WIDTH, 3, IK_FEW, product);
}

/* The three unknowns that a reduced strip has eliminated. */
static void ik_outer(
    const double *strip, int next, double middle[6][IK_FEW], double out[3][IK_FEW])
{
    for (int k = 2; k >= 0; k--) {
        const double *row = strip + k * next * IK_FEW;
        double sum[IK_FEW] = {0.0, 0.0, 0.0, 0.0};
        for (int c = 0; c < 6; c++) {
            ik_subtract(sum, row + (3 + c) * IK_FEW, middle[c], IK_FEW);
        }
        for (int c = k + 1; c < 3; c++) {
            ik_subtract(sum, row + c * IK_FEW, out[c], IK_FEW);
        }
        for (int l = 0; l < IK_FEW; l++) {
            const double diagonal = row[k * IK_FEW + l];
            const double pivot = diagonal == 0.0 ? 1e-300 : diagonal;
            out[k][l] = sum[l] / pivot;
        }
    }
}

/* A null vector in each lane, and how small the second smallest pivot is compared to the first: where
   it is small too, several solutions share the value. */
static NOINLINE void ik_null_vectors(
    const ik_eliminated *e, int slides, const double *c, const double *s,
    double x[IK_UNKNOWNS][IK_FEW], double *small)
{
    double strips[IK_HEIGHT][IK_WIDTH][IK_FEW];
    double(*m)[IK_WIDTH][IK_FEW] = strips + 3;
    double order[6][IK_FEW], y[6][IK_FEW], product[IK_FEW];
    ik_strip(e, slides, 0, c, s, IK_FEW, IK_WIDTH, &strips[0][0][0]);
    ik_strip(e, slides, 1, c, s, IK_FEW, -IK_WIDTH, &strips[IK_HEIGHT - 1][0][0]);
    ik_reduce_few(&strips[0][0][0], IK_WIDTH, product);
    ik_reduce_few(&strips[IK_HEIGHT - 1][0][0], -IK_WIDTH, product);
    for (int k = 0; k < 6; k++) {
        for (int l = 0; l < IK_FEW; l++) {
            order[k][l] = k;
        }
    }

    /* Complete pivoting of the core, columns 3 to 8: the largest entry of what is left goes to the
       diagonal. */
    for (int k = 0; k < 5; k++) {
        double best[IK_FEW], row[IK_FEW], column[IK_FEW], inverse[IK_FEW];
        uint64_t where[IK_FEW];
        for (int l = 0; l < IK_FEW; l++) {
            best[l] = -1.0;
            row[l] = column[l] = 0.0;
        }
        for (int r = k; r < 6; r++) {
            for (int d = k; d < 6; d++) {
                const double *RESTRICT entry = m[r][3 + d];
                for (int l = 0; l < IK_FEW; l++) {
                    const double size = fabs(entry[l]);
                    row[l] = best[l] < size ? (double)r : row[l];
                    column[l] = best[l] < size ? (double)d : column[l];
                    best[l] = best[l] < size ? size : best[l];
                }
            }
        }
        for (int r = k + 1; r < 6; r++) {
            for (int l = 0; l < IK_FEW; l++) {
                where[l] = row[l] == (double)r ? IK_ALL : 0;
            }
            for (int d = k; d < 6; d++) {
                ik_swap(m[k][3 + d], m[r][3 + d], where, IK_FEW);
            }
        }
        for (int d = k + 1; d < 6; d++) {
            for (int l = 0; l < IK_FEW; l++) {
                where[l] = column[l] == (double)d ? IK_ALL : 0;
            }
            for (int r = 0; r < 6; r++) {
                ik_swap(m[r][3 + k], m[r][3 + d], where, IK_FEW);
            }
            ik_swap(order[k], order[d], where, IK_FEW);
        }
        for (int l = 0; l < IK_FEW; l++) {
            const double quotient = 1.0 / m[k][3 + k][l];
            inverse[l] = m[k][3 + k][l] == 0.0 ? 0.0 : quotient;
        }
        for (int r = k + 1; r < 6; r++) {
            double factor[IK_FEW];
            for (int l = 0; l < IK_FEW; l++) {
                factor[l] = m[r][3 + k][l] * inverse[l];
            }
            for (int d = k + 1; d < 6; d++) {
                ik_subtract(m[r][3 + d], factor, m[k][3 + d], IK_FEW);
            }
        }
    }

    /* Back substitution with the last unknown 1; then back to the order of the columns. */
    for (int l = 0; l < IK_FEW; l++) {
        small[l] = fabs(m[4][7][l]) / fabs(m[0][3][l]);
        y[5][l] = 1.0;
    }
    for (int k = 4; k >= 0; k--) {
        double sum[IK_FEW] = {0.0, 0.0, 0.0, 0.0};
        for (int d = k + 1; d < 6; d++) {
            ik_subtract(sum, m[k][3 + d], y[d], IK_FEW);
        }
        for (int l = 0; l < IK_FEW; l++) {
            const double pivot = m[k][3 + k][l] == 0.0 ? 1e-300 : m[k][3 + k][l];
            y[k][l] = sum[l] / pivot;
        }
    }
    for (int d = 0; d < 6; d++) {
        double *RESTRICT out = x[3 + d];
        for (int l = 0; l < IK_FEW; l++) {
            out[l] = 0.0;
        }
        for (int k = 0; k < 6; k++) {
            for (int l = 0; l < IK_FEW; l++) {
                out[l] = order[k][l] == (double)d ? y[k][l] : out[l];
            }
        }
    }
    ik_outer(&strips[0][0][0], IK_WIDTH, x + 3, x);
    ik_outer(&strips[IK_HEIGHT - 1][0][0], -IK_WIDTH, x + 3, x + 9);
}

/* A basis of the null space by elimination with complete pivoting; its dimension. */
static int ik_null_space(
    double m[IK_UNKNOWNS][IK_UNKNOWNS], double basis[IK_SHARED][IK_UNKNOWNS])
{
    int order[IK_UNKNOWNS] = {0};
    int rank = 0;
    double first = 0.0;
    for (int k = 0; k < IK_UNKNOWNS; k++) {
        order[k] = k;
    }
    while (rank < IK_UNKNOWNS - 1) {
        double best = 0.0;
        int row = rank, column = rank;
        for (int r = rank; r < IK_UNKNOWNS; r++) {
            for (int c = rank; c < IK_UNKNOWNS; c++) {
                if (fabs(m[r][c]) > best) {
                    best = fabs(m[r][c]);
                    row = r;
                    column = c;
                }
            }
        }
        if (rank == 0) {
            first = best;
        }
        if ((IK_UNKNOWNS - rank <= IK_SHARED && best <= 1e-5 * first) || best == 0.0) {
            break;
        }
        for (int c = 0; c < IK_UNKNOWNS; c++) {
            const double kept = m[rank][c];
            m[rank][c] = m[row][c];
            m[row][c] = kept;
        }
        for (int r = 0; r < IK_UNKNOWNS; r++) {
            const double kept = m[r][rank];
            m[r][rank] = m[r][column];
            m[r][column] = kept;
        }
        const int place = order[rank];
        order[rank] = order[column];
        order[column] = place;
        for (int r = rank + 1; r < IK_UNKNOWNS; r++) {
            const double factor = m[r][rank] / m[rank][rank];
            for (int c = rank + 1; c < IK_UNKNOWNS; c++) {
                m[r][c] -= factor * m[rank][c];
            }
        }
        rank++;
    }
    const int count = IK_UNKNOWNS - rank < IK_SHARED ? IK_UNKNOWNS - rank : IK_SHARED;
    for (int j = 0; j < count; j++) {
        double y[IK_UNKNOWNS];
        double norm = 0.0;
        for (int k = 0; k < IK_UNKNOWNS; k++) {
            y[k] = k == rank + j ? 1.0 : 0.0;
        }
        for (int k = rank - 1; k >= 0; k--) {
            double sum = 0.0;
            for (int c = k + 1; c < IK_UNKNOWNS; c++) {
                sum += m[k][c] * y[c];
            }
            y[k] = -sum / m[k][k];
        }
        for (int k = 0; k < IK_UNKNOWNS; k++) {
            norm += y[k] * y[k];
        }
        for (int k = 0; k < IK_UNKNOWNS; k++) {
            basis[j][order[k]] = y[k] / sqrt(norm);
        }
    }
    return count;
}

/* Solves [A | B] in place for square A; 0 if it is singular. */
static int ik_gauss_jordan(double m[IK_SHARED][2 * IK_SHARED], int size)
{
    for (int k = 0; k < size; k++) {
        int row = k;
        for (int r = k + 1; r < size; r++) {
            row = fabs(m[r][k]) > fabs(m[row][k]) ? r : row;
        }
        for (int c = 0; c < 2 * size; c++) {
            const double kept = m[k][c];
            m[k][c] = m[row][c];
            m[row][c] = kept;
        }
        const double pivot = m[k][k];
        if (fabs(pivot) < 1e-14) {
            return 0;
        }
        for (int c = 0; c < 2 * size; c++) {
            m[k][c] /= pivot;
        }
        for (int r = 0; r < size; r++) {
            const double factor = m[r][k];
            for (int c = 0; c < 2 * size && r != k; c++) {
                m[r][c] -= factor * m[k][c];
            }
        }
    }
    return 1;
}

/* Eigenvalues with a smaller relative imaginary part may be real: rounding makes pairs of double ones. */
static const double ik_almost = 0.03;

/* The eigenvalues that are real up to a relative tolerance: the characteristic polynomial by Faddeev and
   LeVerrier, its roots by Weierstrass' iteration. */
static int ik_real_eigenvalues(
    double m[IK_SHARED][IK_SHARED], int size, double tolerance, double out[IK_SHARED])
{
    double c[IK_SHARED + 1];
    double product[IK_SHARED][IK_SHARED];
    double zr[IK_SHARED], zi[IK_SHARED];
    double radius = 0.0;
    int found = 0;
    if (size == 2) {
        const double half = (m[0][0] + m[1][1]) / 2.0;
        const double difference = (m[0][0] - m[1][1]) / 2.0;
        const double under = difference * difference + m[0][1] * m[1][0];
        /* A pair that is complex by a little is a double one. */
        if (under < -tolerance * tolerance * (half * half + difference * difference + 1e-12)) {
            return 0;
        }
        const double root = under > 0.0 ? sqrt(under) : 0.0;
        out[0] = half + root;
        out[1] = half - root;
        return 2;
    }
    for (int i = 0; i < IK_SHARED; i++) {
        for (int j = 0; j < IK_SHARED; j++) {
            product[i][j] = 0.0;
        }
    }
    c[size] = 1.0;
    for (int k = 1; k <= size; k++) {
        double sum[IK_SHARED][IK_SHARED];
        double trace = 0.0;
        memcpy(sum, product, sizeof sum);
        for (int i = 0; i < size; i++) {
            sum[i][i] += c[size + 1 - k];
        }
        for (int i = 0; i < size; i++) {
            for (int j = 0; j < size; j++) {
                product[i][j] = 0.0;
                for (int l = 0; l < size; l++) {
                    product[i][j] += m[i][l] * sum[l][j];
                }
            }
            trace += product[i][i];
        }
        c[size - k] = -trace / k;
    }
    for (int k = 0; k < size; k++) {
        radius = fabs(c[k]) > radius ? fabs(c[k]) : radius;
    }
    for (int k = 0; k < size; k++) {
        zr[k] = sqrt(1.0 + radius) * cos(0.4 + IK_TURN * k / size);
        zi[k] = sqrt(1.0 + radius) * sin(0.4 + IK_TURN * k / size);
    }
    for (int turn = 0; turn < 60; turn++) {
        double largest = 0.0;
        for (int k = 0; k < size; k++) {
            double vr = 1.0, vi = 0.0, br = 1.0, bi = 0.0;
            for (int j = size - 1; j >= 0; j--) {
                const double next = vr * zr[k] - vi * zi[k] + c[j];
                vi = vr * zi[k] + vi * zr[k];
                vr = next;
            }
            for (int j = 0; j < size; j++) {
                if (j != k) {
                    const double dr = zr[k] - zr[j];
                    const double di = zi[k] - zi[j];
                    const double next = br * dr - bi * di;
                    bi = br * di + bi * dr;
                    br = next;
                }
            }
            const double square = br * br + bi * bi;
            if (square == 0.0) {
                continue;
            }
            const double sr = (vr * br + vi * bi) / square;
            const double si = (vi * br - vr * bi) / square;
            zr[k] -= sr;
            zi[k] -= si;
            largest = fabs(sr) + fabs(si) > largest ? fabs(sr) + fabs(si) : largest;
        }
        if (largest < 1e-13) {
            break;
        }
    }
    for (int k = 0; k < size; k++) {
        if (fabs(zi[k]) <= tolerance * (1.0 + fabs(zr[k]))) {
            out[found++] = zr[k];
        }
    }
    return found;
}

/* A vector that a matrix, singular or almost, takes to nearly zero. */
static void ik_null_vector(double m[IK_SHARED][IK_SHARED], int size, double out[IK_SHARED])
{
    int order[IK_SHARED] = {0};
    double y[IK_SHARED];
    for (int k = 0; k < size; k++) {
        order[k] = k;
    }
    for (int k = 0; k < size - 1; k++) {
        double best = -1.0;
        int row = k, column = k;
        for (int r = k; r < size; r++) {
            for (int c = k; c < size; c++) {
                if (fabs(m[r][c]) > best) {
                    best = fabs(m[r][c]);
                    row = r;
                    column = c;
                }
            }
        }
        for (int c = 0; c < size; c++) {
            const double kept = m[k][c];
            m[k][c] = m[row][c];
            m[row][c] = kept;
        }
        for (int r = 0; r < size; r++) {
            const double kept = m[r][k];
            m[r][k] = m[r][column];
            m[r][column] = kept;
        }
        const int place = order[k];
        order[k] = order[column];
        order[column] = place;
        if (m[k][k] == 0.0) {
            break;
        }
        for (int r = k + 1; r < size; r++) {
            const double factor = m[r][k] / m[k][k];
            for (int c = k; c < size; c++) {
                m[r][c] -= factor * m[k][c];
            }
        }
    }
    y[size - 1] = 1.0;
    for (int k = size - 2; k >= 0; k--) {
        double sum = 0.0;
        for (int c = k + 1; c < size; c++) {
            sum += m[k][c] * y[c];
        }
        y[k] = m[k][k] == 0.0 ? 0.0 : -sum / m[k][k];
    }
    for (int k = 0; k < size; k++) {
        out[order[k]] = y[k];
    }
}

/* The matrix [A B/r C/r 0; 0 A/r B/r C] at one value, the first three columns of the lower strip last. */
static NOINLINE void ik_both_strips(
    const ik_eliminated *e, int slides, double c, double s, double m[IK_UNKNOWNS][IK_UNKNOWNS])
{
    ik_strip(e, slides, 0, &c, &s, 1, IK_UNKNOWNS, m[0]);
    ik_strip(e, slides, 1, &c, &s, 1, IK_UNKNOWNS, m[6]);
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) {
            m[i][9 + k] = 0.0;
            m[6 + i][9 + k] = m[6 + i][k];
            m[6 + i][k] = 0.0;
        }
    }
}

/* The null vectors of solutions that share a value of the hidden joint; their number.
   With V a basis of the null space, x = V g has v top g = u bottom g: eigenvectors of a small pencil. */
static NOINLINE int ik_shared(
    const ik_eliminated *e, int slides, double c, double s, double out[IK_SHARED][IK_UNKNOWNS])
{
    double values[IK_SHARED];
    double m[IK_UNKNOWNS][IK_UNKNOWNS];
    double basis[IK_SHARED][IK_UNKNOWNS];
    double top[IK_SHARED][9], bottom[IK_SHARED][9];
    double system[IK_SHARED][2 * IK_SHARED];
    double x[IK_SHARED][IK_SHARED];
    const double weight = slides ? 1.0 : 1.0 / sqrt(3.0);
    const double turn[2] = {0.5403023058681398, 0.8414709848078965};
    ik_both_strips(e, slides, c, s, m);
    const int count = ik_null_space(m, basis);
    if (count < 2) {
        memcpy(out[0], basis[0], sizeof basis[0]);
        return count;
    }
    for (int j = 0; j < count; j++) {
        for (int i = 0; i < 9; i++) {
            const double a = basis[j][i] * (i >= 3 ? weight : 1.0);
            const double b = basis[j][i + 3] * (i < 6 ? weight : 1.0);
            top[j][i] = turn[0] * a + turn[1] * b;
            bottom[j][i] = turn[0] * b - turn[1] * a;
        }
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            system[i][j] = system[i][count + j] = 0.0;
            for (int k = 0; k < 9; k++) {
                system[i][j] += top[i][k] * top[j][k];
                system[i][count + j] += top[i][k] * bottom[j][k];
            }
        }
    }
    if (!ik_gauss_jordan(system, count)) {
        return 0;
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            x[i][j] = system[i][count + j];
        }
    }
    const int real_values = ik_real_eigenvalues(x, count, ik_almost, values);
    for (int n = 0; n < real_values; n++) {
        double shifted[IK_SHARED][IK_SHARED];
        double g[IK_SHARED];
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                shifted[i][j] = x[i][j] - (i == j ? values[n] : 0.0);
            }
        }
        ik_null_vector(shifted, count, g);
        for (int k = 0; k < IK_UNKNOWNS; k++) {
            out[n][k] = 0.0;
            for (int j = 0; j < count; j++) {
                out[n][k] += g[j] * basis[j][k];
            }
        }
    }
    return real_values;
}
