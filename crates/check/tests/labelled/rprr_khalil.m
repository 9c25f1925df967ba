function rprr_khalil()
% Geometric model of the loading arm RPRR, notation of Khalil and Kleinfinger
%
%  j  sigma  alpha_j  d_j   theta_j  r_j
%  1  0      0        0     th1      0
%  2  1      0        D2    0        r2
%  3  0      pi/2     0     th3      0
%  4  0      0        D4    th4      0
%
% the hand E is fixed to link 4, D5 along x4

D2 = 0.30; D4 = 0.45; D5 = 0.20;
th1 = 0.7; r2 = 0.9; th3 = -0.3; th4 = 1.2;

C1 = cos(th1); S1 = sin(th1);
C3 = cos(th3); S3 = sin(th3);
C4 = cos(th4); S4 = sin(th4);
C34 = cos(th3 + th4); S34 = sin(th3 + th4);

% elementary matrices, jTi means frame i seen from frame j
T0_1 = [C1 -S1 0 0
        S1  C1 0 0
        0   0  1 0
        0   0  0 1];
T1_2 = [1 0 0 D2
        0 1 0 0
        0 0 1 r2
        0 0 0 1];
T2_3 = [C3 -S3  0 0
        0   0   1 0
        S3  C3  0 0
        0   0   0 1];
T3_4 = [C4 -S4 0 D4
        S4  C4 0 0
        0   0  1 0
        0   0  0 1];

% product, written out
T0_4 = [C1*C34  -C1*S34   S1  C1*(D2 + D4*C3)
        S1*C34  -S1*S34  -C1  S1*(D2 + D4*C3)
        S34      C34      0   r2 + D4*S3
        0        0        0   1];

% hand
Px = C1*(D2 + D4*C3 + D5*C34);
Py = S1*(D2 + D4*C3 + D5*C34);
Pz = r2 + D4*S3 + D5*S34;

% kinematic Jacobian of the hand, v and omega stacked
rho = D2 + D4*C3 + D5*C34;
eta = D4*S3 + D5*S34;
J = [-S1*rho, 0, -C1*eta, -C1*D5*S34
      C1*rho, 0, -S1*eta, -S1*D5*S34
      0,      1,  rho - D2, D5*C34
      0,      0,  S1,      S1
      0,      0, -C1,     -C1
      1,      0,  0,       0];

% inverse: wanted Px, Py, Pz and the inclination beta = th3 + th4 of the hand
beta = th3 + th4;
q1 = atan2(Py, Px);
R = Px*cos(q1) + Py*sin(q1);
c3 = (R - D2 - D5*cos(beta))/D4;
q3 = acos(c3);
q4 = beta - q3;
q2 = Pz - D4*sin(q3) - D5*cos(beta);
disp([q1 q2 q3 q4])
end
