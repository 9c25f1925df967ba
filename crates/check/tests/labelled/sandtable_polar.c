// sandtable_polar.c
// Sisyphus-style sand table. Arm turns (angle A), ball carriage slides along it (S).
// The rail is mounted EC millimetres beside the centre because I drilled before measuring.
//
// DH, standard, for the nerds:   theta   d   a    alpha
//                                A       0   EC   -90
//                                0       S   0    0
//
// z1 is the direction of the rail.
#include <math.h>

float ballX(float A, float S) {
  float x = EC*cos(A) - S*sin(A);
  return x;
}

float ballY(float A, float S) {
  float y = EC*sin(A) + S*cos(A);
  return y;
}

// carriage position for a ball position (S is never negative)
float railS(float x, float y) {
  float S = sqrt(x*x + y*y - EC*EC);
  return S;
}

// arm angle for a ball position
float armA(float x, float y) {
  float S = sqrt(x*x + y*y - EC*EC);
  float A = atan2(y, x) + atan2(S, EC);
  return A;
}

// the same, what I use now
float armA2(float x, float y) {
  float S = sqrt(x*x + y*y - EC*EC);
  float A = atan2(EC*y - S*x, EC*x + S*y);
  return A;
}

// ball speed for arm rate Ad and carriage rate Sd
void ballSpeed(float A, float S, float Ad, float Sd, float *vx, float *vy, float *v) {
  *vx = -(EC*sin(A) + S*cos(A))*Ad - sin(A)*Sd;
  *vy = (EC*cos(A) - S*sin(A))*Ad + cos(A)*Sd;
  *v = sqrt(S*S*Ad*Ad + Sd*Sd);
}

// motor rates for a wanted ball speed (vx, vy)
void motors(float A, float S, float vx, float vy, float *Ad, float *Sd) {
  *Ad = -(vx*cos(A) + vy*sin(A))/S;
  *Sd = -vx*sin(A) + vy*cos(A) - EC*(*Ad);
}
