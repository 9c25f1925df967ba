/* scara.c -- kinematics of the pick-and-place SCARA
 *
 * DH (standard):
 *   i   theta   d      a    alpha
 *   1   q[0]    H      A1   0
 *   2   q[1]    0      A2   180
 *   3   0       q[2]   0    0
 *   4   q[3]    0      0    0
 */
#include <math.h>

#define A1 0.225
#define A2 0.175
#define H  0.410

void scara_fk(const double q[4], double p[4])
{
    p[0] = A1*cos(q[0]) + A2*cos(q[0] + q[1]);
    p[1] = A1*sin(q[0]) + A2*sin(q[0] + q[1]);
    p[2] = H - q[2];
    p[3] = q[0] + q[1] - q[3];            /* yaw of x4 */
}

void scara_pose(const double q[4], double T[4][4])
{
    T[0][0] = cos(q[0] + q[1] - q[3]);
    T[0][1] = sin(q[0] + q[1] - q[3]);
    T[0][2] = 0.0;
    T[0][3] = A1*cos(q[0]) + A2*cos(q[0] + q[1]);
    T[1][0] = sin(q[0] + q[1] + q[3]);
    T[1][1] = -cos(q[0] + q[1] - q[3]);
    T[1][2] = 0.0;
    T[1][3] = A1*sin(q[0]) + A2*sin(q[0] + q[1]);
    T[2][0] = 0.0;
    T[2][1] = 0.0;
    T[2][2] = -1.0;
    T[2][3] = H - q[2];
}

/* returns 0 if the point is out of reach; lefty = +1 or -1 */
int scara_ik(double x, double y, double z, double yaw, int lefty, double q[4])
{
    double c = (x*x + y*y - A1*A1 - A2*A2)/(2.0*A1*A2);
    if (fabs(c) > 1.0)
        return 0;
    double s = lefty*sqrt(1.0 - c*c);
    q[1] = atan2(s, c);
    q[0] = atan2(y, x) - atan2(A2*s, A1 + A2*c);
    q[2] = z - H;
    q[3] = q[0] + q[1] - yaw;
    return 1;
}
