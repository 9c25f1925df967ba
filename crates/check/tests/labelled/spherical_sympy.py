"""RRP arm with shoulder offset e -- sympy check of the hand calculation (sheet 4)
standard DH
"""
import sympy as sp
from sympy import sin, cos, pi, Matrix

q1, q2, q3 = sp.symbols('q1 q2 q3', real=True)
h, e = sp.symbols('h e', positive=True)

def A(theta, d, a, alpha):
    ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return Matrix([[ct, -st*ca,  st*sa, a*ct],
                   [st,  ct*ca, -ct*sa, a*st],
                   [0,      sa,     ca,    d],
                   [0,       0,      0,    1]])

#      theta  d   a  alpha
dh = [(q1,    h,  0, -pi/2),
      (q2,    e,  0,  pi/2),
      (0,     q3, 0,  0)]

A1 = A(*dh[0])
A2 = A(*dh[1])
A3 = A(*dh[2])

T02 = A1*A2
T03 = sp.simplify(A1*A2*A3)
sp.pprint(T03)

# what I had on paper
T03_paper = Matrix([
    [cos(q1)*cos(q2), -sin(q1), cos(q1)*sin(q2), q3*cos(q1)*sin(q2) - e*sin(q1)],
    [sin(q1)*cos(q2),  cos(q1), sin(q1)*sin(q2), q3*sin(q1)*sin(q2) - e*cos(q1)],
    [-sin(q2),         0,       cos(q2),         h + q3*cos(q2)],
    [0, 0, 0, 1]])

p = T03[:3, 3]
Jv = p.jacobian([q1, q2, q3])

z0 = Matrix([0, 0, 1])
z1 = A1[:3, 2]
z2 = T02[:3, 2]
Jw = Matrix.hstack(z0, z1, z2)

# paper again, linear part
Jv_paper = Matrix([
    [-q3*sin(q1)*sin(q2) - e*cos(q1), q3*cos(q1)*cos(q2), cos(q1)*sin(q2)],
    [ q3*cos(q1)*sin(q2) - e*sin(q1), q3*sin(q1)*cos(q2), sin(q1)*sin(q2)],
    [0, -q3*sin(q2), cos(q2)]])
detJ = -q3**2*sin(q2)
print(sp.simplify(Jv.det() - detJ))

# back again: p -> q   (arm reaching forward, q3*sin(q2) > 0)
px, py, pz = sp.symbols('px py pz', real=True)
R = sp.sqrt(px**2 + py**2 - e**2)
q1_sol = sp.atan2(py, px) - sp.atan2(e, R)
q2_sol = sp.atan2(R, pz - h)
q3_sol = sp.sqrt(R**2 + (pz + h)**2)
