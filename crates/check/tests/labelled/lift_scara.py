import numpy as np


class LiftScara:
    """Column lift, two horizontal links, and a tool axis that looks down.

    Denavit-Hartenberg (standard):

        i   a_i   alpha_i   d_i   theta_i
        1   0     0         s     0          lift, prismatic
        2   l1    0         0     th1
        3   l2    pi        0     th2
        4   0     0         t     th3
    """

    def __init__(self, l1=0.325, l2=0.275, t=0.12):
        self.l1, self.l2, self.t = l1, l2, t

    def pose(self, s, th1, th2, th3):
        """tool point and heading (angle of the tool's x axis about the vertical)"""
        l1, l2, t = self.l1, self.l2, self.t
        x = l1*np.cos(th1) + l2*np.cos(th1 + th2)
        y = l1*np.sin(th1) + l2*np.sin(th1 + th2)
        z = s - t
        phi = th1 + th2 - th3
        return x, y, z, phi

    def rotation(self, th1, th2, th3):
        # phi as in pose()
        phi = th1 + th2 - th3
        R = np.array([[np.cos(phi),  np.sin(phi),  0],
                      [np.sin(phi), -np.cos(phi),  0],
                      [0,            0,           -1]])
        return R

    def inverse(self, x, y, z, phi, elbow=+1):
        """elbow = +1 (left hand side) or -1 (right hand side)"""
        l1, l2, t = self.l1, self.l2, self.t
        s = z + t
        # law of cosines in the triangle shoulder - elbow - tool
        cos2 = (x**2 + y**2 - l1**2 - l2**2) / (2*l1*l2)
        if abs(cos2) > 1:
            raise ValueError("out of reach")
        sin2 = elbow*np.sqrt(1 - cos2**2)
        th2 = np.arctan2(sin2, cos2)
        th1 = np.arctan2(y, x) - np.arctan2(l2*sin2, l1 + l2*cos2)
        # rest goes to the wrist
        th3 = phi - th1 - th2
        return s, th1, th2, th3

    def rates(self, th1, th2, vx, vy, vz, wz):
        """joint rates for a tool velocity (vx, vy, vz) and turning rate wz"""
        l1, l2 = self.l1, self.l2
        c1, s1 = np.cos(th1), np.sin(th1)
        c12, s12 = np.cos(th1 + th2), np.sin(th1 + th2)
        det = l1*l2*np.sin(th2)
        if abs(det) < 1e-6:
            raise ValueError("singular: arm stretched or folded")
        ds = vz
        dth1 = (c12*vx + s12*vy) / (l1*np.sin(th2))
        dth2 = -((l1*c1 + l2*c12)*vx + (l1*s1 + l2*s12)*vy) / (l1*np.sin(th2))
        dth3 = dth1 + dth2 - wz
        return ds, dth1, dth2, dth3
