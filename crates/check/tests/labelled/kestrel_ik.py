#!/usr/bin/env python3
"""Kestrel 6 -- cobot of our lab (same build as the well known UR arms, but with other lengths, all positive).

Forward and inverse kinematics, standard DH parameters, metres and radians.
"""
import numpy as np
from numpy import sin, cos, pi

d1, a2, a3, d4, d5, d6 = 0.15, 0.40, 0.35, 0.12, 0.09, 0.08

#  theta   d    a    alpha
DH = np.array([
    [0.0, d1, 0.0,  pi/2],
    [0.0, 0.0, a2,  0.0],
    [0.0, 0.0, a3,  0.0],
    [0.0, d4, 0.0,  pi/2],
    [0.0, d5, 0.0, -pi/2],
    [0.0, d6, 0.0,  0.0],
])


def link(theta, d, a, alpha):
    ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return np.array([[ct, -st*ca,  st*sa, a*ct],
                     [st,  ct*ca, -ct*sa, a*st],
                     [0.0,    sa,     ca,    d],
                     [0.0,   0.0,    0.0,  1.0]])


def fk(q):
    T = np.eye(4)
    for (off, d, a, alpha), qi in zip(DH, q):
        T = T @ link(qi + off, d, a, alpha)
    return T


def fk_closed(q):
    """Position and approach vector without matrices (faster)."""
    q1, q2, q3, q4, q5, q6 = q
    c1, s1 = cos(q1), sin(q1)
    c5, s5 = cos(q5), sin(q5)
    q23 = q2 + q3
    q234 = q2 + q3 + q4
    reach = a2*cos(q2) + a3*cos(q23) + d5*sin(q234) - d6*s5*cos(q234)
    px = c1*reach + s1*(d4 + d6*c5)
    py = s1*reach + c1*(d4 + d6*c5)
    pz = d1 + a2*sin(q2) + a3*sin(q23) - d5*cos(q234) - d6*s5*sin(q234)
    ax = s1*c5 - c1*cos(q234)*s5
    ay = -c1*c5 - s1*cos(q234)*s5
    az = -s5*cos(q234)
    return np.array([px, py, pz]), np.array([ax, ay, az])


def ik(T, arm=+1, wrist=+1, elbow=+1):
    """One solution; arm, wrist, elbow = +1 or -1 choose among the eight."""
    r11, r12, r13, px = T[0]
    r21, r22, r23, py = T[1]
    r31, r32, r33, pz = T[2]

    # wrist point (origin of frame 5)
    wx = px - d6*r13
    wy = py - d6*r23
    wz = pz - d6*r33

    q1 = np.arctan2(wy, wx) + np.arctan2(d4, arm*np.sqrt(wx**2 + wy**2 - d4**2))
    c1, s1 = cos(q1), sin(q1)

    c5 = (s1*px - c1*py + d4)/d6
    q5 = wrist*np.arccos((s1*px - c1*py - d4)/d6)
    s5 = sin(q5)
    q6 = np.arctan2(-(s1*r12 - c1*r22)/s5, (s1*r11 - c1*r21)/s5)
    c6, s6 = cos(q6), sin(q6)

    # the three parallel axes
    c234 = s6*r31 + c6*r32
    s234 = -s6*(c1*r11 + s1*r21) - c6*(c1*r12 + s1*r22)
    u = c1*wx + s1*wy - d5*s234
    v = wz - d1 + d5*c234
    D = (u**2 + v**2 - a2**2 - a3**2)/(2*a2*a3)
    q3 = elbow*np.arccos(D)
    q2 = np.arctan2(v, u) - np.arctan2(a3*sin(q3), a2 + a3*cos(q3))
    q4 = np.arctan2(s234, c234) - q2 + q3
    return np.array([q1, q2, q3, q4, q5, q6])


if __name__ == "__main__":
    q = np.radians([20, -50, 70, -30, 60, 10])
    print(np.round(fk(q), 4))
