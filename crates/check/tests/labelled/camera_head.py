# %% [markdown]
# # Camera head: pan, tilt, roll
# Three intersecting axes, the lens sits at distance `f` in front of them.
#
# | joint | theta   | d | a | alpha |
# |-------|---------|---|---|-------|
# | 1     | q1      | h | 0 | -90°  |
# | 2     | q2 - 90° | 0 | 0 | -90°  |
# | 3     | q3      | f | 0 | 0     |
#
# (standard Denavit-Hartenberg; tilt is positive when the camera looks *down*)

# %%
from sympy import *
q1, q2, q3, h, f = symbols('q1 q2 q3 h f', real=True)
c1, s1, c2, s2, c3, s3 = cos(q1), sin(q1), cos(q2), sin(q2), cos(q3), sin(q3)

def A(theta, d, a, alpha):
    return Matrix([
        [cos(theta), -sin(theta)*cos(alpha), sin(theta)*sin(alpha), a*cos(theta)],
        [sin(theta), cos(theta)*cos(alpha), -cos(theta)*sin(alpha), a*sin(theta)],
        [0, sin(alpha), cos(alpha), d],
        [0, 0, 0, 1]])

# %% [markdown]
# Multiply out and compare with what I had on paper.

# %%
T03 = A(q1, h, 0, -pi/2) * A(q2 - pi/2, 0, 0, -pi/2) * A(q3, f, 0, 0)
R03 = Matrix([
    [c1*s2*c3 + s1*s3, -c1*s2*s3 + s1*c3, c1*c2],
    [s1*s2*c3 - c1*s3, -s1*s2*s3 - c1*c3, s1*c2],
    [c2*c3,            -c2*s3,            -s2]])
lens = Matrix([f*c1*c2, f*s1*c2, h - f*s2])

# %% [markdown]
# Orientation as a unit quaternion (w, x, y, z). In the home position the camera frame is the base frame turned by
# 180° about the bisector of x and z, hence the pi/4.

# %%
qw = -cos(q2/2 + pi/4)*sin((q1 + q3)/2)
qx = sin(q2/2 + pi/4)*cos((q1 - q3)/2)
qy = sin(q2/2 + pi/4)*sin((q1 + q3)/2)
qz = cos(q2/2 + pi/4)*cos((q1 + q3)/2)

# %% [markdown]
# Roll-pitch-yaw of the camera frame, R = Rz(yaw) Ry(pitch) Rx(roll), from the elements of R03
# (pitch between -90° and 90°)

# %%
yaw = atan2(s1*s2*c3 - c1*s3, c1*s2*c3 + s1*s3)
pitch = asin(-c2*c3)
roll = atan2(-c2*s3, -s2)

# %% [markdown]
# Joint angles back from a wanted rotation matrix (camera never tilts past the vertical, |q2| < 90°)

# %%
r11, r12, r13, r21, r22, r23, r31, r32, r33 = symbols('r11 r12 r13 r21 r22 r23 r31 r32 r33')
pan = atan2(r23, r13)
tilt = atan2(-r33, sqrt(r13**2 + r23**2))
rollangle = atan2(r32, r31)

# %% [markdown]
# Angular velocity of the camera, omega = Jw * (dq1, dq2, dq3)

# %%
Jw = Matrix([
    [0, -s1, c1*c2],
    [0,  c1, s1*c2],
    [1,   0, s2]])
detJw = -c2
