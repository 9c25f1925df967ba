# lift_arm_dynamics.py
# the "coat hanger": a carriage (slides up, q1) with one horizontal arm (turns, q2)
#
#   standard DH        theta   d    a   alpha
#   carriage           0       q1   0   0
#   arm                q2      0    w   0
#
# m1 carriage, m2 arm; centre of mass of the arm at r from the post, moment of inertia Jz about it (vertical axis)
from math import cos, sin, sqrt, atan2

def tip(q1, q2):
    x = w*cos(q2)
    y = w*sin(q2)
    z = q1
    return x, y, z

def joints(x, y, z):
    q1 = z
    q2 = atan2(y, x)
    return q1, q2

def tip_speed(q1, q2, u1, u2):
    speed = sqrt(u1**2 + w**2*u2**2)
    return speed

def kinetic_energy(q1, q2, u1, u2):
    T = 0.5*(m1 + m2)*u1**2 + 0.5*(Jz + m2*r**2)*u2**2
    return T

def mass_matrix(q1, q2):
    M = [[m1 + m2, 0],
         [0, Jz + m2*r]]
    return M

def gravity(q1, q2):
    G1 = (m1 + m2)*g
    G2 = m2*g*r*cos(q2)
    return G1, G2

def forces(q1, q2, a1, a2):
    """motor force of the lift and motor torque of the arm; a1, a2 are the joint accelerations"""
    tau1 = (m1 + m2)*(a1 + g)
    tau2 = (Jz + m2*r**2)*a2
    return tau1, tau2
