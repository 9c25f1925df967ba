# %% [markdown]
# Polar arm (one rotation, one slide) in a vertical plane: kinematics and equations of motion
#
# Standard DH parameters:
#
#   joint   theta       d     a    alpha
#     1     q1 + pi/2   0     0    pi/2
#     2     0           q2    0    0
#
# base: x to the right, y up, gravity g along -y.  The slide moves along z1.
# link 1: mass m1, centre of mass at the distance r1 from the axis (in the direction of the slide), inertia I1
# link 2: mass m2, centre of mass b behind the tip, inertia I2 (inertias about the own centres of mass)

# %%
import sympy as sp
from sympy import sin, cos, sqrt, atan2, pi, Matrix, symbols

q1, q2, dq1, dq2, ddq1, ddq2 = symbols('q1 q2 dq1 dq2 ddq1 ddq2', real=True)
m1, m2, I1, I2, r1, b, g = symbols('m1 m2 I1 I2 r1 b g', positive=True)
x, y, Fx, Fy = symbols('x y F_x F_y', real=True)

# %% link transforms
A1 = Matrix([[-sin(q1), 0, cos(q1), 0],
             [ cos(q1), 0, sin(q1), 0],
             [0, 1, 0, 0],
             [0, 0, 0, 1]])
A2 = Matrix([[1, 0, 0, 0],
             [0, 1, 0, 0],
             [0, 0, 1, q2],
             [0, 0, 0, 1]])
T02 = A1*A2

# by hand, to compare with T02[:3, 3]
tip = Matrix([q2*cos(q1), q2*sin(q1), 0])

# centres of mass
p_c1 = Matrix([r1*cos(q1), r1*sin(q1), 0])
p_c2 = Matrix([(q2 - b)*cos(q1), (q2 + b)*sin(q1), 0])

# %% Jacobian of the tip (x and y), by hand
J = Matrix([[-q2*sin(q1), cos(q1)],
            [ q2*cos(q1), sin(q1)]])
detJ = q2

# joint torque and force of the slide for a force (Fx, Fy) exerted by the tip: J^T F
tau_static = q2*(Fy*cos(q1) - Fx*sin(q1))
f_static = Fx*cos(q1) + Fy*sin(q1)

# %% inverse kinematics (q2 > 0)
q2_inv = sqrt(x**2 + y**2)
q1_inv = atan2(x, y)

# %% energies and equations of motion, by hand
M11 = I1 + I2 + m1*r1**2 + m2*(q2 - b)**2
M22 = m2
Epot = g*(m1*r1 + m2*(q2 - b))*sin(q1)
G1 = g*(m1*r1 + m2*(q2 - b))*cos(q1)
G2 = m2*g*sin(q1)

tau1 = M11*ddq1 + m2*(q2 - b)*dq1*dq2 + G1
f2 = m2*ddq2 - m2*(q2 - b)*dq1**2 + G2
