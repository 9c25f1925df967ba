
/*
 * A wider matrix of the hidden joint, for poses at which the determinant vanishes identically, such as those
 * whose last axis is parallel to the first.
 *
 * With half angles (u, v) and (u', v') for both joints that are not hidden, the six equations are forms of
 * degree 2 in either pair. Multiplied by u u', u v', v u' and v v' they are 24 equations between the 16
 * monomials of degree 3 in either pair, and lose rank only where there is a solution. Sixteen fixed mixtures
 * have a determinant of degree 12 in the hidden angle; those of its roots at which the 24 equations keep
 * their rank, or have null vectors that are not real, are dismissed.
 */

/* From the monomials of a joint, every so many entries, to those of its half angle: 1 = u^2 + v^2,
   c = u^2 - v^2, s = 2 u v; a slide's stay as they are. */
static void ik_halve(int slides, int stride, double form[9])
{
    for (int at = 0; at < 9; at++) {
        if (!slides && at / stride % 3 == 0) {
            const double one = form[at];
            const double c = form[at + stride];
            const double s = form[at + 2 * stride];
            form[at] = one + c;
            form[at + stride] = 2.0 * s;
            form[at + 2 * stride] = one - c;
        }
    }
}

/* The equations in half angles of a4 and a5: forms of degree 2 in either pair, over (1, c, s) of a3. Takes
   them with their own sizes: one that is all rounding must not be enlarged. */
static NOINLINE void ik_halve_rows(const ik_split *split, ik_eliminated *e)
{
    for (int i = 0; i < 6; i++) {
        for (int part = 0; part < 3; part++) {
            double *form = e->rows[i] + 9 * part;
            for (int k = 0; k < 9; k++) {
                form[k] *= e->sizes[i];
            }
            ik_halve(ik_other_slides(split), 1, form);
            ik_halve(ik_multiplied_slides(split), 3, form);
        }
    }
}

/* The forms at a value of the hidden joint. */
static void ik_forms_at(const ik_eliminated *e, double c, double s, double forms[6][9])
{
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 9; k++) {
            forms[i][k] = e->rows[i][k] + c * e->rows[i][9 + k] + s * e->rows[i][18 + k];
        }
    }
}

/* A form times one of the four multipliers, as a row of the matrix. */
static void ik_place(const double form[9], int multiplier, double row[IK_MONOMIALS])
{
    for (int k = 0; k < IK_MONOMIALS; k++) {
        row[k] = 0.0;
    }
    for (int i = 0; i < 3; i++) {
        double *to = row + 4 * (i + multiplier / 2) + multiplier % 2;
        for (int k = 0; k < 3; k++) {
            to[k] = form[3 * i + k];
        }
    }
}

/* The determinant of the mixtures, by elimination with partial pivoting. */
static NOINLINE double ik_wide_determinant(const ik_eliminated *e, double c, double s)
{
    double m[IK_MONOMIALS][IK_MONOMIALS];
    double *rows[IK_MONOMIALS];
    double forms[6][9];
    double product = 1.0;
    ik_forms_at(e, c, s, forms);
    for (int i = 0; i < IK_MONOMIALS; i++) {
        double mixed[9] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        for (int j = 0; j < 6; j++) {
            for (int k = 0; k < 9; k++) {
                mixed[k] += ik_mixtures[i][j] * forms[j][k];
            }
        }
        ik_place(mixed, i / 4, m[i]);
        rows[i] = m[i];
    }
    for (int k = 0; k < IK_MONOMIALS; k++) {
        int best = k;
        for (int r = k + 1; r < IK_MONOMIALS; r++) {
            best = fabs(rows[r][k]) > fabs(rows[best][k]) ? r : best;
        }
        double *pivot = rows[best];
        rows[best] = rows[k];
        rows[k] = pivot;
        product *= best == k ? pivot[k] : -pivot[k];
        if (pivot[k] == 0.0) {
            return 0.0;
        }
        const double inverse = 1.0 / pivot[k];
        for (int r = k + 1; r < IK_MONOMIALS; r++) {
            double *RESTRICT row = rows[r];
            const double *RESTRICT from = pivot;
            const double factor = row[k] * inverse;
            for (int l = 0; l < IK_MONOMIALS; l++) {
                row[l] = IK_ADD(-factor, from[l], row[l]);
            }
        }
    }
    return product;
}

/* The vectors that all equations take to zero, or almost. */
typedef struct ik_null {
    double basis[IK_SHARED][IK_MONOMIALS];
    int count;
    /* The last pivot, compared to the first: zero where there are null vectors. */
    double least;
} ik_null;

/* Eliminates with complete pivoting: which column stands where, and the sizes of the pivots. */
static void ik_eliminate_wide(
    double m[IK_EQUATIONS][IK_MONOMIALS], int order[IK_MONOMIALS], double sizes[IK_MONOMIALS])
{
    for (int k = 0; k < IK_MONOMIALS; k++) {
        order[k] = k;
        sizes[k] = 0.0;
    }
    for (int k = 0; k < IK_MONOMIALS; k++) {
        int row = k, column = k;
        for (int r = k; r < IK_EQUATIONS; r++) {
            for (int c = k; c < IK_MONOMIALS; c++) {
                if (fabs(m[r][c]) > sizes[k]) {
                    sizes[k] = fabs(m[r][c]);
                    row = r;
                    column = c;
                }
            }
        }
        if (sizes[k] == 0.0) {
            return;
        }
        for (int c = 0; c < IK_MONOMIALS; c++) {
            const double kept = m[k][c];
            m[k][c] = m[row][c];
            m[row][c] = kept;
        }
        for (int r = 0; r < IK_EQUATIONS; r++) {
            const double kept = m[r][k];
            m[r][k] = m[r][column];
            m[r][column] = kept;
        }
        const int place = order[k];
        order[k] = order[column];
        order[column] = place;
        for (int r = k + 1; r < IK_EQUATIONS; r++) {
            const double factor = m[r][k] / m[k][k];
            for (int c = k; c < IK_MONOMIALS; c++) {
                m[r][c] -= factor * m[k][c];
            }
        }
    }
}

/* The null space of all equations; pivots below a bound, compared to the first, count as zeros. */
static NOINLINE void ik_find_null(
    const ik_eliminated *e, const double hidden[2], double small, ik_null *out)
{
    double m[IK_EQUATIONS][IK_MONOMIALS];
    double forms[6][9];
    double sizes[IK_MONOMIALS];
    int order[IK_MONOMIALS];
    int rank = 0;
    ik_forms_at(e, hidden[0], hidden[1], forms);
    for (int i = 0; i < IK_EQUATIONS; i++) {
        ik_place(forms[i / 4], i % 4, m[i]);
    }
    ik_eliminate_wide(m, order, sizes);
    out->least = sizes[IK_MONOMIALS - 1] / sizes[0];
    while (rank < IK_MONOMIALS && sizes[rank] > small * sizes[0]) {
        rank++;
    }
    rank = rank < IK_MONOMIALS - IK_SHARED ? IK_MONOMIALS - IK_SHARED : rank;
    out->count = IK_MONOMIALS - rank;
    for (int j = 0; j < out->count; j++) {
        double y[IK_MONOMIALS];
        double norm = 0.0;
        for (int k = 0; k < IK_MONOMIALS; k++) {
            y[k] = k == rank + j ? 1.0 : 0.0;
        }
        for (int k = rank - 1; k >= 0; k--) {
            double sum = 0.0;
            for (int c = k + 1; c < IK_MONOMIALS; c++) {
                sum += m[k][c] * y[c];
            }
            y[k] = m[k][k] == 0.0 ? 0.0 : -sum / m[k][k];
        }
        for (int k = 0; k < IK_MONOMIALS; k++) {
            norm += y[k] * y[k];
        }
        for (int k = 0; k < IK_MONOMIALS; k++) {
            out->basis[j][order[k]] = y[k] / sqrt(norm);
        }
    }
}

/* Adds a multiple of the matrix of the shift by so many entries, from one power of v to the next: on
   products of powers it is the number v/u. The pair is turned by a fixed angle first, so that no solution
   has u = 0 but by accident. 0 if it is singular. */
static NOINLINE int ik_shift(const ik_null *null, int stride, double factor, double sum[IK_SHARED][IK_SHARED])
{
    const double turn[2] = {0.5403023058681398, 0.8414709848078965};
    const int count = null->count;
    double top[IK_SHARED][12], bottom[IK_SHARED][12];
    double system[IK_SHARED][2 * IK_SHARED];
    for (int j = 0; j < count; j++) {
        for (int k = 0; k < 12; k++) {
            const int i = stride == 1 ? k / 3 * 4 + k % 3 : k;
            const double a = null->basis[j][i];
            const double b = null->basis[j][stride == 1 ? i + 1 : i + 4];
            top[j][k] = turn[0] * a + turn[1] * b;
            bottom[j][k] = turn[0] * b - turn[1] * a;
        }
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            system[i][j] = system[i][count + j] = 0.0;
            for (int k = 0; k < 12; k++) {
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
            sum[i][j] += factor * system[i][count + j];
        }
    }
    return 1;
}

/* The products (u^3 ... v^3) x (u'^3 ... v'^3) among the null vectors that are real up to a tolerance: how
   many; -1 if that cannot be told. They are the eigenvectors of a mixture of both shifts. */
static NOINLINE int ik_products(const ik_null *null, double tolerance, double out[IK_SHARED][IK_MONOMIALS])
{
    const int count = null->count;
    double x[IK_SHARED][IK_SHARED];
    double values[IK_SHARED];
    if (count < 2) {
        memcpy(out[0], null->basis[0], sizeof null->basis[0]);
        return count;
    }
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            x[i][j] = 0.0;
        }
    }
    if (!ik_shift(null, 4, 1.0, x) || !ik_shift(null, 1, 0.6180339887498949, x)) {
        return -1;
    }
    const int real_values = ik_real_eigenvalues(x, count, tolerance, values);
    for (int n = 0; n < real_values; n++) {
        double shifted[IK_SHARED][IK_SHARED];
        double g[IK_SHARED];
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                shifted[i][j] = x[i][j] - (i == j ? values[n] : 0.0);
            }
        }
        ik_null_vector(shifted, count, g);
        for (int k = 0; k < IK_MONOMIALS; k++) {
            out[n][k] = 0.0;
            for (int j = 0; j < count; j++) {
                out[n][k] += g[j] * null->basis[j][k];
            }
        }
    }
    return real_values;
}

/* The pair (u, v) whose third powers four blocks are proportional to: of length 1, or (1, d) of a slide. */
static void ik_pair(int slides, int stride, const double *blocks, double out[2])
{
    double uu = 0.0, uv = 0.0, vv = 0.0;
    for (int k = 0; k < 3 * stride; k++) {
        uu += blocks[k] * blocks[k];
        uv += blocks[k] * blocks[k + stride];
        vv += blocks[k + stride] * blocks[k + stride];
    }
    const double u = uu > vv ? uu : uv;
    const double v = uu > vv ? uv : vv;
    if (slides) {
        out[0] = 1.0;
        out[1] = v / u;
    } else {
        ik_unit(u, v, out);
    }
}

/* The null vector of the 12 x 12 matrix that belongs to a product of powers. */
static void ik_narrowed(
    const ik_split *split, const double y[IK_MONOMIALS], double out[IK_UNKNOWNS])
{
    const int slides[2] = {ik_multiplied_slides(split), ik_other_slides(split)};
    const double r = slides[0] ? 1.0 : sqrt(3.0);
    double first[2], second[2];
    double z[4];
    ik_pair(slides[0], 4, y, first);
    const double u = first[0];
    const double v = first[1];
    const double powers[4] = {u * u * u, u * u * v, u * v * v, v * v * v};
    for (int k = 0; k < 4; k++) {
        z[k] = 0.0;
        for (int i = 0; i < 4; i++) {
            z[k] += powers[i] * y[4 * i + k];
        }
    }
    ik_pair(slides[1], 1, z, second);
    const double a = second[0];
    const double b = second[1];
    const double w[3] = {1.0, slides[1] ? b : a * a - b * b, slides[1] ? b * b : 2.0 * a * b};
    for (int k = 0; k < IK_UNKNOWNS; k++) {
        out[k] = (k >= 3 && k < 9 ? r : 1.0) * powers[k / 3] * w[k % 3];
    }
}

/* Offers the products in a null space: how many; -1 if it is not known which they are. */
static NOINLINE int ik_wide_products(
    const double hidden[2], const ik_null *null, double tolerance, ik_batch *batch)
{
    double vectors[IK_SHARED][IK_MONOMIALS];
    const int count = ik_products(null, tolerance, vectors);
    for (int n = 0; n < count; n++) {
        double own[IK_UNKNOWNS];
        ik_narrowed(batch->split, vectors[n], own);
        ik_offer(batch, hidden, own);
    }
    return count;
}

/* Numbers the groups of roots near the circle that lie together, -1 for others; how many there are. */
static int ik_grouped(const ik_work *work, const ik_chart *chart, int group[IK_WIDE_ROOTS])
{
    int groups = 0;
    for (int k = 0; k < work->roots; k++) {
        const double x = work->x[k];
        const double y = work->y[k];
        const double modulus = sqrt(x * x + y * y);
        const double off = fabs(modulus - 1.0);
        group[k] = -1;
        if ((off >= 0.02 && off > work->radius[k]) || !ik_answers_for(chart, x / modulus + 0.1)) {
            continue;
        }
        group[k] = groups++;
        for (int j = 0; j < k; j++) {
            const double away = fabs(x - work->x[j]) + fabs(y - work->y[j]);
            /* Roots closer than this may be one that several solutions share. */
            if (group[j] < 0 || group[j] == group[k] || away >= 2e-3) {
                continue;
            }
            /* Two groups become one, and the last group takes the number that is free. */
            const int low = group[j] < group[k] ? group[j] : group[k];
            const int high = group[j] < group[k] ? group[k] : group[j];
            groups--;
            for (int i = 0; i <= k; i++) {
                group[i] = group[i] == high ? low : group[i] == groups ? high : group[i];
            }
        }
    }
    return groups;
}

/* Cosine and sine of the hidden joint in the direction of a point near the circle. */
static void ik_on_circle(const ik_chart *chart, double x, double y, double out[2])
{
    const double modulus = sqrt(x * x + y * y);
    ik_outside(chart, x / modulus, y / modulus, out);
}

/* Offers what belongs to a group of roots that are one, in their middle, with as many null vectors: then
   those are all there are, and those that are not real need no configuration. 0 if the group is no such. */
static NOINLINE int ik_settle_middle(
    const ik_chart *chart, const int group[IK_WIDE_ROOTS], int own, ik_batch *batch)
{
    ik_work *work = batch->work;
    ik_null null;
    double hidden[2];
    double x = 0.0, y = 0.0;
    int size = 0;
    for (int k = 0; k < work->roots; k++) {
        if (group[k] == own) {
            x += work->x[k];
            y += work->y[k];
            size++;
        }
    }
    if (size < 2) {
        return 0;
    }
    ik_on_circle(chart, x, y, hidden);
    ik_find_null(&work->eliminated, hidden, 1e-8, &null);
    if (null.count != size) {
        return 0;
    }
    /* Ten times the root of that bound is the most by which a double eigenvalue can be off. */
    int rest = ik_wide_products(hidden, &null, 1e-3, batch);
    if (rest < 0) {
        return 0;
    }
    for (int k = 0; k < work->roots; k++) {
        if (group[k] == own && rest-- <= 0) {
            work->radius[k] = -1.0;
        }
    }
    return 1;
}

/* Offers what belongs to a root on its own. */
static NOINLINE void ik_settle_root(const ik_chart *chart, int root, ik_batch *batch)
{
    ik_work *work = batch->work;
    ik_null null;
    double hidden[2];
    ik_on_circle(chart, work->x[root], work->y[root], hidden);
    ik_find_null(&work->eliminated, hidden, 1e-3, &null);
    /* Full rank at every angle in the disc: a root of the mixtures only. */
    if (null.least > 100.0 * chart->kappa * work->radius[root] && null.least > 1e-9) {
        work->radius[root] = -1.0;
    }
    ik_wide_products(hidden, &null, ik_almost, batch);
}

/* The polynomial of a chart; 0 if the samples are of no use. */
static NOINLINE int ik_wide_samples(const ik_chart *chart, ik_work *work)
{
    double samples[IK_WIDE_SAMPLES];
    for (int from = 0; from < IK_WIDE_SAMPLES; from += IK_LANES) {
        double c[IK_LANES], s[IK_LANES], weight[IK_LANES];
        ik_nodes(chart, ik_wide_cosines + from, ik_wide_sines + from, c, s, weight);
        for (int l = 0; l < IK_LANES; l++) {
            const double square = weight[l] * weight[l];
            const double fourth = square * square;
            samples[from + l] =
                ik_wide_determinant(&work->eliminated, c[l], s[l]) * (fourth * fourth * fourth);
        }
    }
    return ik_fit(work, IK_WIDE_DEGREE, IK_WIDE_SAMPLES, &ik_wide_transform[0][0], samples);
}

/* Offers the null vectors at the roots. */
static NOINLINE void ik_wide_candidates(const ik_chart *chart, ik_batch *batch)
{
    int group[IK_WIDE_ROOTS] = {0};
    const int groups = ik_grouped(batch->work, chart, group);
    for (int own = 0; own < groups; own++) {
        if (ik_settle_middle(chart, group, own, batch)) {
            continue;
        }
        for (int k = 0; k < batch->work->roots; k++) {
            if (group[k] == own) {
                ik_settle_root(chart, k, batch);
            }
        }
    }
}
