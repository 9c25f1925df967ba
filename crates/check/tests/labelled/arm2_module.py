"""Two-link arm on the bench (SCARA without a quill).

DH table, standard convention, lengths in metres:

    joint | theta | d | a    | alpha
    1     | q1    | 0 | L1   | 0
    2     | q2    | 0 | L2   | 0
"""
import numpy as np

L1 = 0.32
L2 = 0.27


def forward(q1, q2):
    """pose of the pen in the bench frame"""
    c1, s1 = np.cos(q1), np.sin(q1)
    c12, s12 = np.cos(q1 + q2), np.sin(q1 + q2)
    x = L1*c1 + L2*c12
    y = L1*s1 + L2*s12
    T = np.array([[c12, -s12, 0, L1*c1 + L2*c12],
                  [s12,  c12, 0, L1*s1 + L2*s12],
                  [0, 0, 1, 0],
                  [0, 0, 0, 1]])
    return T


def inverse(x, y, elbow=1):
    """elbow=+1 or -1"""
    c2 = (x**2 + y**2 - L1**2 - L2**2)/(2*L1*L2)
    s2 = elbow*np.sqrt(1 - c2**2)
    q2 = np.arctan2(s2, c2)
    q1 = np.arctan2(y, x) + np.arctan2(L2*s2, L1 + L2*c2)
    return q1, q2


def jacobian(q1, q2):
    c1, s1 = np.cos(q1), np.sin(q1)
    c12, s12 = np.cos(q1 + q2), np.sin(q1 + q2)
    J = np.array([[-L1*s1 - L2*s12, -L2*s12],
                  [L1*c1 + L2*c12, L2*c1]])
    return J


def manipulability(q1, q2):
    # determinant of J
    w = L1*L2*np.sin(q2)
    return w


def torques(q1, q2, fx, fy):
    """joint torques that balance a force (fx, fy) which the pen exerts"""
    s1, c1 = np.sin(q1), np.cos(q1)
    s12, c12 = np.sin(q1 + q2), np.cos(q1 + q2)
    tau1 = -(L1*s1 + L2*s12)*fx + (L1*c1 + L2*c12)*fy
    tau2 = -L2*s12*fx + L2*c12*fy
    return tau1, tau2


def tip_velocity(q1, q2, qd1, qd2):
    s1, c1 = np.sin(q1), np.cos(q1)
    s12, c12 = np.sin(q1 + q2), np.cos(q1 + q2)
    vx = -L1*s1*qd1 - L2*s12*(qd1 + qd2)
    vy = L1*c1*qd1 + L2*c12*(qd1 + qd2)
    return vx, vy
