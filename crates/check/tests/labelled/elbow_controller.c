#include <math.h>

/*
 * Elbow arm, DH parameters (standard convention)
 *
 *   joint  theta  d     a      alpha
 *   1      t[0]   BASE  OFF    -90
 *   2      t[1]   0     UPPER  0
 *   3      t[2]   0     FORE   0
 *
 * lengths in metres
 */
#define BASE  0.20
#define OFF   0.05
#define UPPER 0.35
#define FORE  0.30

void tip(const double t[3], double xyz[3])
{
    double reach = OFF + UPPER*cos(t[1]) + FORE*cos(t[1] + t[2]);
    xyz[0] = cos(t[0])*(OFF + UPPER*cos(t[1]) + FORE*cos(t[1] + t[2]));
    xyz[1] = sin(t[0])*(OFF + UPPER*cos(t[1]) + FORE*cos(t[1] + t[2]));
    xyz[2] = BASE - UPPER*sin(t[1]) - FORE*sin(t[1] + t[2]);
}

void tip_jacobian(const double t[3], double J[3][3])
{
    double c1 = cos(t[0]), s1 = sin(t[0]);
    double c2 = cos(t[1]), s2 = sin(t[1]);
    double c23 = cos(t[1] + t[2]), s23 = sin(t[1] + t[2]);

    J[0][0] = -s1*(OFF + UPPER*c2 + FORE*c23);
    J[0][1] = -c1*(UPPER*s2 + FORE*s23);
    J[0][2] = -c1*FORE*s23;
    J[1][0] = c1*(UPPER*c2 + FORE*c23);
    J[1][1] = -s1*(UPPER*s2 + FORE*s23);
    J[1][2] = -s1*FORE*s23;
    J[2][0] = 0.0;
    J[2][1] = UPPER*c2 + FORE*c23;
    J[2][2] = -FORE*c23;
}

/* elbow: +1 or -1; the arm faces the point */
void joints(double x, double y, double z, int elbow, double t[3])
{
    double u = sqrt(x*x + y*y) - OFF;
    double v = BASE - z;
    double c3 = (u*u + v*v - UPPER*UPPER - FORE*FORE)/(2.0*UPPER*FORE);
    double s3 = elbow*sqrt(1.0 - c3*c3);
    t[0] = atan2(y, x);
    t[2] = atan2(s3, c3);
    t[1] = atan2(v, u) + atan2(FORE*s3, UPPER + FORE*c3);
}
