function [T, J, tau] = lamp_arm(q, F)
% LAMP_ARM  kinematics of the ceiling-lamp arm (RRPR), lecture convention = modified DH (Craig)
%
%   i | alpha(i-1)  a(i-1)  theta(i)  d(i)
%   --+------------------------------------
%   1 |    0          0       q1        h
%   2 |   90          e       q2        0
%   3 |   90          0       0         d3
%   4 |    0          0       q4        c
%
%   q = [q1 q2 d3 q4] (rad, m), F = force exerted by the lamp head (base frame)

h = 2.2;  e = 0.15;  c = 0.10;
q1 = q(1); q2 = q(2); d3 = q(3); q4 = q(4);
c1 = cos(q1); s1 = sin(q1); c2 = cos(q2); s2 = sin(q2); c4 = cos(q4); s4 = sin(q4);

T01 = [c1, -s1, 0, 0; s1, c1, 0, 0; 0, 0, 1, h; 0, 0, 0, 1];
T12 = [c2, -s2, 0, e; 0, 0, -1, 0; s2, c2, 0, 0; 0, 0, 0, 1];
T23 = [1, 0, 0, 0; 0, 0, -1, d3; 0, 1, 0, 0; 0, 0, 0, 1];
T34 = [c4, -s4, 0, 0; s4, c4, 0, 0; 0, 0, 1, c; 0, 0, 0, 1];

% position of the head, from the sketch
D  = d3 + c;
rho = e + D*s2;
x  = rho*c1;
y  = rho*s1;
z  = h - D*s2;

% orientation of the head, from the sketch
R04 = [c1*c2*c4 + s1*s4, -c1*c2*s4 + s1*c4, c1*s2;
       s1*c2*c4 - c1*s4, -s1*c2*s4 - c1*c4, s1*s2;
       s2*c4,            -s2*s4,             c2];
T = [R04, [x; y; z]; 0 0 0 1];

% linear and angular Jacobian
J = [-s1*rho, D*c1*c2, c1*s2, 0;
      c1*rho, D*s1*c2, s1*s2, 0;
      0,      D*s2,    -c2,   0];
Jw = [0, s1, 0, c1*s2;
      0, -c1, 0, s1*s2;
      1, 0, 0, -c2];
% determinant of the first three columns of J
detJ = D*(e + D*s2);

% joint torques tau = J'*F, written out
tau1 = rho*(c1*F(2) - s1*F(1));
tau2 = D*(c1*c2*F(1) + s1*c2*F(2) - s2*F(3));
f3   = c1*s2*F(1) + s1*s2*F(2) - c2*F(3);
tau = [tau1; tau2; f3; 0];
end

function q = lamp_ik(T)
% the lamp hangs in front of the column (rho > 0) and the slide is always out (D > 0)
h = 2.2;  e = 0.15;  c = 0.10;
x = T(1,4); y = T(2,4); z = T(3,4);
q1 = atan2(y, x);
rr = sqrt(x^2 + y^2) - e;
q2 = atan2(rr, h - z);
d3 = sqrt(rr^2 + (h - z)^2) - c;
q4 = atan2(sin(q1)*T(1,1) - cos(q1)*T(2,1), sin(q1)*T(1,2) - cos(q1)*T(2,2));
q = [q1 q2 d3 q4];
end
