// From where an arm is looked at first.

import type { Scene } from "../engine/types.ts";
import { FACES } from "./orbit.ts";
import { planeOf } from "./planar.ts";

/** Where to look from at first: an arm that keeps to a plane is seen at a right angle to it. */
export function firstLook(now: Scene): { azimuth: number; elevation: number } {
  const normal = planeOf(now);
  if (normal && Math.abs(normal[2]) > 0.99) return { azimuth: FACES.top[0], elevation: FACES.top[1] };
  // A plane that stands is seen from its front, where x goes to the right.
  if (normal && Math.abs(normal[2]) < 0.01) {
    const side = normal[1] > 1e-9 || (Math.abs(normal[1]) <= 1e-9 && normal[0] < 0) ? -1 : 1;
    return { azimuth: Math.atan2(side * normal[1], side * normal[0]), elevation: 0 };
  }
  return { azimuth: FACES.corner[0], elevation: FACES.corner[1] };
}
