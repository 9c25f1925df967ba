# Trolley crane with a double pendulum arm (PRR), everything in the x0-z0 plane:
# z0 runs along the rail, x0 points DOWN, q2 = q3 = 0 is the arm hanging straight.
#
# DH (standard):
#   joint   theta   d    a    alpha
#   1       0       q1   0    pi/2
#   2       q2      0    l1   0
#   3       q3      0    l2   0
#
# m0 trolley, m1, m2 links, centres of mass on the links at r1 resp. r2 from joints 2 resp. 3,
# I1, I2 inertias about the centres of mass (axis normal to the plane of motion)
from sympy import *

q1, q2, q3 = symbols('q1 q2 q3')
dq1, dq2, dq3 = symbols('dq1 dq2 dq3')
ddq1, ddq2, ddq3 = symbols('ddq1 ddq2 ddq3')
m0, m1, m2, l1, l2, r1, r2, I1, I2, g = symbols('m0 m1 m2 l1 l2 r1 r2 I1 I2 g', positive=True)

A1 = Matrix([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, q1], [0, 0, 0, 1]])
A2 = Matrix([[cos(q2), -sin(q2), 0, l1*cos(q2)], [sin(q2), cos(q2), 0, l1*sin(q2)], [0, 0, 1, 0], [0, 0, 0, 1]])
A3 = Matrix([[cos(q3), -sin(q3), 0, l2*cos(q3)], [sin(q3), cos(q3), 0, l2*sin(q3)], [0, 0, 1, 0], [0, 0, 0, 1]])
T03 = A1*A2*A3

# tip: x (down) and z (along the rail)
x = l1*cos(q2) + l2*cos(q2 + q3)
z = q1 + l1*sin(q2) + l2*sin(q2 + q3)
J = Matrix([[0, -l1*sin(q2) - l2*sin(q2 + q3), -l2*sin(q2 + q3)],
            [1,  l1*cos(q2) + l2*cos(q2 + q3),  l2*cos(q2 + q3)]])

# --- inertia matrix -------------------------------------------------------
M = zeros(3, 3)
M[0, 0] = m0 + m1 + m2
M[0, 1] = (m1*r1 + m2*l1)*cos(q2) + m2*r2*cos(q2 + q3)
M[0, 2] = m2*r2*cos(q2 + q3)
M[1, 1] = I1 + I2 + m1*r1**2 + m2*(l1**2 + 2*l1*r2*cos(q3))
M[1, 2] = I2 + m2*(r2**2 + l1*r2*cos(q3))
M[2, 2] = I2 + m2*r2**2
M[1, 0], M[2, 0], M[2, 1] = M[0, 1], M[0, 2], M[1, 2]

# --- gravity: x0 points down, so the potential energy has a minus ----------
U = -g*(m1*r1*cos(q2) + m2*(l1*cos(q2) + r2*cos(q2 + q3)))
g1 = 0
g2 = g*((m1*r1 + m2*l1)*sin(q2) + m2*r2*sin(q2 + q3))
g3 = g*m2*r2*cos(q2 + q3)

# --- Christoffel symbols c_ijk, contribution of dq_i*dq_j to joint k -------
c221 = -(m1*r1 + m2*l1)*sin(q2) - m2*r2*sin(q2 + q3)
c231 = -m2*r2*sin(q2 + q3)
c232 = -m2*l1*r2*sin(q3)
c223 = -m2*l1*r2*sin(q3)

# third equation of motion
tau3 = m2*r2*cos(q2 + q3)*ddq1 + (I2 + m2*(r2**2 + l1*r2*cos(q3)))*ddq2 + (I2 + m2*r2**2)*ddq3 + c223*dq2**2 + g3
