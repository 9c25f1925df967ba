# planar 3R for the drawing robot, MODIFIED DH (Craig)
# TODO: tidy this up before Friday
import numpy as np
from math import sin, cos, atan2, sqrt

L1, L2, L3 = 0.45, 0.35, 0.12      # m, L3 = flange to pen tip

#  i   alpha_{i-1}  a_{i-1}   d_i   theta_i
#  1      0           0        0     th1
#  2      0           L1       0     th2
#  3      0           L2       0     th3

def T01(th1):
    c, s = cos(th1), sin(th1)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])

def T12(th2):
    c, s = cos(th2), sin(th2)
    return np.array([[c, -s, 0, L1],
                     [s,  c, 0, 0],
                     [0,  0, 1, 0],
                     [0,  0, 0, 1]])

def T23(th3):
    c, s = cos(th3), sin(th3)
    return np.array([[ c, s, 0, L2],
                     [-s, c, 0, 0],
                     [0,  0, 1, 0],
                     [0,  0, 0, 1]])

def T03(th1, th2, th3):
    T = T01(th1) @ T12(th2) @ T23(th3)
    return T

def pen(th1, th2, th3):
    # position of the pen, from the drawing, not from the matrices
    x = L1*cos(th1) + L2*cos(th1 + th2) + L3*cos(th1 + th2 + th3)
    y = L1*sin(th1) + L2*sin(th1 + th2) + L3*sin(th1 + th2 + th3)
    return x, y

def ik(x, y, phi):
    """phi = th1+th2+th3 = direction of the pen holder"""
    xw = x - L3*cos(phi)
    yw = y - L3*sin(phi)
    c2 = (xw**2 + yw**2 - L1**2 - L2**2) / (2*L1*L2)
    out = []
    for sgn in (1, -1):
        th2 = atan2(sgn*sqrt(1 - c2**2), c2)
        th1 = atan2(yw, xw) - atan2(L2*sin(th2), L1 + L2*cos(th2))
        th3 = phi - th1 + th2
        out.append((th1, th2, th3))
    return out

def jac(th1, th2, th3):
    s1, c1 = sin(th1), cos(th1)
    s12, c12 = sin(th1+th2), cos(th1+th2)
    s123, c123 = sin(th1+th2+th3), cos(th1+th2+th3)
    J = np.array([
        [-L1*s1 - L2*s12 - L3*s123, -L2*s12 - L3*s123, -L3*s123],
        [ L1*c1 + L2*c12 + L3*c123,  L2*c12 + L3*c123,  L2*c123],
        [1, 1, 1]])
    return J

def manip(th2):
    # det of the 3x3 above, worked out by hand
    detJ = L1*L2*sin(th2)
    return abs(detJ)
