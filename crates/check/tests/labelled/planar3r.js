// planar3r.js - demo arm on the landing page (canvas), three revolute joints in the plane
//
// const DH = [               // standard DH, a/alpha/d/theta
//   { a: L1, alpha: 0, d: 0, theta: q1 },
//   { a: L2, alpha: 0, d: 0, theta: q2 },
//   { a: L3, alpha: 0, d: 0, theta: q3 },
// ];

const { sin, cos, atan2, sqrt, acos } = Math;

export function forward(q1, q2, q3, { L1, L2, L3 }) {
  const a = q1, b = q1 + q2, c = q1 + q2 + q3;
  return {
    x: L1 * cos(a) + L2 * cos(b) + L3 * cos(c),
    y: L1 * sin(a) + L2 * sin(b) + L3 * sin(c),
    phi: c,
  };
}

// elbow: +1 -> q2 in (0, pi), -1 -> q2 in (-pi, 0)
export function inverse({ x, y, phi }, elbow, { L1, L2, L3 }) {
  const wx = x - L3 * cos(phi);
  const wy = y - L3 * sin(phi);
  const r2 = wx * wx + wy * wy;
  const cosB = (r2 - L1 * L1 - L2 * L2) / (2 * L1 * L2);
  if (Math.abs(cosB) > 1) return null;           // out of reach
  const q2 = elbow * acos(cosB);
  const q1 = atan2(wy, wx) - atan2(L2 * sin(q2), L1 + L2 * cos(q2));
  const q3 = phi - q1 + q2;
  return [q1, q2, q3];
}

// rows: x, y, phi
export function jacobian(q1, q2, q3, { L1, L2, L3 }) {
  const a = q1, b = q1 + q2, c = q1 + q2 + q3;
  return [
    [-L1 * sin(a) - L2 * sin(b) - L3 * sin(c), -L2 * sin(b) - L3 * sin(c), -L3 * sin(c)],
    [ L1 * cos(a) + L2 * cos(b) + L3 * cos(c),  L2 * cos(b) + L3 * cos(c),  L3 * cos(c)],
    [1, 1, 1]];
}

// the third link drops out
export const detJ = (q2, { L1, L2 }) => L1 * L2 * sin(q2);

// joint torques that produce the force (fx, fy) and the moment m at the tip
export function torques(q1, q2, q3, { L1, L2, L3 }, { fx, fy, m }) {
  const a = q1, b = q1 + q2, c = q1 + q2 + q3;
  const t3 = L3 * (cos(c) * fy - sin(c) * fx) + m;
  const t2 = t3 + L2 * (cos(a) * fy - sin(a) * fx);
  const t1 = t2 + L1 * (cos(a) * fy - sin(a) * fx);
  return [t1, t2, t3];
}
