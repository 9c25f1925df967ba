
/*
 * From a null vector at a value of the hidden joint to all six joints.
 */

/* (c, s) divided by its length; (1, 0) if it has none. */
INLINE void ik_unit(double c, double s, double out[2])
{
    const double square = s * s + c * c;
    const double inverse = square == 0.0 ? 0.0 : 1.0 / sqrt(square);
    out[0] = square == 0.0 ? 1.0 : c * inverse;
    out[1] = s * inverse;
}

/* A direction or a point moved by a joint. */
INLINE void ik_move(int slides, const double value[2], int is_point, double v[3])
{
    if (slides) {
        v[2] += is_point ? value[0] : 0.0;
    } else {
        const double x = value[0] * v[0] - value[1] * v[1];
        v[1] = value[0] * v[1] + value[1] * v[0];
        v[0] = x;
    }
}

/* The two joints of the trio behind the hidden one. */
static void ik_trio(const ik_split *split, const double *x, double ring[6][2])
{
    /* What is added to the angles in the equations, so that none is special. */
    const double offset[2] = {0.7648421872844885, 0.644217687237691};
    const int multiplied = split->last_multiplied ? 4 : 3;
    const int other = split->last_multiplied ? 3 : 4;
    const double weight = split->slides[multiplied] ? 1.0 : 1.0 / sqrt(3.0);
    double y[IK_UNKNOWNS];
    double uu = 0.0, uv = 0.0, vv = 0.0, u, v;
    double w[3];
    for (int k = 0; k < IK_UNKNOWNS; k++) {
        y[k] = x[k] * (k >= 3 && k < 9 ? weight : 1.0);
    }
    for (int k = 0; k < 9; k++) {
        uu += y[k] * y[k];
        uv += y[k] * y[k + 3];
        vv += y[k + 3] * y[k + 3];
    }
    if (split->slides[multiplied]) {
        u = 1.0;
        v = uv / uu;
        ring[multiplied][0] = v;
        ring[multiplied][1] = 0.0;
    } else {
        ik_unit(uu - vv, uv + uv, ring[multiplied]);
        const double c = ring[multiplied][0];
        const double large = sqrt(0.5 + 0.5 * fabs(c));
        const double small = ring[multiplied][1] / (large + large);
        u = c < 0.0 ? small : large;
        v = c < 0.0 ? large : small;
    }
    for (int j = 0; j < 3; j++) {
        w[j] = y[j] * u * u * u + y[3 + j] * u * u * v + y[6 + j] * u * v * v + y[9 + j] * v * v * v;
    }
    if (split->slides[other]) {
        ring[other][0] = w[1] / w[0];
        ring[other][1] = 0.0;
    } else {
        const double side = w[0] < 0.0 ? -1.0 : 1.0;
        ik_unit(side * w[1], side * w[2], ring[other]);
    }
    for (int i = 3; i < 5; i++) {
        if (!split->slides[i]) {
            const double c = ring[i][0];
            const double s = ring[i][1];
            ring[i][0] = c * offset[0] + s * offset[1];
            ring[i][1] = s * offset[0] - c * offset[1];
        }
    }
}

/* All joints; the branch (1, -1) chooses between the first joint's angles where the forms leave it open. */
static NOINLINE void ik_complete(
    const ik_split *split, const ik_eliminated *e, double branch, const double hidden[2],
    const double *unknowns, double out[6][2])
{
    const ik_rigid *const *links = e->links;
    const int *slides = split->slides;
    double ring[6][2];
    double p[3], l[3], x[3], v[3], p2[3], l2[3];
    ring[2][0] = hidden[0];
    ring[2][1] = hidden[1];
    ik_trio(split, unknowns, ring);

    /* The dropped joint's line, and its x direction, in the frame before the second joint's inverse. */
    for (int k = 0; k < 3; k++) {
        p[k] = links[4]->t[k];
        l[k] = links[4]->r[k][2];
        x[k] = links[4]->r[k][0];
    }
    for (int i = 4; i > 1; i--) {
        ik_move(slides[i], ring[i], 1, p);
        ik_move(slides[i], ring[i], 0, l);
        ik_move(slides[i], ring[i], 0, x);
        ik_point(links[i - 1], p, v);
        memcpy(p, v, sizeof v);
        ik_turn(links[i - 1], l, v);
        memcpy(l, v, sizeof v);
        ik_turn(links[i - 1], x, v);
        memcpy(x, v, sizeof v);
    }

    /* The first joint. */
    const double pp = ik_dot(p, p);
    const double pl = ik_dot(p, l);
    const double normal = p[0] * l[1] - p[1] * l[0];
    const double turning[6] = {p[2], l[2], pp, pl, normal, pp * l[2] - 2.0 * pl * p[2]};
    const double sliding[6] = {p[0], p[1], l[0], l[1], l[2], normal};
    const double *seen = slides[1] ? sliding : turning;
    double m[2] = {0.0, 0.0};
    for (int k = 0; k < 6; k++) {
        m[0] += (seen[k] - e->first[k][0]) * e->weights[0][k];
        m[1] += (seen[k] - e->first[k][0]) * e->weights[1][k];
    }
    if (e->is_open) {
        const double left = 1.0 - (m[0] * m[0] + m[1] * m[1]);
        const double root = left > 0.0 ? branch * sqrt(left) : 0.0;
        m[0] += root * e->open[0];
        m[1] += root * e->open[1];
    }
    if (slides[0]) {
        ring[0][0] = m[0];
        ring[0][1] = 0.0;
    } else {
        ik_unit(m[0], m[1], ring[0]);
    }

    /* The same line from the other side, up to the second joint. */
    const double origin[3] = {0.0, 0.0, 0.0};
    const double back[2] = {slides[0] ? -ring[0][0] : ring[0][0], -ring[0][1]};
    ik_point_back(links[5], origin, v);
    ik_move(slides[0], back, 1, v);
    ik_point_back(links[0], v, p2);
    memcpy(v, links[5]->r[2], sizeof v);
    ik_move(slides[0], back, 0, v);
    ik_turn_back(links[0], v, l2);
    if (slides[1]) {
        ring[1][0] = p2[2] - p[2];
        ring[1][1] = 0.0;
    } else {
        ik_unit(
            p[0] * p2[0] + p[1] * p2[1] + l[0] * l2[0] + l[1] * l2[1],
            p[0] * p2[1] - p[1] * p2[0] + l[0] * l2[1] - l[1] * l2[0], ring[1]);
    }

    /* The dropped joint. */
    ik_move(slides[1], ring[1], 0, x);
    ik_turn(links[0], x, v);
    ik_move(slides[0], ring[0], 0, v);
    ik_turn(links[5], v, x);
    ik_unit(x[0], -x[1], ring[5]);
    for (int i = 0; i < 6; i++) {
        out[split->joints[i]][0] = slides[i] ? ring[i][0] * split->sign : ring[i][0];
        out[split->joints[i]][1] = slides[i] ? 0.0 : ring[i][1] * split->sign;
    }
}
