
/*
 * Inverse kinematics by elimination: types, and rigid motions x -> r x + t.
 */

#if FUSED && !defined(@NAME@_MULTIVERSION)
#define IK_ADD(a, b, c) fma(a, b, c)
#else
#define IK_ADD(a, b, c) ((a) * (b) + (c))
#endif

enum {
    /* Numbers side by side: samples and roots, and fewer where each takes much room on the stack. */
    IK_LANES = 8,
#ifdef __AVX512F__
    IK_FEW = 8,
#else
    IK_FEW = 4,
#endif
    /* Functions of a line through which the loop equation is cut. */
    IK_FORMS = 14,
    /* Unknowns of the matrix of the hidden joint. */
    IK_UNKNOWNS = 12,
    /* Columns of a strip; and rows of both, the lower one upside down: what remains of them when three
       columns are eliminated is one matrix of 6 x 6, from row 3 and column 3 on. */
    IK_WIDTH = 9,
    IK_HEIGHT = 12,
    /* Degree of its determinant, samples and roots. */
    IK_DEGREE = 8,
    IK_SAMPLES = 24,
    IK_ROOTS = 16,
    /* The wider matrix: unknowns, equations, and the same of its determinant. */
    IK_MONOMIALS = 16,
    IK_EQUATIONS = 24,
    IK_WIDE_DEGREE = 12,
    IK_WIDE_SAMPLES = 32,
    IK_WIDE_ROOTS = 24,
    /* Roots near the circle with the middles of pairs. */
    IK_NEARBY = 2 * IK_ROOTS,
    /* Solutions that can share a root. */
    IK_SHARED = 6,
    IK_CHARTS = 12,
    /* Arcs of a chart that become charts. */
    IK_ARCS = 8,
    /* How deep charts are taken of parts of charts, with either matrix. */
    IK_DEPTH = 4,
    IK_WIDE_DEPTH = 2
};

#define IK_TURN 6.283185307179586
/* All bits. */
#define IK_ALL (~(uint64_t)0)

typedef struct ik_rigid {
    double r[3][3];
    double t[3];
} ik_rigid;

/* A split of the loop into two: its joints a1 to a6 from 0, what they do (1 if they slide), whether it
   is read forwards (1, -1), its links (the one with the pose is the identity), and the left sides of the
   equations over the monomials of a3, the multiplied joint (a5 or a4) and the other one. */
typedef struct ik_split {
    int joints[6];
    int slides[6];
    double sign;
    ik_rigid links[6];
    int pose_link;
    int last_multiplied;
    double left[IK_FORMS][27];
} ik_split;

/* Six equations that are free of a1 and a2, the largest entry of each 1 and what it was before (or their
   forms in half angles, over (1, c, s) of a3), and what these two are found from. */
typedef struct ik_eliminated {
    double rows[6][27];
    double sizes[6];
    /* Those of the split, and the one with the pose. */
    const ik_rigid *links[6];
    ik_rigid closing;
    double first[6][3];
    double weights[2][6];
    int is_open;
    double open[2];
} ik_eliminated;

/* A part of the circle, magnified: tan((a - centre) / 2) = kappa tan(b / 2). */
typedef struct ik_chart {
    double centre[2];
    double kappa;
    int depth;
} ik_chart;

typedef struct ik_work {
    ik_eliminated eliminated;
    /* The polynomial, its largest sample 1, and its noise. */
    int degree;
    double re[IK_WIDE_DEGREE + 1];
    double im[IK_WIDE_DEGREE + 1];
    double noise;
    /* Its roots, and how far they may be off; less than 0 where a root is known to belong to no
       configuration. */
    int roots;
    double x[IK_WIDE_ROOTS];
    double y[IK_WIDE_ROOTS];
    double radius[IK_WIDE_ROOTS];
    /* The configurations that are found, in the array of the caller: angles or slides of the axes, and
       whether there are more than it has room for. */
    int count;
    int is_over;
    @name@_solve_solution *found;
} ik_work;

INLINE double ik_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

INLINE void ik_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* A direction turned, forwards and back. */
INLINE void ik_turn(const ik_rigid *m, const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m->r[i][0] * v[0] + m->r[i][1] * v[1] + m->r[i][2] * v[2];
    }
}

INLINE void ik_turn_back(const ik_rigid *m, const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m->r[0][i] * v[0] + m->r[1][i] * v[1] + m->r[2][i] * v[2];
    }
}

/* A point moved, forwards and back. */
INLINE void ik_point(const ik_rigid *m, const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m->r[i][0] * p[0] + m->r[i][1] * p[1] + m->r[i][2] * p[2] + m->t[i];
    }
}

INLINE void ik_point_back(const ik_rigid *m, const double p[3], double out[3])
{
    const double v[3] = {p[0] - m->t[0], p[1] - m->t[1], p[2] - m->t[2]};
    ik_turn_back(m, v, out);
}

INLINE ik_rigid ik_then(const ik_rigid *a, const ik_rigid *b)
{
    ik_rigid out;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            out.r[i][k] = a->r[i][0] * b->r[0][k] + a->r[i][1] * b->r[1][k] + a->r[i][2] * b->r[2][k];
        }
    }
    ik_point(a, b->t, out.t);
    return out;
}

INLINE ik_rigid ik_inverse(const ik_rigid *a)
{
    ik_rigid out;
    double t[3];
    ik_turn_back(a, a->t, t);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            out.r[i][k] = a->r[k][i];
        }
        out.t[i] = -t[i];
    }
    return out;
}
