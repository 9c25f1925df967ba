from math import atan2, cos, sin, sqrt
import numpy as np


class SphericalArm:
    """Turret, tilt, telescope.

    Standard DH:
        i | theta | d      | a | alpha
        1 | q1    | self.h | 0 | -90
        2 | q2    | self.b | 0 | 90
        3 | 0     | q3     | 0 | 0
    """

    def __init__(self, h=0.4, b=0.1):
        self.h = h
        self.b = b

    def links(self, q1, q2, q3):
        c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
        A1 = np.array([[c1, 0, -s1, 0], [s1, 0, c1, 0], [0, -1, 0, self.h], [0, 0, 0, 1]])
        A2 = np.array([[c2, 0, s2, 0], [s2, 0, -c2, 0], [0, 1, 0, self.b], [0, 0, 0, 1]])
        A3 = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, q3], [0, 0, 0, 1]])
        return A1, A2, A3

    def position(self, q1, q2, q3):
        c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
        px = q3*c1*s2 - self.b*s1
        py = q3*s1*s2 + self.b*c1
        pz = self.h + q3*c2
        return px, py, pz

    def rotation(self, q1, q2):
        c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
        R = np.array([[c1*c2, -s1, c1*s2],
                      [s1*c2, c1, s1*s2],
                      [s2, 0, c2]])
        return R

    def jacobian(self, q1, q2, q3):
        c1, s1, c2, s2 = cos(q1), sin(q1), cos(q2), sin(q2)
        J = np.array([[-q3*s1*s2 - self.b*c1, q3*c1*c2, c1*s2],
                      [q3*c1*s2 - self.b*s1, q3*s1*c2, s1*s2],
                      [0, -q3*s2, c2]])
        return J

    def solve(self, px, py, pz):
        """joints for a point of the tip; 0 < q2 < pi/2, q3 > 0"""
        k = pz - self.h
        rr = px**2 + py**2
        m = sqrt(rr - self.b**2)
        q1 = atan2(py, px) - atan2(self.b, m)
        q2 = atan2(m, k)
        q3 = sqrt(rr + pz**2 - self.b**2)
        return q1, q2, q3
