%% CylBot: cylindrical arm (R P P) with a wrist roll and an offset gripper finger
% Lab 3, group 7        Peter Corke's toolbox, standard DH
clear; close all; clc

h  = 0.40;    % column
a1 = 0.12;    % offset column -> lift
a4 = 0.09;    % finger beside the roll axis

L(1) = Link('revolute',  'd', h, 'a', a1, 'alpha', 0);
L(2) = Link('prismatic', 'theta', 0,    'a', 0, 'alpha', -pi/2);
L(3) = Link('prismatic', 'theta', pi/2, 'a', 0, 'alpha',  pi/2);
L(4) = Link('revolute',  'd', 0, 'a', a4, 'alpha', 0);
cyl = SerialLink(L, 'name', 'CylBot');
% q = [q1 d2 d3 q4]

syms q1 d2 d3 q4 h a1 a4 real
c1 = cos(q1); s1 = sin(q1); c4 = cos(q4); s4 = sin(q4);

A1 = [c1, -s1, 0, a1*c1; s1, c1, 0, a1*s1; 0, 0, 1, h; 0, 0, 0, 1];
A2 = [1, 0, 0, 0; 0, 0, 1, 0; 0, -1, 0, d2; 0, 0, 0, 1];
A3 = [0, 0, 1, 0; 1, 0, 0, 0; 0, 1, 0, d3; 0, 0, 0, 1];
A4 = [c4, -s4, 0, a4*c4; s4, c4, 0, a4*s4; 0, 0, 1, 0; 0, 0, 0, 1];

% up to the roll axis, multiplied out by hand
T13 = [0, 0, 1, 0; 0, 1, 0, d3; -1, 0, 0, d2; 0, 0, 0, 1];
T03 = [0,  -s1, c1, a1*c1 + d3*s1;
        0,   c1, s1, a1*s1 + d3*c1;
       -1,   0,  0,  h + d2;
        0,   0,  0,  1];

% gripper point p and finger direction n = T04(1:3,1)
p(1) = a1*c1 + d3*s1 - a4*s1*s4;
p(2) = a1*s1 + d3*c1 + a4*c1*s4;
p(3) = h + d2 - a4*c4;
n = [-s1*s4; c1*s4; -c4];

% geometric Jacobian (by the cross-product rule, checked with cyl.jacob0 for one q)
J = [-a1*s1 - d3*c1 - a4*c1*s4, 0, -s1, -a4*s1*c4;
      a1*c1 - d3*s1 - a4*s1*s4, 0,  c1,  a4*c1*c4;
      0,                        1,  0,   a4*s4;
      0,                        0,  0,   s1;
      0,                        0,  0,   s1;
      1,                        0,  0,   0];

% inverse kinematics from w = p - a4*n (point on the roll axis), n given
d2 = w(3) - h;
d3 = sqrt(w(1)^2 + w(2)^2 - a1^2);
q1 = atan2(w(2), w(1)) - atan2(d3, a1);
q4 = atan2(c1*n(2) - s1*n(1), -n(3));
