// scara_ctrl.cpp  --  excerpt, kinematics part only
// DH (standard), see drawing 0417-B
//   joint   theta    d      a     alpha
//     1     q[0]     D1     A1     0
//     2     q[1]     0      A2     180
//     3     0        q[2]   0      0
//     4     q[3]     D4     0      0
#include <cmath>

static const double D1 = 0.387, A1 = 0.325, A2 = 0.275, D4 = 0.082;

struct Pose { double x, y, z, yaw; };

Pose forward(const double q[4])
{
    Pose p;
    p.x   = A1 * cos(q[0]) + A2 * cos(q[0] + q[1]);
    p.y   = A1 * sin(q[0]) + A2 * sin(q[0] + q[1]);
    p.z   = D1 - q[2] - D4;
    p.yaw = q[0] + q[1] + q[3];
    return p;
}

// lefty = true: elbow on the left, q[1] < 0
bool inverse(const Pose &p, bool lefty, double q[4])
{
    double r2 = p.x * p.x + p.y * p.y;
    double c2 = (r2 - A1 * A1 - A2 * A2) / (2.0 * A1 * A2);
    if (fabs(c2) > 1.0) return false;
    double s2 = (lefty ? -1.0 : 1.0) * sqrt(1.0 - c2 * c2);
    q[1] = atan2(s2, c2);
    q[0] = atan2(p.y, p.x) - atan2(A2 * s2, A1 + A2 * c2);
    q[2] = D1 - D4 - p.z;
    q[3] = q[0] + q[1] - p.yaw;
    return true;
}

void jacobian(const double q[4], double J[2][2])
{
    double s12 = sin(q[0] + q[1]), c12 = cos(q[0] + q[1]);
    J[0][0] = -A1 * sin(q[0]) - A2 * s12;
    J[0][1] = -A2 * s12;
    J[1][0] =  A1 * cos(q[0]) + A2 * c12;
    J[1][1] =  A2 * s12;
}

// torques for a force (fx, fy) at the gripper, motors 1 and 2
void hold(const double q[4], double fx, double fy, double tau[2])
{
    tau[0] = (-A1 * sin(q[0]) - A2 * sin(q[0] + q[1])) * fx
           + ( A1 * cos(q[0]) + A2 * cos(q[0] + q[1])) * fy;
    tau[1] = A2 * (cos(q[0] + q[1]) * fy - sin(q[0] + q[1]) * fx);
}
