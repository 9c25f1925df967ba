// anthro3.cpp - kinematics of the shoulder/elbow part of our service arm
//
// Denavit-Hartenberg (standard form):
//   i |  theta  |   d    |  a   | alpha
//   1 |  q1     |  kL1   |  0   |  +90 deg
//   2 |  q2     | -kOff  |  kL2 |   0
//   3 |  q3     |   0    |  kL3 |   0
//
#include <Eigen/Dense>
#include <cmath>
using Eigen::Matrix3d; using Eigen::Matrix4d; using Eigen::Vector3d;

constexpr double kL1 = 0.33, kOff = 0.06, kL2 = 0.41, kL3 = 0.38;   // m
constexpr double g = 9.81;

Vector3d tip(double q1, double q2, double q3)
{
    const double c1 = std::cos(q1), s1 = std::sin(q1);
    const double c2 = std::cos(q2), s2 = std::sin(q2);
    const double c23 = std::cos(q2 + q3), s23 = std::sin(q2 + q3);
    const double u = kL2 * c2 + kL3 * c23;          // reach in the plane of the arm
    const double px = u * c1 - kOff * s1;
    const double py = u * s1 + kOff * c1;
    const double pz = kL1 + kL2 * s2 + kL3 * s23;
    return {px, py, pz};
}

Matrix3d orientation(double q1, double q2, double q3)
{
    const double c1 = std::cos(q1), s1 = std::sin(q1);
    const double c23 = std::cos(q2 + q3), s23 = std::sin(q2 + q3);
    Matrix3d R;
    R << c1 * c23, -c1 * s23,  s1,
         s1 * c23, -s1 * s23, -c1,
         s23,       c23,       0;
    return R;
}

Matrix3d jacobian(double q1, double q2, double q3)
{
    const double c1 = std::cos(q1), s1 = std::sin(q1);
    const double c2 = std::cos(q2), s2 = std::sin(q2);
    const double c23 = std::cos(q2 + q3), s23 = std::sin(q2 + q3);
    const double u = kL2 * c2 + kL3 * c23;
    const double h = kL2 * s2 + kL3 * s23;
    Matrix3d J;
    J << -u * s1 - kOff * c1, -c1 * h, -kL3 * c1 * s23,
          u * c1 - kOff * s1, -s1 * h, -kL3 * s1 * s23,
          0,                   u,       kL3 * c23;
    return J;
}

// closed form, vanishes with the arm stretched or with the tip above the shoulder
double detJ(double q1, double q2, double q3)
{
    const double u = kL2 * std::cos(q2) + kL3 * std::cos(q2 + q3);
    return -kL2 * kL3 * u * std::sin(q3);
}

// elbow = +1: q3 > 0,  elbow = -1: q3 < 0.   Tip in front of the shoulder (u > 0).
bool inverse(const Vector3d& p, int elbow, Vector3d& q)
{
    const double px = p.x(), py = p.y(), pz = p.z();
    const double rho2 = px * px + py * py - kOff * kOff;
    if (rho2 < 0) return false;
    const double r = std::sqrt(px * px + py * py - kOff * kOff);
    const double h = pz - kL1;
    const double D = (r * r + h * h - kL2 * kL2 - kL3 * kL3) / (2 * kL2 * kL3);
    if (std::fabs(D) > 1) return false;
    const double q1 = std::atan2(py, px) - std::atan2(kOff, r);
    const double q3 = std::atan2(elbow * std::sqrt(1 - D * D), D);
    const double q2 = std::atan2(h, r) - std::atan2(kL3 * std::sin(q3), kL2 + kL3 * std::cos(q3));
    q << q1, q2, q3;
    return true;
}

// holding torques: m2 in the middle of the upper arm, m3 (payload) at the tip, z0 points up
Vector3d gravity(double q2, double q3, double m2, double m3)
{
    const double g3 = m3 * g * kL3 * std::cos(q2 + q3);
    const double g2 = (0.5 * m2 + m3) * g * kL2 * std::cos(q2) + m3 * g * kL3 * std::cos(q2 + q3);
    return {0.0, g2, g3};
}
