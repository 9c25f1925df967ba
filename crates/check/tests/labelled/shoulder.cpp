// shoulder.cpp - first three joints of the heavy arm, closed formulas for the controller
//
// standard DH parameters (degrees, metres; the values are in the struct Arm):
//
//   joint | theta | d  | a  | alpha
//   ------+-------+----+----+------
//     1   |  t1   | d1 | 0  |  -90
//     2   |  t2   | d2 | a2 |    0
//     3   |  t3   | 0  | a3 |    0
//
#include <cmath>
#include <array>

struct Arm { double d1, d2, a2, a3; };
struct Vec { double x, y, z; };
using Mat3 = std::array<std::array<double, 3>, 3>;

// position of the wrist flange
Vec forward(const Arm& A, double t1, double t2, double t3) {
    const double d1 = A.d1, d2 = A.d2, a2 = A.a2, a3 = A.a3;
    Vec p;
    double u = a2 * std::cos(t2) + a3 * std::cos(t2 + t3);
    p.x = u * std::cos(t1) - d2 * std::sin(t1);
    p.y = u * std::sin(t1) + d2 * std::cos(t1);
    p.z = d1 + a2 * std::sin(t2) - a3 * std::sin(t2 + t3);
    return p;
}

// linear Jacobian, rows x y z, columns t1 t2 t3
Mat3 jacobian(const Arm& A, double t1, double t2, double t3) {
    const double d2 = A.d2, a2 = A.a2, a3 = A.a3;
    const double c1 = std::cos(t1), s1 = std::sin(t1);
    const double c23 = std::cos(t2 + t3), s23 = std::sin(t2 + t3);
    const double u = a2 * std::cos(t2) + a3 * c23;
    const double w = a2 * std::sin(t2) + a3 * s23;
    Mat3 J;
    J[0][0] = -s1 * u - c1 * d2;
    J[0][1] = -c1 * w;
    J[0][2] = -a3 * c1 * s23;
    J[1][0] = c1 * u + s1 * d2;
    J[1][1] = -s1 * w;
    J[1][2] = -a3 * s1 * c23;
    J[2][0] = 0.0;
    J[2][1] = -u;
    J[2][2] = -a3 * c23;
    return J;
}

// determinant of the (correct) Jacobian without the matrix
double det(const Arm& A, double t2, double t3) {
    const double a2 = A.a2, a3 = A.a3;
    return a2 * a3 * std::sin(t3) * (a2 * std::cos(t2) + a3 * std::cos(t2 + t3));
}

// joints for a point in front of the arm (u > 0); elbow = +1 for t3 > 0, elbow = -1 for t3 < 0
void inverse(const Arm& A, double x, double y, double z, int elbow, double& t1, double& t2, double& t3) {
    const double d1 = A.d1, d2 = A.d2, a2 = A.a2, a3 = A.a3;
    double u = std::sqrt(x * x + y * y - d2 * d2);
    double v = d1 - z;
    double D = (u * u + v * v - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
    t1 = std::atan2(y, x) - std::atan2(u, d2);
    t3 = elbow * std::acos(D);
    t2 = std::atan2(v, u) - std::atan2(a3 * std::sin(t3), a2 + a3 * std::cos(t3));
}
