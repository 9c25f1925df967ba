/* leg3.c -- one leg of the hexapod, coxa / femur / tibia
 *
 * DH, standard convention (a: along x_i, alpha: about x_i)
 *
 *   i   a_i   alpha_i   d_i   theta_i
 *   1   LC    PI/2      0     t1
 *   2   LF    0         0     t2
 *   3   LT    0         0     t3
 *
 * z0 points up, the foot hangs below: the knee is always bent with t3 < 0.
 */
#include <math.h>

#define LC 0.052
#define LF 0.066
#define LT 0.133

typedef struct { double x, y, z; } vec3;

void leg_fk(double t1, double t2, double t3, vec3 *foot)
{
    double r = LC + LF * cos(t2) + LT * cos(t2 + t3);
    foot->x = r * cos(t1);
    foot->y = r * sin(t1);
    foot->z = LF * sin(t2) + LT * sin(t2 + t3);
}

int leg_ik(double x, double y, double z, double *q)
{
    double t1, t2, t3, w, s, ca, ck, alpha, gamma;

    t1 = atan2(y, x);
    w = sqrt(x * x + y * y) - LC;              /* horizontal, from the femur axis */
    s = sqrt(w * w + z * z);                   /* femur axis to foot */
    if (s > LF + LT || s < LT - LF)
        return -1;

    /* triangle femur - tibia - s: alpha at the femur axis, gamma at the knee */
    ca = (LF * LF + s * s - LT * LT) / (2 * LT * s);
    ck = (LF * LF + LT * LT - s * s) / (2 * LF * LT);
    alpha = acos(ca);
    gamma = acos(ck);

    t2 = atan2(z, w) + alpha;
    t3 = gamma - M_PI;
    q[0] = t1; q[1] = t2; q[2] = t3;
    return 0;
}

/* foot velocity from the joint rates d1, d2, d3 */
void leg_vel(double t1, double t2, double t3, double d1, double d2, double d3, vec3 *v)
{
    double c1 = cos(t1), s1 = sin(t1);
    double u = LF * cos(t2) + LT * cos(t2 + t3);
    double h = LF * sin(t2) + LT * sin(t2 + t3);

    v->x = -s1 * (LC + u) * d1 - c1 * h * d2 - c1 * LT * sin(t2 + t3) * d3;
    v->y = c1 * (LC + u) * d1 + s1 * h * d2 - s1 * LT * sin(t2 + t3) * d3;
    v->z = u * d2 + LT * cos(t2 + t3) * d3;
}

/* knee torque that balances the ground force (fx, fy, fz) acting ON THE FOOT is -knee_torque() */
double knee_torque(double t1, double t2, double t3, double fx, double fy, double fz)
{
    double s23 = sin(t2 + t3), c23 = cos(t2 + t3);
    return LT * (c23 * fz - s23 * (cos(t1) * fx + sin(t1) * fy));
}
