function [x, y, z, T] = robot3(q)
% ROBOT3  elbow arm of the teaching lab, all angles in rad, lengths in m
%
%   DH parameters (standard)
%   link  theta  d     a     alpha
%   1     q(1)   L1    0     pi/2
%   2     q(2)   0     L2    0
%   3     q(3)   0     L3    0
L1 = 0.30; L2 = 0.28; L3 = 0.22;
x = cos(q(1))*(L2*cos(q(2)) + L3*cos(q(2) + q(3)));
y = sin(q(1))*(L2*cos(q(2)) + L3*cos(q(2) + q(3)));
z = L1 + L2*sin(q(2)) + L3*sin(q(2) + q(3));
A1 = [cos(q(1)), 0, sin(q(1)), 0; sin(q(1)), 0, -cos(q(1)), 0; 0, 1, 0, L1; 0, 0, 0, 1];
A3 = [cos(q(3)), -sin(q(3)), 0, L3*cos(q(3)); sin(q(3)), cos(q(3)), 0, L2*sin(q(3)); 0, 0, 1, 0; 0, 0, 0, 1];
c1 = cos(q(1)); s1 = sin(q(1)); c23 = cos(q(2) + q(3)); s23 = sin(q(2) + q(3));
T = [c1*c23, -c1*s23, s1, x; s1*c23, -s1*s23, -c1, y; s23, c23, 0, z; 0, 0, 0, 1];
end

function J = robot3_jacobian(q)
L2 = 0.28; L3 = 0.22;
c1 = cos(q(1)); s1 = sin(q(1)); c2 = cos(q(2)); s2 = sin(q(2));
c23 = cos(q(2) + q(3)); s23 = sin(q(2) + q(3));
J = [-s1*(L2*c2 + L3*c23), -c1*(L2*s2 + L3*s23), -L3*c1*s23;
      c1*(L2*c2 + L3*c23), -s1*(L2*s2 + L3*s23), -L3*s1*s23;
      0, L2*c2 + L3*c23, L3*c23];
end

function q = robot3_inverse(x, y, z)
% elbow-down solution (q(3) > 0), arm facing the point
L1 = 0.30; L2 = 0.28; L3 = 0.22;
r = sqrt(x^2 + y^2);
h = z - L1;
D = (r^2 + h^2 - L2^2 - L3^2)/(2*L2*L3);
th1 = atan2(y, x);
th3 = atan2(sqrt(1 - D^2), D);
th2 = atan2(r, h) - atan2(L3*sin(th3), L2 + L3*cos(th3));
q = [th1; th2; th3];
end
