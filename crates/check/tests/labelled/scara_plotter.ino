/*
 *  scara_plotter.ino   -  pick & draw SCARA, RRPR, four steppers
 *
 *  DH table (standard), mm and degrees
 *    joint    theta    d      a     alpha
 *     1       j1       H      L1     0
 *     2       j2       0      L2     180
 *     3       0        j3     0      0
 *     4       j4       LT     0      0
 *
 *  so j3 > 0 moves the pen DOWN.
 */
const float L1 = 160.0, L2 = 140.0, H = 210.0, LT = 35.0;
const float RAD = PI / 180.0;
const float DEG = 180.0 / PI;

float j1, j2, j3, j4;        // joint values, deg / mm
float x, y, z, phi;          // pen pose, phi = direction of the x axis of frame 4 in deg

void forward() {
  float a1 = j1 * RAD;
  float a12 = (j1 + j2) * RAD;
  x = L1 * cosf(a1) + L2 * cosf(a12);
  y = L1 * sinf(a1) + L2 * sinf(a12);
  z = H - j3 - LT;
  phi = j1 + j2 - j4;
}

// e = +1 left-handed elbow (j2 > 0), e = -1 right-handed
bool inverse(float x, float y, float z, float phi, int e) {
  float c2 = (x * x + y * y - L1 * L1 - L2 * L2) / (2 * L1 * L2);
  if (fabs(c2) > 1.0) return false;
  float s2 = e * sqrtf(1 - c2 * c2);
  float k1 = L1 + L2 * c2;
  float k2 = L2 * s2;
  j2 = atan2f(s2, c2) * DEG;
  j1 = (atan2f(y, x) - atan2f(k2, k1)) * DEG;
  j3 = H + LT - z;
  j4 = j1 + j2 - phi;
  return true;
}

// Cartesian speed of the pen for joint speeds w1, w2 in rad/s
void speed(float w1, float w2, float &vx, float &vy) {
  float J11 = -L1 * sinf(j1 * RAD) - L2 * sinf((j1 + j2) * RAD);
  float J12 = -L2 * sinf((j1 + j2) * RAD);
  float J21 = L1 * cosf(j1 * RAD) + L2 * cosf((j1 + j2) * RAD);
  float J22 = L2 * cosf(j1 + j2);
  vx = J11 * w1 + J12 * w2;
  vy = J21 * w1 + J22 * w2;
}

// close to zero = arm (nearly) stretched or folded
float determinant() {
  return L1 * L2 * sinf(j2 * RAD);
}
