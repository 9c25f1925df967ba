% RPR arm, lab 6   (turn - boom - turn, everything in the plane)
% standard DH:
%   i   theta   d    a    alpha
%   1   t1      0    0     90
%   2   0       d2   0    -90
%   3   t3      0    a3    0
clear all, close all
syms t1 t3 d2 a3 Fx Fy M x y phi real

A1 = [cos(t1) 0  sin(t1) 0
      sin(t1) 0 -cos(t1) 0
      0       1  0       0
      0       0  0       1];
A2 = [1  0  0  0
      0  0  1  0
      0 -1  0  d2
      0  0  0  1];
A3 = [cos(t3) -sin(t3) 0 a3*sin(t3)
      sin(t3)  cos(t3) 0 a3*cos(t3)
      0        0       1 0
      0        0       0 1];

T02 = simplify(A1*A2);
T03 = simplify(A1*A2*A3);

% from geometry
px =  d2*sin(t1) + a3*cos(t1+t3);
py = -d2*cos(t1) + a3*sin(t1+t3);

% rows x, y, phi
J = [ d2*cos(t1) - a3*sin(t1+t3),  sin(t1), -a3*sin(t1+t3);
      d2*sin(t1) + a3*cos(t1+t3), -cos(t1),  a3*cos(t1+t3);
      1,                           0,        1 ];
detJ = -d2;       % so singular only with the boom fully in, d2 = 0

% forces: tau = J'*[Fx;Fy;M]
tau1 = (d2*cos(t1) - a3*sin(t1+t3))*Fx + (d2*sin(t1) + a3*cos(t1+t3))*Fy + M;
tau2 = sin(t1)*Fx + cos(t1)*Fy;
tau3 = -a3*sin(t1+t3)*Fx + a3*cos(t1+t3)*Fy + M;

% inverse (boom never negative)
wx = x - a3*cos(phi);
wy = y - a3*sin(phi);
d2s = sqrt(wx^2 + wy^2);
t1s = atan2(wy, wx);
t3s = phi - t1s;
