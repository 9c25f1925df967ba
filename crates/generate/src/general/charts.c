
/*
 * Magnified arcs of the circle, and whether the roots are all accounted for.
 */

enum { IK_CERTIFIED, IK_PAIRS, IK_UNCERTAIN };

static const ik_chart ik_whole = {{1.0, 0.0}, 1.0, 0};

/* 2 atan(kappa tan(a / 2)) by cosine and sine. */
static void ik_stretched(double kappa, double c, double s, double out[2])
{
    const double near = 1.0 + c;
    const double far = kappa * kappa * (1.0 - c);
    const double sum = near + far;
    out[0] = sum > 0.0 ? (near - far) / sum : -1.0;
    out[1] = sum > 0.0 ? 2.0 * kappa * s / sum : 0.0;
}

/* From a chart to the circle. */
static void ik_outside(const ik_chart *chart, double c, double s, double out[2])
{
    double own[2];
    ik_stretched(chart->kappa, c, s, own);
    out[0] = own[0] * chart->centre[0] - own[1] * chart->centre[1];
    out[1] = own[1] * chart->centre[0] + own[0] * chart->centre[1];
}

/* From the circle to a chart. */
static void ik_inside(const ik_chart *chart, double c, double s, double out[2])
{
    const double *o = chart->centre;
    ik_stretched(1.0 / chart->kappa, c * o[0] + s * o[1], s * o[0] - c * o[1], out);
}

/* Cosines and sines on the circle at eight nodes of a chart, and the weights
   cos(b / 2)^2 + kappa^2 sin(b / 2)^2. */
INLINE void ik_nodes(
    const ik_chart *chart, const double *RESTRICT cosines, const double *RESTRICT sines,
    double *RESTRICT c, double *RESTRICT s, double *RESTRICT weight)
{
    for (int l = 0; l < IK_LANES; l++) {
        const double near = 1.0 + cosines[l];
        const double far = (1.0 - cosines[l]) * chart->kappa * chart->kappa;
        const double sum = near + far;
        const double a = (near - far) / sum;
        const double b = sines[l] * 2.0 * chart->kappa / sum;
        c[l] = a * chart->centre[0] - b * chart->centre[1];
        s[l] = a * chart->centre[1] + b * chart->centre[0];
        weight[l] = 0.5 * sum;
    }
}

INLINE int ik_answers_for(const ik_chart *chart, double cosine)
{
    return chart->depth == 0 || cosine >= 0.0;
}

/* x modulo a turn, from 0 on. */
static double ik_modulo(double x)
{
    return x - IK_TURN * floor(x / IK_TURN);
}

/* An arc of a chart as a chart of its own. */
static ik_chart ik_part(const ik_chart *chart, double centre, double half_width)
{
    double ends[2];
    ik_chart out;
    for (int k = 0; k < 2; k++) {
        const double at = k == 0 ? centre - half_width : centre + half_width;
        double pair[2];
        ik_outside(chart, cos(at), sin(at), pair);
        ends[k] = atan2(pair[1], pair[0]);
    }
    const double half = ik_modulo(ends[1] - ends[0]) / 2.0;
    const double width = half < 2.8 ? half : 2.8;
    out.centre[0] = cos(ends[0] + half);
    out.centre[1] = sin(ends[0] + half);
    out.kappa = tan(width / 2.0);
    out.depth = chart->depth + 1;
    return out;
}

/* The first step from an angle to one side at which the polynomial is clear of its noise. */
static double ik_clear(const ik_work *work, double from, double side, double noise)
{
    double at = from;
    double step = side * 5e-4;
    for (int k = 0; k < 24; k++) {
        double re = 0.0, im = 0.0;
        at += step;
        step *= 1.3;
        const double c = cos(at);
        const double s = sin(at);
        for (int d = work->degree; d > 0; d--) {
            const double a = re + work->re[d];
            const double b = im + work->im[d];
            re = a * c - b * s;
            im = a * s + b * c;
        }
        if (fabs(2.0 * re + work->re[0]) > noise) {
            return at;
        }
    }
    return at;
}

/* Angles in a chart, and which of them do not fit. */
typedef struct ik_marks {
    int count;
    double angles[48];
    int marked[48];
} ik_marks;

/* Adds an angle in its place. */
static void ik_mark(ik_marks *marks, double angle, int marked)
{
    int at = marks->count;
    if (at == 48) {
        return;
    }
    while (at > 0 && marks->angles[at - 1] > angle) {
        marks->angles[at] = marks->angles[at - 1];
        marks->marked[at] = marks->marked[at - 1];
        at--;
    }
    marks->angles[at] = angle;
    marks->marked[at] = marked;
    marks->count++;
}

/* The arcs in which there may be roots that are not where they seem to be; their number. */
static int ik_crowds(const ik_work *work, const ik_marks *marks, double arcs[IK_ARCS][2])
{
    const double noise = 2.0 * ik_noise(work);
    int count = 0;
    for (int k = 0; k < marks->count; k++) {
        const double angle = marks->angles[k];
        int is_known = !marks->marked[k];
        for (int j = 0; j < count; j++) {
            const double away = ik_modulo(angle - arcs[j][0]);
            is_known |= away < arcs[j][1] || IK_TURN - away < arcs[j][1];
        }
        if (is_known) {
            continue;
        }
        if (count == IK_ARCS) {
            return 0;
        }
        const double low = ik_clear(work, angle, -1.0, noise);
        const double high = ik_clear(work, angle, 1.0, noise);
        arcs[count][0] = (low + high) / 2.0;
        arcs[count][1] = (high - low) / 2.0;
        count++;
    }
    return count;
}

/* The discs hold the roots of all polynomials that differ by the noise: each one that reaches the
   circle must belong to a configuration of its own. Where something does not fit, the arcs where it
   does not. */
static NOINLINE int ik_verdict(
    const ik_split *split, const ik_chart *chart, const ik_work *work, double arcs[IK_ARCS][2], int *crowds)
{
    ik_marks marks;
    int open[IK_WIDE_ROOTS], all[IK_WIDE_ROOTS];
    int reaching = 0, strangers = 0, inside = 0, pairs;
    marks.count = 0;
    *crowds = 0;
    for (int k = 0; k < work->roots; k++) {
        const double modulus = sqrt(work->x[k] * work->x[k] + work->y[k] * work->y[k]);
        const int off = fabs(modulus - 1.0) > work->radius[k];
        open[k] = !off && ik_answers_for(chart, work->x[k] / modulus);
        all[k] = open[k];
        reaching += open[k];
    }
    for (int i = 0; i < work->count; i++) {
        const double angle = work->found[i].q[split->joints[2]];
        double at[2];
        int nearest = -1;
        double least = HUGE_VAL;
        ik_inside(chart, cos(angle), sin(angle) * split->sign, at);
        if (!ik_answers_for(chart, at[0])) {
            continue;
        }
        inside++;
        for (int k = 0; k < work->roots; k++) {
            const double r = work->radius[k];
            const double dx = work->x[k] - at[0];
            const double dy = work->y[k] - at[1];
            const double away = sqrt(dx * dx + dy * dy);
            const double reach = 3.0 * r < 1e-7 ? 1e-7 : 3.0 * r;
            if (open[k] && away < least && (away <= reach || r != r)) {
                nearest = k;
                least = away;
            }
        }
        if (nearest >= 0) {
            open[nearest] = 0;
            reaching--;
        } else {
            strangers++;
            ik_mark(&marks, atan2(at[1], at[0]), 1);
        }
    }
    if (strangers == 0 && reaching == 0) {
        return IK_CERTIFIED;
    }
    pairs = strangers == 0 && (inside + reaching) % 2 == 0;
    for (int k = 0; k < work->roots; k++) {
        const double r = work->radius[k];
        int has_other = 0;
        if (!all[k]) {
            continue;
        }
        ik_mark(&marks, atan2(work->y[k], work->x[k]), open[k] || !(r < 1e-2));
        if (!open[k]) {
            continue;
        }
        for (int j = 0; j < work->roots; j++) {
            const double dx = work->x[k] - work->x[j];
            const double dy = work->y[k] - work->y[j];
            has_other |= j != k && all[j] && sqrt(dx * dx + dy * dy) <= r + work->radius[j];
        }
        pairs = pairs && r < 0.02 && has_other;
    }
    *crowds = ik_crowds(work, &marks, arcs);
    return pairs ? IK_PAIRS : IK_UNCERTAIN;
}
