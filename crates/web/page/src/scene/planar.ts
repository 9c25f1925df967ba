// Arms whose links all move in parallel planes: what turns has one direction for all joints, and what slides is at a right
// angle to it. They are looked at along that direction, and get no handles that they could not follow.

import type { Point, Scene } from "../engine/types.ts";
import { cross, dot, norm } from "./geometry.ts";

const LEAST = 1e-6;

/** The direction about which all joints turn, if they share one. */
export function turnOf({ symbols }: Scene): Point | null {
  const turning = symbols.filter(({ kind }) => kind === "R").map(({ axis }) => axis);
  const [first] = turning;
  return first && turning.every((axis) => norm(cross(first, axis)) < LEAST) ? first : null;
}

/** The normal of the planes that all links keep to, if there is one. */
export function planeOf(now: Scene): Point | null {
  const normal = turnOf(now);
  const slides = now.symbols.filter(({ kind }) => kind === "P");
  return normal && slides.every(({ axis }) => Math.abs(dot(normal, axis)) < LEAST) ? normal : null;
}
