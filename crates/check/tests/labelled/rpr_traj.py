import numpy as np

# planar RPR arm of the drawing machine
# std. DH, one list per joint: [a, alpha, d, theta]; None = the variable of that joint
dh_table = [[0.00,  np.pi/2, 0.0,  None],    # 1 revolute  q1
            [0.00, -np.pi/2, None, 0.0],     # 2 prismatic q2
            [0.25,  0.0,     0.0,  None]]    # 3 revolute  q3
l3 = 0.25


def pen(q1, q2, q3):
    x = q2*np.sin(q1) + l3*np.cos(q1 + q3)
    y = -q2*np.cos(q1) + l3*np.sin(q1 + q3)
    phi = q1 + q3
    return x, y, phi


start = np.array([np.deg2rad(30), 0.40, np.deg2rad(-90)])
goal = np.array([np.deg2rad(90), 0.60, np.deg2rad(-60)])

print(pen(*start))
# x = 0.325, y = -0.563, phi = -60 deg

# rest to rest in T seconds, cubic for every joint:
# q(t) = b0 + b2 t^2 + b3 t^3
T = 2.0
b0 = start
b2 = 3*(goal - start)/T**2
b3 = -2*(goal - start)/T**3
# joint 1 (rad):  b2 = 0.7854, b3 = -0.2618
# joint 2 (m):    b2 = 0.15,   b3 = -0.025
# fastest in the middle, after one second


def jacobian(q1, q2, q3):
    s1, c1 = np.sin(q1), np.cos(q1)
    s13, c13 = np.sin(q1 + q3), np.cos(q1 + q3)
    # rows: x, y, phi
    J = np.array([[q2*c1 - l3*s13, s1, -l3*s13],
                  [q2*s1 + l3*c13, c1,  l3*c13],
                  [1.0,            0.0, 1.0]])
    return J


# at the start: J = [[ 0.5629, 0.5,   0.2165],
#                    [ 0.325,  0.866, 0.125],
#                    [ 1.0,    0.0,   1.0]]


def inverse(x, y, phi):
    # go back along the last link, then polar coordinates
    # (the slide never goes through the axis, q2 > 0)
    wx = x - l3*np.cos(phi)
    wy = y - l3*np.sin(phi)
    q2 = np.hypot(wx, wy)
    q1 = np.arctan2(wx, -wy)
    q3 = phi - q1
    return q1, q2, q3
