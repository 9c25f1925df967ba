function q = puma_ik(px, py, pz, arm, elbow)
%PUMA_IK  first three joints of the PUMA 560, Craig frames
%   modified DH
%     i  alpha(i-1)  a(i-1)  d(i)  theta(i)
%     1     0          0      0     t1
%     2   -90          0      0     t2
%     3     0          a2     d3    t3
%     4   -90          a3     d4    t4
%   (px,py,pz) wrist centre = origin of frame 4
%   arm, elbow = +1 or -1 choose the solution
a2 = 0.4318; a3 = 0.0203; d3 = 0.1245; d4 = 0.4318;

t1 = atan2(py, px) - atan2(d3, arm*sqrt(px^2 + py^2 - d3^2));
c1 = cos(t1); s1 = sin(t1);

K  = (px^2 + py^2 + pz^2 - a2^2 - a3^2 - d3^2 - d4^2)/(2*a2);
t3 = atan2(a3, d4) - atan2(K, elbow*sqrt(a3^2 + d4^2 - K^2));
c3 = cos(t3); s3 = sin(t3);

rho = c1*px + s1*py;
t23 = atan2(-(a3 + a2*c3)*pz - rho*(d4 - a2*s3), (a2*s3 - d4)*pz - (a3 + a2*c3)*rho);
t2  = t23 - t3;
q = [t1 t2 t3];
end

function [p, J] = puma_fk(t1, t2, t3)
% and forward again, to see that we get the point back
a2 = 0.4318; a3 = 0.0203; d3 = 0.1245; d4 = 0.4318;
c1 = cos(t1); s1 = sin(t1);
c2 = cos(t2); s2 = sin(t2);
c23 = cos(t2+t3); s23 = sin(t2+t3);
g  = a2*c2 + a3*c23 - d4*s23;      % distance in the arm plane
x4 = c1*g - s1*d3;
y4 = s1*g - c1*d3;
z4 = -a2*s2 - a3*s23 - d4*c23;
p  = [x4; y4; z4];

T01 = [c1 -s1 0 0; s1 c1 0 0; 0 0 1 0; 0 0 0 1];
T12 = [c2 -s2 0 0; 0 0 1 0; -s2 -c2 0 0; 0 0 0 1];
T23 = [cos(t3) -sin(t3) 0 a2; sin(t3) cos(t3) 0 0; 0 0 1 d3; 0 0 0 1];

% Jacobian of the wrist centre (base frame)
J = [-s1*g - d3*c1,  c1*z4, c1*(-a3*s23 - d4*c23);
      c1*g - d3*s1,  s1*z4, s1*(-a3*s23 - d4*c23);
      0,            -g,     -a3*c23 - d4*s23];
if abs(det(J)) < 1e-4, warning('near a singular configuration'), end
end
