import numpy as np


class CylindricalArm:
    """
    Turning column (q1), lift (q2), horizontal boom (q3), hand roll (q4).

    DH table, standard convention:

        joint |  theta  |  d        |  a  |  alpha
        ------+---------+-----------+-----+-------
          1   |  q1     |  d1       |  0  |   0
          2   |  0      |  q2       |  a2 |  -90
          3   |  0      |  q3       |  0  |   0
          4   |  q4     |  d4       |  0  |   0
    """

    def __init__(self, d1=0.5, a2=0.06, d4=0.1):
        self.d1, self.a2, self.d4 = d1, a2, d4

    def A1(self, q1):
        c, s = np.cos(q1), np.sin(q1)
        return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, self.d1], [0, 0, 0, 1]])

    def A2(self, q2):
        return np.array([[1, 0, 0, self.a2],
                         [0, 0, 1, 0],
                         [0, -1, 0, q2],
                         [0, 0, 0, 1]])

    def A3(self, q3):
        return np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, q3], [0, 0, 0, 1]])

    def A4(self, q4):
        c, s = np.cos(q4), np.sin(q4)
        return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, self.d4], [0, 0, 0, 1]])

    def fkine(self, q1, q2, q3, q4):
        return self.A1(q1) @ self.A2(q2) @ self.A3(q3) @ self.A4(q4)

    def position(self, q1, q2, q3):
        b = q3 + self.d4
        x = self.a2 * np.cos(q1) - b * np.sin(q1)
        y = self.a2 * np.sin(q1) + b * np.cos(q1)
        z = self.d1 - q2
        return np.array([x, y, z])

    def jacobian(self, q1, q3):
        """d(x,y,z)/d(q1,q2,q3)"""
        c1, s1 = np.cos(q1), np.sin(q1)
        b = q3 + self.d4
        Jv = np.array([[-self.a2 * s1 - b * c1, 0, -s1],
                       [ self.a2 * c1 + b * s1, 0,  c1],
                       [0,                      1,  0]])
        return Jv

    def ikine(self, x, y, z):
        """joints 1-3 from the position; boom outwards"""
        q2 = z - self.d1
        q3 = np.sqrt(x**2 + y**2 - self.a2**2) - self.d4
        q1 = np.arctan2(y, x) - np.arctan2(q3 + self.d4, self.a2)
        return q1, q2, q3

    def boom_force(self, q1, fx, fy):
        # what the boom drive has to hold, third line of J^T F
        tau3 = -np.sin(q1) * fx + np.cos(q1) * fy
        return tau3
