% STATICS_RRP  velocities and static forces of a rotary-rotary-sliding arm
% Frames after Craig (modified DH):
%
%   i   alpha_{i-1}   a_{i-1}   d_i   theta_i
%   1   0             0         0     t1
%   2   -90 deg       a1        e     t2
%   3   90 deg        0         d3    0
%
% the tool point is the origin of frame {3}

a1 = 0.20;  e = 0.08;
t1 = 0.4;  t2 = 1.1;  d3 = 0.55;      % working point used for the report

c1 = cos(t1);  s1 = sin(t1);
c2 = cos(t2);  s2 = sin(t2);

T01 = [c1 -s1 0 0; s1 c1 0 0; 0 0 1 0; 0 0 0 1];
T12 = [c2 -s2 0 a1; 0 0 1 e; -s2 -c2 0 0; 0 0 0 1];
T23 = [1 0 0 0; 0 0 -1 -d3; 0 1 0 0; 0 0 0 1];

T03 = T01*T12*T23;

% closed form of the tool point
px = c1*(a1 + d3*s2) - s1*e;
py = s1*(a1 + d3*s2) + c1*e;
pz = d3*c2;

% linear part of the Jacobian, base frame: v = J*[dt1; dt2; dd3]
J = [ -s1*(a1 + d3*s2) - c1*e,  d3*c1*c2,  c1*s2;
       c1*(a1 + d3*s2) - s1*e,  d3*s1*c2,  s1*s2;
       0,                      -d3*s2,     c2 ];

% turning it into frame {1} makes it nearly triangular
J1 = [ -e,           d3*c2,   s2;
        a1 + d3*s2,  0,       0;
        0,          -d3*s2,   c2 ];

% det is the same in both frames
detJ = d3*(a1 + d3*s2);

% angular part
Jw = [0 -s1 0; 0 c1 0; 1 0 0];

% statics: torques that carry a load F at the tool, n = J'*F
Fx = 10;  Fy = -4;  Fz = 25;
F = [Fx; Fy; Fz];
n = J'*F;
n1 = px*Fy - py*Fx;
n2 = d3*(c1*c2*Fx + s1*c2*Fy + s2*Fz);
f3 = c1*s2*Fx + s1*s2*Fy + c2*Fz;

% tool velocity for pure sliding and for pure slewing
v_slide = [c1*s2; s1*s2; c2];          % per m/s of dd3
v_slew  = [-py; px; 0];                % per rad/s of dt1
