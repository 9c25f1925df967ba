%% polar_arm.m  --  forward kinematics of the polar arm, symbolic
% DH table (standard convention)
%   joint   theta     d        a    alpha
%   1       t1        L1       0    90
%   2       t2+90     0        0    90
%   3       0         d3+L2    0    0
% t2 = 0 is the boom horizontal
clear
syms t1 t2 d3 L1 L2 real

A1 = [cos(t1), 0, sin(t1), 0; sin(t1), 0, -cos(t1), 0; 0, 1, 0, L1; 0, 0, 0, 1];
A2 = [-sin(t2), 0, cos(t2), 0; cos(t2), 0, sin(t2), 0; 0, 1, 0, 0; 0, 0, 0, 1];
A3 = [1, 0, 0, 0; 0, 1, 0, 0; 0, 0, 1, d3 + L2; 0, 0, 0, 1];

%% result of simplify(A1*A2)
T02 = [-cos(t1)*sin(t2), sin(t1), cos(t1)*cos(t2), 0;
       -sin(t1)*sin(t2), -cos(t1), sin(t1)*cos(t2), 0;
       cos(t2), 0, sin(t2), L1;
       0, 0, 0, 1];

%% tip
px = (d3 + L2)*cos(t1)*cos(t2);
py = (d3 + L2)*sin(t1)*cos(t2);
pz = L1 + (d3 + L2)*sin(t2);

%% linear and angular Jacobian
Jv = [-(d3 + L2)*sin(t1)*cos(t2), -(d3 + L2)*cos(t1)*sin(t2), cos(t1)*cos(t2);
       (d3 + L2)*cos(t1)*cos(t2), (d3 + L2)*sin(t1)*sin(t2), sin(t1)*cos(t2);
       0, (d3 + L2)*cos(t2), sin(t2)];
Jw = [0, sin(t1), 0;
      0, -cos(t1), 0;
      1, 0, 0];
detJ = (d3 + L2)^2*cos(t2);

%% inverse
t1 = atan2(py, px);
t2 = atan2(pz - L1, sqrt(px^2 + py^2));
d3 = sqrt(px^2 + py^2 + (pz - L1)^2);
