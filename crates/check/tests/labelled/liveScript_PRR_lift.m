%% Kinematics of the palletizing lift
% *Exported from a live script, R2023b.* Joint 1 slides up a column, joints 2 and 3 turn about the vertical.
%%
% Standard DH table [theta d a alpha]:
%
%   0   d1  r1  0
%   t2  0   r2  0
%   t3  -g  r3  pi
%
% (g is how far the gripper hangs below the last arm)
syms d1 t2 t3 g r1 r2 r3 real
%% Link transforms
A1 = [1 0 0 r1; 0 1 0 0; 0 0 1 d1; 0 0 0 1];
A2 = [cos(t2), -sin(t2), 0, r2*cos(t2);
      sin(t2),  cos(t2), 0, r2*sin(t2);
      0, 0, 1, 0;
      0, 0, 0, 1];
A3 = [cos(t3),  sin(t3),  0, r3*cos(t3);
      sin(t3), -cos(t3),  0, r3*sin(t3);
      0, 0, -1, -g;
      0, 0, 0, 1];
%% Hand
T13 = A2*A3;
T03 = A1*T13;
px = r1 + r2*cos(t2) + r3*cos(t2 + t3);
py = r2*sin(t2) + r3*sin(t2 + t3);
pz = d1 - g;
%% Jacobian (rows x, y, z, rotation about z)
J = [0, -r2*sin(t2) - r3*sin(t2 + t3), -r3*sin(t2 + t3);
     0,  r2*cos(t2) + r3*cos(t2 + t3),  r2*cos(t2 + t3);
     1,  0, 0;
     0,  1, 1];
%% Singularities of the xyz part
detJ = r2*r3*sin(t3);
%% Velocity for joint rates w1 (m/s), w2, w3 (rad/s)
vx = -r2*sin(t2)*w2 - r3*sin(t2 + t3)*(w2 + w3);
vy = r2*cos(t2)*w2 + r3*cos(t2 + t3)*w2 + r2*cos(t2 + t3)*w3;
vz = w1;
%% Inverse kinematics, given px py pz
d1 = pz + g;
C3 = ((px - r1)^2 + py^2 - r2^2 - r3^2)/(2*r2*r3);
t3 = atan2(-sqrt(1 - C3^2), C3);
t2 = atan2(py, px) - atan2(r3*sin(t3), r2 + r3*cos(t3));
