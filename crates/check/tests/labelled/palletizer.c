/* palletizer.c -- geometry of the cylindrical palletizer, model B
 *
 * DH table, standard form. Angles in degrees, lengths in metres.
 *
 *   i | a_i | alpha_i | d_i | theta_i
 *   1 | E   | 0       | 0   | th1      slewing ring
 *   2 | 0   | -90     | d2  | 0        mast (sliding)
 *   3 | 0   | 0       | d3  | 0        ram (sliding), d3 >= 0
 *   4 | 0   | 0       | TL  | th4      gripper
 */
#include <math.h>
#include <string.h>

#define E   0.090          /* mast beside the slewing axis */
#define TL  0.210          /* gripper length */
#define DEG (180.0/M_PI)

typedef struct { double th1, d2, d3, th4; } joints_t;      /* radians, metres */
typedef struct { double x, y, z; } vec_t;

/* gripper point in the base frame */
vec_t forward(joints_t q)
{
    vec_t p;
    double ram = q.d3 + TL;
    p.x = E*cos(q.th1) - ram*sin(q.th1);
    p.y = E*sin(q.th1) + ram*cos(q.th1);
    p.z = q.d2;
    return p;
}

/* orientation of the gripper, row by row */
void rotation(joints_t q, double R[3][3])
{
    double c1 = cos(q.th1), s1 = sin(q.th1), c4 = cos(q.th4), s4 = sin(q.th4);
    const double M[3][3] = {
        {c1*c4, -c1*s4, -s1},
        {s1*c4, -s1*s4,  c1},
        {  -s4,     c4,   0}
    };
    memcpy(R, M, sizeof M);
}

/* the way back; returns 0 if the point is too near to the axis */
int inverse(vec_t p, joints_t *q)
{
    double rr = p.x*p.x + p.y*p.y;
    if (rr < E*E + TL*TL) return 0;
    q->d2 = p.z;
    q->d3 = sqrt(rr - E*E) - TL;
    q->th1 = atan2(p.y, p.x) - atan2(q->d3 + TL, E)*DEG;
    return 1;
}

/* velocity of the gripper point; w1 in rad/s, v2 and v3 in m/s */
vec_t velocity(joints_t q, double w1, double v2, double v3)
{
    vec_t v;
    double c1 = cos(q.th1), s1 = sin(q.th1), ram = q.d3 + TL;
    v.x = (-E*s1 - ram*c1)*w1 - s1*v3;
    v.y = (E*c1 - ram*s1)*w1 + c1*v3;
    v.z = v2;
    return v;
}

/* velocities of the joints from the velocity of the gripper point */
void joint_rates(joints_t q, vec_t v, double *w1, double *v2, double *v3)
{
    double c1 = cos(q.th1), s1 = sin(q.th1), ram = q.d3 + TL;
    *w1 = -(c1*v.x + s1*v.y)/ram;
    *v2 = v.z;
    *v3 = -s1*v.x + c1*v.y - E*(*w1);
}

/* Jacobian determinant, rows x y z, columns th1 d2 d3 */
double detj(joints_t q)
{
    return q.d3 + TL;
}
