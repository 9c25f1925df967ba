"""
pal4 - kinematics of our 4-axis palletising robot (linkage keeps the wrist plate level)

DH parameters, classic (distal) convention, metres / radians

      theta        d     a     alpha
  1   q1           d1    a1    -pi/2
  2   q2           0     a2     0
  3   q3           0     a3     0
  4   -q2-q3       0     a4    -pi/2      <- passive, parallelogram
  5   q4           d5    0      0         (4th motor)

Motors: q = [q1, q2, q3, q4]
"""
import numpy as np
from math import atan2, sqrt, pi

d1, a1, a2, a3, a4, d5 = 0.85, 0.35, 1.25, 1.35, 0.25, 0.30


def dh(theta, d, a, alpha):
    ct, st = np.cos(theta), np.sin(theta)
    ca, sa = np.cos(alpha), np.sin(alpha)
    return np.array([
        [ct, -st * ca,  st * sa, a * ct],
        [st,  ct * ca, -ct * sa, a * st],
        [0.0, sa, ca, d],
        [0.0, 0.0, 0.0, 1.0]])


def fkine(q):
    q1, q2, q3, q4 = q
    rows = [(q1, d1, a1, -pi / 2),
            (q2, 0, a2, 0),
            (q3, 0, a3, 0),
            (-q2 - q3, 0, a4, -pi / 2),
            (q4, d5, 0, 0)]
    T = np.eye(4)
    for row in rows:
        T = T @ dh(*row)
    return T


def tool_position(q):
    """closed form, roughly 20x faster than fkine()"""
    q1, q2, q3, _ = q
    reach = a1 + a2 * np.cos(q2) + a3 * np.cos(q2 + q3) + a4
    x = reach * np.cos(q1)
    y = reach * np.sin(q1)
    z = d1 - a2 * np.sin(q2) - a3 * np.sin(q2 + q3) - d5
    return x, y, z


def ikine(x, y, z, yaw):
    """elbow solution with q3 > 0, tool in front of the column"""
    q1 = atan2(y, x)
    rho = sqrt(x**2 + y**2) - a1 - a4
    # height of the wrist above the shoulder
    h = z + d5 - d1
    D = (rho**2 + h**2 - a2**2 - a3**2) / (2 * a2 * a3)
    q3 = atan2(sqrt(1 - D**2), D)
    q2 = atan2(h, rho) - atan2(a3 * np.sin(q3), a2 + a3 * np.cos(q3))
    q4 = q1 - yaw          # tool points down, so the flange counts backwards
    return np.array([q1, q2, q3, q4])


def jacobian(q):
    """d(x, y, z, yaw)/dq"""
    q1, q2, q3, q4 = q
    c1, s1 = np.cos(q1), np.sin(q1)
    c2, s2 = np.cos(q2), np.sin(q2)
    c23, s23 = np.cos(q2 + q3), np.sin(q2 + q3)
    reach = a1 + a2 * c2 + a3 * c23 + a4
    return np.array([
        [-s1 * reach, -c1 * (a2 * s2 + a3 * s23), -c1 * a3 * s23, 0],
        [ c1 * reach, -s1 * (a2 * s2 + a3 * s23), -s1 * a3 * s23, 0],
        [0, -a2 * c2 - a3 * c23, -a3 * s23, 0],
        [1, 0, 0, -1]])


def test_home():
    """upper arm vertical, forearm horizontal"""
    x, y, z = tool_position([0.0, -pi / 2, pi / 2, 0.0])
    assert abs(x - 1.95) < 1e-9
    assert abs(y) < 1e-9
    assert abs(z - 1.80) < 1e-9
