// How the hand can move from where it is: the ellipsoid of its velocities, the directions that it has lost, and the joints
// that move while it stands still; all at first: whether it goes on so, the solver's families tell. All by singular values of the Jacobian at the tool in base axes (Yoshikawa 1985); slides
// count with the arm's reach, so that all joint rates are alike, and lengths by the reach where they stand beside angles.

import { computed } from "@preact/signals";
import type { Point } from "../engine/types.ts";
import { dot, norm, scale, unit } from "../scene/geometry.ts";
import { planeOf } from "../scene/planar.ts";
import { engine, q, robot, scene } from "../state.ts";
import { eigen, gram, transposed } from "./eigen.ts";

/** Singular values below this share of a radian a second are none but for rounding: they are roots of computed numbers. */
const NONE = 2e-7;
/** Below this a direction is nearly lost. */
const NEAR = 0.02;

/** A motion that the hand has lost: along a line, about one, or what does not obey an equation between both. */
export interface Lost {
  kind: "along" | "about" | "both";
  direction: Point;
  /** Of velocities (m/s) and rates (rad/s): the sum of all that is possible is 0. The largest is 1. */
  equation: number[];
  isExact: boolean;
}

export interface Mobility {
  /** The half axes of the ellipsoid: m/s for joint rates whose squares add up to 1 (rad/s)². The longest first. */
  axes: { length: number; direction: Point }[];
  lost: Lost[];
  /** Joint rates that leave the hand where it is, the largest ±1; several where there are several ways. */
  still: number[][];
}

/** The first entry that is something is positive: a direction and its opposite are one. */
function forward<T extends number[]>(v: T): T {
  return ((v.find((x) => Math.abs(x) > 1e-6) ?? 1) < 0 ? v.map((x) => -x || 0) : v) as T;
}

/** Of the point alone: what an arm in a plane never does is not lost. */
function lostOfPoint(point: number[][], count: number, normal: Point | null): Lost[] {
  if (count < (normal ? 2 : 3)) return [];
  const found = eigen(gram(point)).filter(({ vector }) => !normal || Math.abs(dot(normal, vector as Point)) < 0.5);
  return found
    .filter(({ value }) => Math.sqrt(Math.max(0, value)) < NEAR)
    .map(({ value, vector }) => ({ kind: "along", direction: forward(vector as Point), equation: [...vector, 0, 0, 0], isExact: Math.sqrt(Math.max(0, value)) < NONE }));
}

function lostOfHand(whole: number[][], reach: number): Lost[] {
  return eigen(gram(whole)).flatMap(({ value, vector }): Lost[] => {
    const size = Math.sqrt(Math.max(0, value));
    if (size >= NEAR) return [];
    const [along, about] = [vector.slice(0, 3) as Point, vector.slice(3) as Point];
    const [a, b] = [norm(along), norm(about)];
    const kind = b < 0.01 ? "along" : a < 0.01 ? "about" : "both";
    const equation = vector.map((x, k) => (k < 3 ? x / reach : x));
    const most = Math.max(...equation.map(Math.abs));
    return [{ kind, direction: forward(unit(kind === "about" ? about : along)), equation: forward(equation.map((x) => x / most)), isExact: size < NONE }];
  });
}

export const mobility = computed<Mobility | null>(() => {
  const [model, now] = [robot.value, scene.value];
  if (!model || !now || model.joints.length === 0) return null;
  const reach = Math.max(1e-9, model.reach);
  const { jacobian } = engine().now.call("jacobian", { q: q.value, frame: "base" });
  const rates = jacobian.map((row) => row.map((x, k) => (model.joints[k].kind === "P" ? x * reach : x)));
  const [point, turn] = [rates.slice(0, 3), rates.slice(3, 6)];
  const byReach = point.map((row) => row.map((x) => x / reach));
  const whole = [...byReach, ...turn];
  const axes = eigen(gram(point))
    .reverse()
    .map(({ value, vector }) => ({ length: Math.sqrt(Math.max(0, value)), direction: forward(vector as Point) }));
  const still = eigen(gram(transposed(whole)))
    .filter(({ value }) => Math.sqrt(Math.max(0, value)) < NONE)
    .map(({ vector }) => {
      // A slide's rate is in metres a second again.
      const rate = vector.map((x, k) => (model.joints[k].kind === "P" ? x * reach : x));
      const most = Math.max(...rate.map(Math.abs));
      return forward(rate.map((x) => x / most));
    });
  const lost = model.joints.length >= 6 ? lostOfHand(whole, reach) : lostOfPoint(byReach, model.joints.length, planeOf(now));
  return { axes, lost, still };
});

/** The ellipsoid is drawn so many seconds large: about as large as the arm. */
const SECONDS = 0.3;

/** The half axes as they are drawn, metres. */
export function drawn({ axes }: Mobility): Point[] {
  return axes.map(({ length, direction }) => scale(direction, SECONDS * length));
}
