function [q, J] = scara_pickplace_ik(px, py, pz, yaw, config)
%SCARA_PICKPLACE_IK  joint values for the pick-and-place cell of building 7
%   config = +1 (left arm, q2 positive) or -1 (right arm, q2 negative)
%   lengths in metres: a1 and a2 are the two arms, h the height of the column, t the tool
%   angles in radians

% elbow
D = (px^2 + py^2 - a1^2 - a2^2)/(2*a1*a2);
q2 = atan2(config*sqrt(1 - D^2), D);

% shoulder
k1 = a1 + a2*cos(q2);
k2 = a2*sin(q2);
q1 = atan2(py, px) - atan2(k2, k1);

% quill, the tool points down
q3 = h - t + pz;

% yaw = direction of the gripper x axis seen from above
q4 = q1 + q2 - yaw;

% Jacobian for (px, py, pz, yaw)
J = [ -a1*sin(q1)-a2*sin(q1+q2), -a2*sin(q1+q2),  0,  0;
       a1*cos(q1)+a2*cos(q1+q2),  a2*cos(q2),      0,  0;
       0,                         0,              -1,  0;
       1,                         1,               0,  1 ];

% manipulability of the arm, for the warning lamp
detJ = a1*a2*sin(q2);

% rates for a straight horizontal move with speed (ux, uy)
q1dot = (cos(q1+q2)*ux + sin(q1+q2)*uy)/(a1*sin(q2));
q2dot = -((a1*cos(q1) + a2*cos(q1+q2))*ux + (a1*sin(q1) + a2*sin(q1+q2))*uy)/(a1*a2*sin(q2));

q = [q1; q2; q3; q4];

% sanity check by hand: forward kinematics
px = a1*cos(q1) + a2*cos(q1 + q2);
py = a1*sin(q1) + a2*sin(q1 + q2);
pz = h - t - q3;
end
