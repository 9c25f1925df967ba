# %% [markdown]
# # Two-link arm in the vertical plane: statics and dynamics
# Standard DH parameters (gravity along -y)
#
# | i | a  | alpha | d | theta |
# |---|----|-------|---|-------|
# | 1 | l1 | 0     | 0 | th1   |
# | 2 | l2 | 0     | 0 | th2   |
#
# masses m1, m2, centres of mass at lc1, lc2 along the links, inertias I1, I2 about the centres of mass

# %%
import numpy as np
l1, l2 = 0.5, 0.4
lc1, lc2 = 0.25, 0.2
m1, m2 = 4.0, 2.5
I1, I2 = 0.09, 0.04
g = 9.81

# %% tip
def tip(th1, th2):
    x = l1*np.cos(th1) + l2*np.cos(th1 + th2)
    y = l1*np.sin(th1) + l2*np.sin(th1 + th2)
    return x, y

# %% Jacobian, static torques
def jac(th1, th2):
    J = np.array([[-l1*np.sin(th1) - l2*np.sin(th1+th2), -l2*np.sin(th1+th2)],
                  [ l1*np.cos(th1) + l2*np.cos(th1+th2),  l2*np.cos(th1+th2)]])
    return J

def invjac(th1, th2):
    c12, s12 = np.cos(th1+th2), np.sin(th1+th2)
    Jinv = np.array([[l2*c12, l2*s12],
                     [-l1*np.cos(th1) - l2*c12, -l1*np.sin(th1) - l2*s12]]) / (l1*l2*np.cos(th2))
    return Jinv

def static(th1, th2, F):
    tau1 = (-l1*np.sin(th1) - l2*np.sin(th1+th2))*F[0] + (l1*np.cos(th1) + l2*np.cos(th1+th2))*F[1]
    tau2 = -l2*np.sin(th1+th2)*F[0] + l2*np.cos(th1+th2)*F[1]
    return tau1, tau2

# %% equations of motion  M qdd + c + G = tau
def dyn(th1, th2, w1, w2):
    M11 = m1*lc1**2 + I1 + m2*(l1**2 + lc2**2 + 2*l1*lc2*np.cos(th2)) + I2
    M12 = m2*(lc2**2 + l1*lc2*np.cos(th2)) + I2
    M22 = m2*lc2**2 + I2
    h = m2*l1*lc2*np.sin(th2)
    C1 = -h*(2*w1*w2 + w2**2)
    C2 = -h*w1**2
    G1 = (m1*lc1 + m2*l1)*g*np.cos(th1) + m2*lc2*g*np.cos(th1+th2)
    G2 = m2*lc2*g*np.cos(th2)
    return M11, M12, M22, C1, C2, G1, G2
