"""
Unit tests for the pick arm "Heron" (yaw, shoulder, elbow).

    python -m unittest heron_tests.py

DH rows are [a, alpha, d, theta], classic (distal) convention, metres / radians.
"""
import unittest
from math import acos, atan2, cos, pi, sin, sqrt

import numpy as np

L0, H, L1, L2 = 0.15, 0.42, 0.38, 0.31


def rows(q):
    return [[L0, pi/2, H,   q[0]],
            [L1, 0.0,  0.0, q[1]],
            [L2, 0.0,  0.0, q[2]]]


def link(a, alpha, d, theta):
    ct, st = cos(theta), sin(theta)
    ca, sa = cos(alpha), sin(alpha)
    return np.array([[ct, -st*ca,  st*sa, a*ct],
                     [st,  ct*ca, -ct*sa, a*st],
                     [0.0,    sa,     ca,    d],
                     [0.0,   0.0,    0.0,  1.0]])


def fk(q):
    T = np.eye(4)
    for row in rows(q):
        T = T @ link(*row)
    return T


def tip(q):
    """closed form of the position, much faster than fk()"""
    reach = L0 + L1*cos(q[1]) + L2*cos(q[1] + q[2])
    x = reach*cos(q[0])
    y = reach*sin(q[0])
    z = H + L1*sin(q[1]) + L2*sin(q[2])
    return np.array([x, y, z])


def jac(q):
    c1, s1 = cos(q[0]), sin(q[0])
    c23, s23 = cos(q[1] + q[2]), sin(q[1] + q[2])
    reach = L0 + L1*cos(q[1]) + L2*c23
    lift = L1*sin(q[1]) + L2*s23
    return np.array([[-s1*reach, -c1*lift, -c1*L2*s23],
                     [ c1*reach, -s1*lift, -s1*L2*s23],
                     [      0.0,    reach,     L2*c23]])


def solve(x, y, z):
    """joint angles for a point in front of the arm, elbow up"""
    q1 = atan2(y, x)
    rho = sqrt(x*x + y*y) - L0
    dz = z - H
    cosq3 = (rho**2 + dz**2 - L1**2 - L2**2)/(2*L1*L2)
    q3 = -acos(cosq3)
    q2 = atan2(dz, rho) - atan2(L2*sin(q3), L1 + L2*cos(q3))
    return q1, q2, q3


class TestHeron(unittest.TestCase):

    def test_stretched(self):
        np.testing.assert_allclose(tip([0, 0, 0]), [0.84, 0, 0.42], atol=1e-9)

    def test_straight_up(self):
        T = fk([0, pi/2, 0])
        np.testing.assert_allclose(T[:3, 3], [0.15, 0, 1.11], atol=1e-9)

    def test_elbow_bent(self):
        # upper arm horizontal, forearm vertical
        T = fk([pi/2, 0, pi/2])
        expected = np.array([[0, 0, 1, 0],
                             [0, -1, 0, 0.53],
                             [1, 0, 0, 0.73],
                             [0, 0, 0, 1]])
        np.testing.assert_allclose(T, expected, atol=1e-9)

    def test_regression(self):
        # value recorded on 2021-03-02 from tip()
        np.testing.assert_allclose(tip([0, pi/6, pi/3]), [0.4791, 0, 0.8785], atol=1e-4)

    def test_jacobian_home(self):
        Jv = jac([0, 0, 0])
        self.assertAlmostEqual(Jv[1, 0], 0.84)
        self.assertAlmostEqual(Jv[2, 2], 0.31)

    def test_round_trip(self):
        q = solve(0.5, 0.2, 0.6)
        np.testing.assert_allclose(fk(q)[:3, 3], [0.5, 0.2, 0.6], atol=1e-9)


if __name__ == "__main__":
    unittest.main()
