/*
 * leg.c  --  one leg of "Kevin" the hexapod (Teensy 4.0)
 *
 * Denavit-Hartenberg, standard form, angles in rad, lengths in mm:
 *
 *   joint   theta   d   a    alpha
 *   coxa    g       0   CX   pi/2
 *   femur   u       0   FE   0
 *   tibia   v       0   TI   0
 *
 * The knee is built so that v lies between -pi and 0 (it can't bend the other way, I tried, it broke).
 * The foot never goes under the body, i.e. CX + FE*cos(u) + TI*cos(u+v) > 0 and the foot stays outside the coxa.
 */
#include <math.h>
#include "leg.h"

void leg_forward(double g, double u, double v, double *px, double *py, double *pz)
{
    double reach = CX + FE*cos(u) + TI*cos(u + v);   /* from the coxa axis */
    *px = reach*cos(g);
    *py = reach*sin(g);
    *pz = FE*sin(u) - TI*sin(u + v);
}

int leg_inverse(double x, double y, double z, double *g, double *u, double *v)
{
    double w, k, L2;

    *g = atan2(y, x);
    w = sqrt(x*x + y*y);
    L2 = w*w + z*z;                      /* femur joint to foot, squared */
    k = (L2 - FE*FE - TI*TI)/(2*FE*TI);   /* = cos(v) */
    if (fabs(k) > 1.0)
        return -1;                       /* too far */
    *v = -acos(k);
    return 0;
}

/* foot velocity for joint rates gd, ud, vd */
void leg_velocity(double g, double u, double v, double gd, double ud, double vd, double *xd, double *yd, double *zd)
{
    double reach = CX + FE*cos(u) + TI*cos(u + v);
    double lift  = FE*sin(u) + TI*sin(u + v);
    *xd = -reach*sin(g)*gd - lift*cos(g)*ud - TI*sin(u + v)*cos(g)*vd;
    *yd = reach*cos(g)*gd - lift*sin(g)*ud - TI*sin(u + v)*sin(g)*vd;
    *zd = (FE*cos(u) + TI*cos(u + v))*ud + TI*cos(u + v)*vd;
}

/* joint torques that hold a ground force fz (upwards, on the foot): tau = J^T F */
void leg_hold(double u, double v, double fz, double *tg, double *tu, double *tv)
{
    *tg = 0;
    *tu = fz*(FE*cos(u) + TI*cos(u + v));
    *tv = fz*TI*cos(u + v);
}
