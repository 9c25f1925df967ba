// Points, directions and poses as plain arrays: what the engine speaks, in metres and in the base frame.

import type { Matrix, Point } from "../engine/types.ts";

export const TURN = 2 * Math.PI;

/** a + s b */
export const add = (a: Point, b: Point, s = 1): Point => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const sub = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Point, s: number): Point => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const norm = (a: Point): number => Math.sqrt(dot(a, a));
export const between = (a: Point, b: Point): number => norm(sub(a, b));
export const middle = (a: Point, b: Point): Point => scale(add(a, b), 0.5);

/** The direction of a vector; `otherwise` where it has none. */
export function unit(a: Point, otherwise: Point = [0, 0, 1]): Point {
  const length = norm(a);
  return length > 1e-12 ? scale(a, 1 / length) : otherwise;
}

/** A direction at a right angle to a unit vector. */
export function perpendicular(axis: Point): Point {
  return unit(cross(Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], axis));
}

/** A vector turned about a unit axis (Rodrigues). */
export function turned(v: Point, axis: Point, angle: number): Point {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return add(add(scale(v, c), cross(axis, v), s), axis, (1 - c) * dot(axis, v));
}

export const originOf = (pose: Matrix): Point => [pose[0][3], pose[1][3], pose[2][3]];
/** A column of the rotation: 0 for x, 1 for y, 2 for z. */
export const axisOf = (pose: Matrix, k: 0 | 1 | 2): Point => [pose[0][k], pose[1][k], pose[2][k]];

/** The pose with these axes at this point. */
export function poseOf(x: Point, y: Point, z: Point, at: Point): Matrix {
  return [
    [x[0], y[0], z[0], at[0]],
    [x[1], y[1], z[1], at[1]],
    [x[2], y[2], z[2], at[2]],
    [0, 0, 0, 1],
  ];
}

/** A pose turned about an axis through its own origin, the axis given in the base; then moved. */
export function movedPose(pose: Matrix, axis: Point, angle: number, by: Point): Matrix {
  const [x, y, z] = ([0, 1, 2] as const).map((k) => turned(axisOf(pose, k), axis, angle));
  return poseOf(x, y, z, add(originOf(pose), by));
}

/** How far two poses are apart: metres, radians. */
export function apart(a: Matrix, b: Matrix): { distance: number; angle: number } {
  let trace = 0;
  for (let i = 0; i < 3; i++) for (let k = 0; k < 3; k++) trace += a[i][k] * b[i][k];
  const angle = Math.acos(Math.min(1, Math.max(-1, (trace - 1) / 2)));
  return { distance: between(originOf(a), originOf(b)), angle };
}

export interface Ray {
  from: Point;
  /** Of length 1. */
  along: Point;
}

/** The parameter along the line `at + t axis` of its point nearest to a ray. */
export function nearestOnLine(ray: Ray, at: Point, axis: Point): number {
  const w = sub(at, ray.from);
  const b = dot(axis, ray.along);
  const denominator = 1 - b * b;
  // Seen end on, a line has no nearest point that would help.
  if (denominator < 1e-4) return 0;
  return (b * dot(ray.along, w) - dot(axis, w)) / denominator;
}

/** Where a ray meets a plane; nothing where they are all but parallel. */
export function onPlane(ray: Ray, at: Point, normal: Point): Point | null {
  const b = dot(ray.along, normal);
  if (Math.abs(b) < 1e-3) return null;
  return add(ray.from, ray.along, dot(sub(at, ray.from), normal) / b);
}

/** How near a ray comes to a segment, and how far along the ray. */
export function rayToSegment(ray: Ray, a: Point, b: Point): { distance: number; along: number } {
  const v = sub(b, a);
  const length = norm(v);
  let t = length > 1e-12 ? nearestOnLine(ray, a, scale(v, 1 / length)) : 0;
  t = Math.min(length, Math.max(0, t));
  const point = length > 1e-12 ? add(a, v, t / length) : a;
  const along = Math.max(0, dot(sub(point, ray.from), ray.along));
  return { distance: between(point, add(ray.from, ray.along, along)), along };
}

/** Joints between two configurations. */
export function mixed(a: number[], b: number[], t: number): number[] {
  return a.map((x, i) => x + t * (b[i] - x));
}
