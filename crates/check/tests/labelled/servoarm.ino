// ServoArm: 4 hobby servos, base - shoulder - elbow - wrist
//
// DH parameters (standard), mm and degrees
//   joint   theta   d    a    alpha
//   1       base    L1   0    90
//   2       sh      0    L2   0
//   3       el      0    L3   0
//   4       wri     0    L4   0
//
// all angles inside are radians, only servo.write() wants degrees

#include <Servo.h>

const float L1 = 70.0, L2 = 105.0, L3 = 98.0, L4 = 60.0;

Servo sBase, sShoulder, sElbow, sWrist;
float base, sh, el, wri;        // current joint angles
float x, y, z, pitch;           // tip and its inclination against the ground

void forward() {
  float r = L2*cos(sh) + L3*cos(sh + el) + L4*cos(sh + el + wri);
  x = r*cos(base);
  y = r*sin(base);
  z = L1 + L2*sin(sh) + L3*sin(sh + el) + L4*sin(sh + wri);
  pitch = sh + el + wri;
}

// Sets the joint angles for a tip position and pitch. Elbow up. false: not reachable
bool inverse(float x, float y, float z, float pitch) {
  base = atan2(y, x);
  float r = sqrt(x*x + y*y);
  // go back from the tip to the wrist
  float wr = r - L4*cos(pitch);
  float wz = z - L1 - L4*sin(pitch);
  float D2 = wr*wr + wz*wz;
  float D = sqrt(D2);
  float ce = (D2 - L2*L2 - L3*L3) / (2*L2*L3);
  if (ce < -1 || ce > 1) return false;
  el = -acos(ce);
  sh = atan2(wr, wz) + acos((L2*L2 + D2 - L3*L3) / (2*L2*D));
  wri = pitch - sh - el;
  return true;
}

// speed of the tip in the vertical plane of the arm (mm/s) from joint speeds (rad/s)
void planeSpeed(float dsh, float del, float dwri, float &vr, float &vz) {
  float s2 = sin(sh), s23 = sin(sh + el), s234 = sin(sh + el + wri);
  float c2 = cos(sh), c23 = cos(sh + el), c234 = cos(sh + el + wri);
  vr = -L2*s2*dsh - L3*s23*(dsh + del) - L4*s234*(dsh + del + dwri);
  vz = L2*c2*dsh + L3*c23*(dsh + del) + L4*c234*(dsh + del + dwri);
}

void setup() {
  sBase.attach(3); sShoulder.attach(5); sElbow.attach(6); sWrist.attach(9);
  if (inverse(150, 50, 90, -PI/4)) {
    sBase.write(90 + base*180/PI);
    sShoulder.write(sh*180/PI);
    sElbow.write(180 + el*180/PI);
    sWrist.write(90 + wri*180/PI);
  }
}

void loop() {}
