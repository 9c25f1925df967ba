# Telescopic crane: slew (q1), luff (q2), telescope (q3).  Equations of motion, by hand.
#
# standard DH
#   link | theta    | d  | a | alpha
#   -----+----------+----+---+------
#   1    | q1       | h  | 0 | 90°
#   2    | q2 + 90° | 0  | 0 | 90°
#   3    | 0        | q3 | 0 | 0°
#
# masses: mb  boom, lumped in a point on the boom axis, distance b from the luffing pin (fixed to link 2)
#         mt  head with hook block, a point mass in the origin of frame 3
#         J0  inertia of the slewing column about its own (vertical) axis
# gravity g acts against z0.

import sympy as sp

q1, q2, q3 = sp.symbols('q1 q2 q3')
dq1, dq2, dq3 = sp.symbols('dq1 dq2 dq3')
ddq1, ddq2, ddq3 = sp.symbols('ddq1 ddq2 ddq3')
h, b, mb, mt, J0, g = sp.symbols('h b mb mt J0 g', positive=True)

s1, c1 = sp.sin(q1), sp.cos(q1)
s2, c2 = sp.sin(q2), sp.cos(q2)

# where things are
p_head = sp.Matrix([q3*c1*c2, q3*s1*c2, h + q3*s2])
p_boom = sp.Matrix([b*c1*c2, b*s1*c2, h + b*s2])

# head velocity = Jv * dq
Jv = sp.Matrix([[-q3*s1*c2, -q3*c1*s2, c1*c2],
                [ q3*c1*c2, -q3*s1*s2, s1*c2],
                [        0,     q3*c2,    s2]])
# and the turning rate of the boom
Jw = sp.Matrix([[0,  s1, 0],
                [0, -c1, 0],
                [1,   0, 0]])

# energies
Ekin = J0*dq1**2/2 + mb*b**2*(dq2**2 + c2**2*dq1**2)/2 + mt*(dq3**2 + q3**2*dq2**2 + q3**2*c2**2*dq1**2)/2
Epot = mb*g*(h + b*s2) + mt*g*(h + q3*s2)

# mass matrix: diagonal, the three axes of motion are perpendicular
M11 = J0 + (mb*b**2 + mt*q3**2)*c2**2
M22 = mb*b**2 + mt*q3**2
M33 = mt
M = sp.diag(M11, M22, M33)

# gravity load
G = sp.Matrix([0,
               g*(mb*b + mt*q3)*c2,
               mt*g*c2])

# drive torques (force for joint 3)
tau1 = M11*ddq1 - 2*(mb*b**2 + mt*q3**2)*s2*c2*dq1*dq2 + 2*mt*q3*c2**2*dq1*dq3
tau2 = M22*ddq2 + 2*mt*q3*dq2*dq3 - (mb*b**2 + mt*q3**2)*s2*c2*dq1**2 + G[1]
f3 = mt*ddq3 - mt*q3*(dq2**2 + c2**2*dq1**2) + G[2]

print(sp.simplify(M), sp.simplify(G))
for t in (tau1, tau2, f3):
    print(sp.simplify(t))
