/* 4-servo arm, inverse kinematics on the Arduino
 *
 * base turns about the vertical, then shoulder, elbow, wrist pitch (all three parallel).
 * DH parameters, standard, mm and degrees:
 *
 *   i | theta | d  | a  | alpha
 *   1 | t1    | H  | 0  | 90
 *   2 | t2    | 0  | LA | 0
 *   3 | t3    | 0  | LB | 0
 *   4 | t4    | 0  | LC | 0
 *
 * pitch = t2 + t3 + t4, angle of the gripper above the horizontal
 */
#include <math.h>
const float H = 71, LA = 125, LB = 125, LC = 60;
float t1, t2, t3, t4;

bool moveTo(float x, float y, float z, float pitch) {
  t1 = atan2(x, y);
  float r  = sqrt(x*x + y*y);
  float rw = r - LC*cos(pitch);      // wrist
  float zw = z - H - LC*sin(pitch);
  float c3 = (rw*rw + zw*zw - LA*LA - LB*LB) / (2*LA*LB);
  if (c3 > 1 || c3 < -1) return false;
  t3 = -acos(c3);                    // elbow up please
  t2 = atan2(zw, rw) - atan2(LB*sin(t3), LA + LB*cos(t3));
  t4 = pitch - t2 - t3;
  return true;
}

// where are we? (for the display)
void whereAmI(float &x, float &y, float &z) {
  float reach = LA*cos(t2) + LB*cos(t2+t3) + LC*cos(t2+t3+t4);
  x = cos(t1)*reach;
  y = sin(t1)*reach;
  z = H + LA*sin(t2) + LB*sin(t2+t3) + LC*sin(t2+t3+t4);
}

// how fast does the tip go up: zdot = jz2*t2dot + jz3*t3dot + jz4*t4dot
void zRates(float &jz2, float &jz3, float &jz4) {
  jz2 = LA*cos(t2) + LB*cos(t2+t3) + LC*cos(t2+t3+t4);
  jz3 = LB*cos(t2+t3) + LC*cos(t2+t3+t4);
  jz4 = LC*sin(t2+t3+t4);
}
