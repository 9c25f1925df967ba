
/*
 * From fourteen equations to six that are free of two joints.
 */

/* [p, l, p.p, p.l, p x l, (p.p) l - 2 (p.l) p] of a line with the point p and the direction l. */
static void ik_forms(const double p[3], const double l[3], double out[IK_FORMS])
{
    const double pp = ik_dot(p, p);
    const double pl = ik_dot(p, l);
    double n[3];
    ik_cross(p, l, n);
    for (int x = 0; x < 3; x++) {
        out[x] = p[x];
        out[3 + x] = l[x];
        out[8 + x] = n[x];
        out[11 + x] = pp * l[x] - 2.0 * pl * p[x];
    }
    out[6] = pp;
    out[7] = pl;
}

/* The forms after the inverse of the second joint, over the monomials of both. */
static void ik_move_back(int slides, double of[IK_FORMS][3], double out[IK_FORMS][9])
{
    static const int vectors[4] = {0, 3, 8, 11};
    for (int k = 0; k < IK_FORMS; k++) {
        for (int c = 0; c < 9; c++) {
            out[k][c] = 0.0;
        }
    }
    for (int i = 0; i < 3; i++) {
        const int at = 3 * i;
        if (!slides) {
            for (int b = 0; b < 4; b++) {
                const int v = vectors[b];
                out[v][at + 1] = of[v][i];
                out[v][at + 2] = of[v + 1][i];
                out[v + 1][at + 1] = of[v + 1][i];
                out[v + 1][at + 2] = -of[v][i];
                out[v + 2][at] = of[v + 2][i];
            }
            out[6][at] = of[6][i];
            out[7][at] = of[7][i];
        } else {
            for (int k = 0; k < IK_FORMS; k++) {
                out[k][at] = of[k][i];
            }
            out[6][at + 1] = -2.0 * of[2][i];
            out[7][at + 1] = -of[5][i];
            out[8][at + 1] = of[4][i];
            out[9][at + 1] = -of[3][i];
            out[11][at + 1] = -2.0 * of[9][i];
            out[12][at + 1] = 2.0 * of[8][i];
            out[13][at + 1] = 2.0 * of[7][i];
            out[11][at + 2] = of[3][i];
            out[12][at + 2] = of[4][i];
            out[13][at + 2] = -of[5][i];
        }
    }
    if (slides) {
        out[2][1] -= 1.0;
        out[6][2] += 1.0;
    }
}

/* The forms of the line moved by a motion; the first of the nine monomials is 1. */
static void ik_moved(const ik_rigid *by, double of[IK_FORMS][9], double out[IK_FORMS][9])
{
    const double *t = by->t;
    const double tt = ik_dot(t, t);
    for (int k = 0; k < 9; k++) {
        double moved[4][3];
        static const int vectors[4] = {0, 3, 8, 11};
        for (int b = 0; b < 4; b++) {
            const int at = vectors[b];
            const double v[3] = {of[at][k], of[at + 1][k], of[at + 2][k]};
            ik_turn(by, v, moved[b]);
        }
        const double *p = moved[0];
        const double *l = moved[1];
        const double *n = moved[2];
        const double pl = of[7][k];
        const double tl = ik_dot(t, l);
        const double one = k == 0 ? 1.0 : 0.0;
        double tn[3], t_l[3];
        ik_cross(t, n, tn);
        ik_cross(t, l, t_l);
        for (int x = 0; x < 3; x++) {
            out[x][k] = p[x] + one * t[x];
            out[3 + x][k] = l[x];
            out[8 + x][k] = n[x] + t_l[x];
            out[11 + x][k] =
                moved[3][x] - 2.0 * tn[x] + tt * l[x] - 2.0 * (pl + tl) * t[x];
        }
        out[6][k] = of[6][k] + 2.0 * ik_dot(t, p) + one * tt;
        out[7][k] = pl + tl;
    }
}

/* The right sides over the monomials of the first two joints, the second's fastest. */
static NOINLINE void ik_right_side(const ik_split *split, ik_eliminated *out, double right[IK_FORMS][9])
{
    static const int left_alone[2][6] = {{2, 5, 6, 7, 10, 13}, {0, 1, 3, 4, 5, 10}};
    const double origin[3] = {0.0, 0.0, 0.0};
    const double root = sqrt(0.75);
    const int slides = split->slides[0];
    double samples[3][IK_FORMS];
    double first[IK_FORMS][3];
    for (int node = 0; node < 3; node++) {
        ik_rigid at = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {0.0, 0.0, 0.0}};
        double p[3], l[3], v[3];
        if (slides) {
            at.t[2] = node - 1.0;
        } else if (node > 0) {
            const double s = node == 1 ? root : -root;
            at.r[0][0] = at.r[1][1] = -0.5;
            at.r[0][1] = -s;
            at.r[1][0] = s;
        }
        ik_point_back(out->links[5], origin, p);
        ik_point_back(&at, p, v);
        ik_point_back(out->links[0], v, p);
        ik_turn_back(&at, out->links[5]->r[2], v);
        ik_turn_back(out->links[0], v, l);
        ik_forms(p, l, samples[node]);
    }
    for (int k = 0; k < IK_FORMS; k++) {
        const double a = samples[0][k];
        const double b = samples[1][k];
        const double c = samples[2][k];
        first[k][0] = slides ? b : (a + b + c) / 3.0;
        first[k][1] = slides ? (c - a) / 2.0 : (2.0 * a - b - c) / 3.0;
        first[k][2] = slides ? (a + c) / 2.0 - b : (b - c) * (2.0 * root / 3.0);
    }
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < 3; i++) {
            out->first[k][i] = first[left_alone[split->slides[1]][k]][i];
        }
    }
    if (split->pose_link == 1) {
        double own[IK_FORMS][9];
        const ik_rigid back = ik_inverse(out->links[1]);
        ik_move_back(split->slides[1], first, own);
        ik_moved(&back, own, right);
    } else {
        ik_move_back(split->slides[1], first, right);
    }
}

/* How the first joint follows from the six forms that the second leaves alone (least squares). If they
   know one combination of its cosine and sine only, the direction that they leave open. */
static void ik_first_joint(int slides, ik_eliminated *e)
{
    double aa = 0.0, ab = 0.0, bb = 0.0;
    for (int k = 0; k < 6; k++) {
        const double *row = e->first[k];
        aa += row[1] * row[1];
        ab += row[1] * row[2];
        bb += row[2] * row[2];
        e->weights[0][k] = e->weights[1][k] = 0.0;
    }
    const double det = aa * bb - ab * ab;
    const double trace = aa + bb;
    e->is_open = 0;
    if (det > 1e-9 * trace * trace) {
        for (int k = 0; k < 6; k++) {
            const double *row = e->first[k];
            e->weights[0][k] = (bb * row[1] - ab * row[2]) / det;
            e->weights[1][k] = (aa * row[2] - ab * row[1]) / det;
        }
        return;
    }
    if (slides) {
        for (int k = 0; k < 6; k++) {
            e->weights[0][k] = aa > 0.0 ? e->first[k][1] / aa : 0.0;
        }
        return;
    }
    const double x = aa > bb ? aa : ab;
    const double y = aa > bb ? ab : bb;
    const double norm = sqrt(x * x + y * y);
    e->is_open = 1;
    e->open[0] = 0.0;
    e->open[1] = 1.0;
    if (norm > 0.0) {
        const double n[2] = {x / norm, y / norm};
        for (int k = 0; k < 6; k++) {
            const double along = (n[0] * e->first[k][1] + n[1] * e->first[k][2]) / trace;
            e->weights[0][k] = n[0] * along;
            e->weights[1][k] = n[1] * along;
        }
        e->open[0] = -n[1];
        e->open[1] = n[0];
    }
}

/* A fixed number between -1 and 1 without pattern. */
static double ik_mixture(int i, int j)
{
    const double x = (i * IK_FORMS + j + 1) * 0.6180339887498949;
    const double y = (x - floor(x)) * 997.0;
    return 2.0 * (y - floor(y)) - 1.0;
}

/* Eliminates what is on the right side: Householder's QR with column pivoting. */
static NOINLINE void ik_orthogonalise(
    const ik_split *split, double right[IK_FORMS][9], ik_eliminated *out)
{
    enum { COLUMNS = 40 };
    double rows[IK_FORMS][COLUMNS];
    int used[8] = {0, 0, 0, 0, 0, 0, 0, 0};
    int rank = 0;
    double largest = 0.0;
    /* Columns 0 to 7: the right side without its constant; then the left side minus that constant. */
    for (int i = 0; i < IK_FORMS; i++) {
        for (int c = 0; c < 8; c++) {
            rows[i][c] = right[i][1 + c];
        }
        for (int c = 0; c < 27; c++) {
            rows[i][8 + c] = split->left[i][c];
        }
        for (int c = 35; c < COLUMNS; c++) {
            rows[i][c] = 0.0;
        }
        rows[i][8] -= right[i][0];
    }
    for (int k = 0; k < 8; k++) {
        double left[8] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        double v[IK_FORMS];
        double sum[COLUMNS];
        int pivot = 8;
        double norm = 0.0;
        for (int i = k; i < IK_FORMS; i++) {
            for (int c = 0; c < 8; c++) {
                left[c] = IK_ADD(rows[i][c], rows[i][c], left[c]);
            }
        }
        for (int c = 0; c < 8; c++) {
            if (!used[c] && left[c] > norm) {
                pivot = c;
                norm = left[c];
            }
        }
        norm = sqrt(norm);
        largest = norm > largest ? norm : largest;
        if (pivot == 8 || norm <= 1e-11 * largest) {
            break;
        }
        used[pivot] = 1;
        rank++;
        /* x - v (v.x) beta with v = column + sign norm e, beta = 1 / (norm |v|) */
        for (int i = k; i < IK_FORMS; i++) {
            v[i] = rows[i][pivot];
        }
        v[k] += v[k] < 0.0 ? -norm : norm;
        const double beta = -1.0 / (norm * fabs(v[k]));
        for (int c = 0; c < COLUMNS; c++) {
            sum[c] = 0.0;
        }
        for (int i = k; i < IK_FORMS; i++) {
            for (int c = 0; c < COLUMNS; c++) {
                sum[c] = IK_ADD(rows[i][c], v[i], sum[c]);
            }
        }
        for (int c = 0; c < COLUMNS; c++) {
            sum[c] *= beta;
        }
        for (int i = k; i < IK_FORMS; i++) {
            for (int c = 0; c < COLUMNS; c++) {
                rows[i][c] = IK_ADD(sum[c], v[i], rows[i][c]);
            }
        }
    }

    /* Where more than six equations remain, six fixed mixtures of them are taken. */
    for (int i = 0; i < 6; i++) {
        double mixed[27];
        double top = 0.0;
        for (int c = 0; c < 27; c++) {
            mixed[c] = rank < 8 ? 0.0 : rows[8 + i][8 + c];
        }
        for (int j = rank; j < IK_FORMS && rank < 8; j++) {
            const double weight = ik_mixture(i, j);
            for (int c = 0; c < 27; c++) {
                mixed[c] = IK_ADD(rows[j][8 + c], weight, mixed[c]);
            }
        }
        for (int c = 0; c < 27; c++) {
            top = fabs(mixed[c]) > top ? fabs(mixed[c]) : top;
        }
        const double scale = top > 0.0 ? 1.0 / top : 0.0;
        out->sizes[i] = top;
        for (int c = 0; c < 27; c++) {
            out->rows[i][c] = mixed[c] * scale;
        }
    }
}

/* Eliminates the first two joints. */
static NOINLINE void ik_eliminate(const ik_split *split, const ik_rigid *goal, ik_eliminated *out)
{
    double right[IK_FORMS][9];
    const ik_rigid back = ik_inverse(goal);
    ik_rigid closing = ik_then(&ik_links[5], &back);
    closing = ik_then(&closing, &ik_base);
    out->closing = split->sign > 0.0 ? closing : ik_inverse(&closing);
    for (int i = 0; i < 6; i++) {
        out->links[i] = i == split->pose_link ? &out->closing : &split->links[i];
    }
    ik_right_side(split, out, right);
    ik_first_joint(split->slides[0], out);
    ik_orthogonalise(split, right, out);
}
