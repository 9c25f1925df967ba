// What is right when frames are placed by hand. A row of the table joins two frames only if the one's x meets the other's z at a
// right angle: with the standard convention x of the frame behind and z of that before, with the modified ones x of the
// frame before and z of that behind (Denavit and Hartenberg 1955; Craig, 3.4; Khalil and Dombre, 3.2). And z lies on the axis of the joint.
// Of a slide only the direction counts. All else is free, so that most questions have several right answers.

import type { Convention, JointKind, Matrix, Point } from "../engine/types.ts";
import { add, axisOf, between, cross, dot, norm, originOf, perpendicular, scale, sub, unit } from "../scene/geometry.ts";

export interface Axis {
  at: Point;
  along: Point;
  kind: JointKind;
}

export interface Placed {
  origin: Point;
  z: Point;
  x: Point;
}

/** An arm as it stands: the axes of its joints, and the frames of its own table. */
export interface Arm {
  convention: Convention;
  axes: Axis[];
  frames: Placed[];
  /** What counts as no distance, metres. */
  least: number;
}

/** What is to be said of an answer. */
export interface Verdict {
  right: boolean;
  words: string;
}

const LEAST_ANGLE = 1e-5;

export function armOf(convention: Convention, frames: Matrix[], kinds: JointKind[], reach: number): Arm {
  const own = frames.map((frame): Placed => ({ origin: originOf(frame), z: axisOf(frame, 2), x: axisOf(frame, 0) }));
  // A row turns about z of the frame before it, or of its own.
  const first = convention === "standard" ? 0 : 1;
  const axes = kinds.map((kind, k): Axis => ({ at: own[k + first].origin, along: own[k + first].z, kind }));
  return { convention, axes, frames: own, least: 1e-5 * Math.max(reach, 1e-3) };
}

const isParallel = (a: Point, b: Point): boolean => norm(cross(a, b)) < LEAST_ANGLE;
const isSquare = (a: Point, b: Point): boolean => Math.abs(dot(a, b)) < LEAST_ANGLE;
/** The point of a line that is nearest to another. */
const foot = (p: Point, { at, along }: Pick<Axis, "at" | "along">): Point => add(at, along, dot(sub(p, at), along));

/** Where the common normal of two lines meets the second; nothing where they are parallel. */
function normalFoot(a: Pick<Axis, "at" | "along">, b: Pick<Axis, "at" | "along">): Point | null {
  const c = dot(a.along, b.along);
  const square = 1 - c * c;
  if (square < LEAST_ANGLE ** 2) return null;
  const w = sub(b.at, a.at);
  return add(b.at, b.along, (c * dot(w, a.along) - dot(w, b.along)) / square);
}

/** How far two lines are apart. */
function apart(a: Pick<Axis, "at" | "along">, b: Pick<Axis, "at" | "along">): number {
  const normal = cross(a.along, b.along);
  if (norm(normal) < LEAST_ANGLE) return between(b.at, foot(b.at, a));
  return Math.abs(dot(sub(b.at, a.at), unit(normal)));
}

const zLine = ({ origin, z }: Placed): Pick<Axis, "at" | "along"> => ({ at: origin, along: z });
const xLine = (origin: Point, x: Point): Pick<Axis, "at" | "along"> => ({ at: origin, along: x });

/** The axis (from 0) on which z of a frame (from 1) lies; nothing of the last frame of a standard table. */
export function axisIndex({ convention, axes }: Arm, frame: number): number | null {
  const index = convention === "standard" ? frame : frame - 1;
  return index < axes.length ? index : null;
}

const joint = (index: number): string => `joint ${index + 1}`;

/** The two axes whose common normal carries x of a frame: the line before and the one that z lies on, or that and the next. */
function pair(arm: Arm, frame: number, before: Placed, own: Pick<Axis, "at" | "along">): { other: Pick<Axis, "at" | "along"> | null; words: string } {
  const index = axisIndex(arm, frame);
  if (arm.convention === "standard") return { other: zLine(before), words: `the axes of ${joint(frame - 1)} and ${index === null ? "the hand" : joint(index)}` };
  const next = arm.axes[frame];
  // A slide behind can be anywhere in its direction.
  if (!next) return { other: null, words: "" };
  const words = `the axes of ${joint(frame - 1)} and ${joint(frame)}`;
  return { other: next.kind === "P" ? { at: own.at, along: next.along } : next, words };
}

export function judgeOrigin(arm: Arm, frame: number, before: Placed, p: Point): Verdict {
  const index = axisIndex(arm, frame);
  if (index === null) return { right: true, words: "Right: the last frame may stand anywhere; most put it at the hand." };
  const axis = arm.axes[index];
  const own = axis.kind === "P" ? { at: p, along: axis.along } : axis;
  if (axis.kind === "R" && between(p, foot(p, axis)) > arm.least) {
    return { right: false, words: `z${frame} lies on the axis of ${joint(index)}, and so does its origin: this point is not on it.` };
  }
  if (arm.convention !== "standard" && apart(xLine(before.origin, before.x), own) > arm.least) {
    return { right: false, words: `z${frame} has to meet x${frame - 1}: through this point it does not.` };
  }
  const { other, words } = pair(arm, frame, before, own);
  if (!other) return { right: true, words: "Right: behind the last joint any place on its axis will do." };
  const at = normalFoot(other, own);
  if (!at) return { right: true, words: `Right: ${words} are parallel, any place on it would do.` };
  const doMeet = apart(other, own) < arm.least;
  if (between(at, p) <= arm.least) return { right: true, words: doMeet ? `Right: there ${words} meet.` : `Right: there the common normal of ${words} ends.` };
  return { right: false, words: doMeet ? `Look where ${words} meet: there it has to stand.` : `Look for the common normal of ${words}: the origin stands where it ends on that of z${frame}.` };
}

/** An origin that is right there. */
export function someOrigin(arm: Arm, frame: number, before: Placed): Point {
  const index = axisIndex(arm, frame);
  if (index === null) return arm.frames[frame].origin;
  const axis = arm.axes[index];
  const own = axis.kind === "P" ? { at: before.origin, along: axis.along } : axis;
  const { other } = pair(arm, frame, before, own);
  return (other && normalFoot(other, own)) ?? foot(before.origin, own);
}

/** The direction that x has to have where the last frame of a standard table is off the axis before it. */
function outward(before: Placed, origin: Point, least: number): Point | null {
  const away = sub(origin, foot(origin, zLine(before)));
  return norm(away) > least ? unit(away) : null;
}

export function judgeZ(arm: Arm, frame: number, before: Placed, origin: Point, z: Point): Verdict {
  const index = axisIndex(arm, frame);
  if (index === null) {
    const x = outward(before, origin, arm.least);
    if (x && !isSquare(x, z)) return { right: false, words: `x${frame} has to go from z${frame - 1} to the origin, and z${frame} stands at a right angle to that.` };
    return { right: true, words: "Right: of the last frame most let z go the way of the hand." };
  }
  if (!isParallel(arm.axes[index].along, z)) return { right: false, words: `z${frame} goes along the axis of ${joint(index)}, ${arm.axes[index].kind === "R" ? "about which that joint turns" : "along which it slides"}.` };
  return { right: true, words: "Right; the opposite direction would be, too." };
}

export function judgeX(arm: Arm, frame: number, before: Placed, { origin, z }: Pick<Placed, "origin" | "z">, x: Point): Verdict {
  if (!isSquare(x, z)) return { right: false, words: `x${frame} stands at a right angle to z${frame}: this one does not.` };
  const standard = arm.convention === "standard";
  const other = standard ? zLine(before) : arm.axes[frame];
  if (!other) return { right: true, words: `Right: behind the last joint any x${frame} at a right angle to z${frame} will do.` };
  const name = standard ? `z${frame - 1}` : `the axis of ${joint(frame)}`;
  if (!isSquare(x, other.along)) return { right: false, words: `x${frame} has to stand at a right angle to ${name} as well.` };
  const isSlide = !standard && arm.axes[frame].kind === "P";
  if (!isSlide && apart(other, xLine(origin, x)) > arm.least) return { right: false, words: `x${frame} has to meet ${name}: it lies on the common normal.` };
  return { right: true, words: "Right; the opposite direction would be, too." };
}

/** An x that is right there. */
export function someX(arm: Arm, frame: number, before: Placed, { origin, z }: Pick<Placed, "origin" | "z">): Point {
  const standard = arm.convention === "standard";
  const other = standard ? zLine(before) : arm.axes[frame];
  const free = (): Point => {
    const square = sub(before.x, scale(z, dot(before.x, z)));
    return norm(square) > 0.1 ? unit(square) : perpendicular(z);
  };
  if (!other) return free();
  const isSlide = !standard && arm.axes[frame].kind === "P";
  const way = sub(foot(origin, other), origin);
  if (!isSlide && norm(way) > arm.least) return scale(unit(way), standard ? -1 : 1);
  const normal = cross(other.along, z);
  return norm(normal) > LEAST_ANGLE ? unit(normal) : free();
}

/** The parameters of a row between two frames: θ, d, a, α in the order of the standard convention, radians and metres. */
export function parameters(convention: Convention, before: Placed, after: Placed): { theta: number; d: number; a: number; alpha: number } {
  const angle = (from: Point, to: Point, about: Point) => Math.atan2(dot(cross(from, to), about), dot(from, to));
  const way = sub(after.origin, before.origin);
  const [z, x] = convention === "standard" ? [before.z, after.x] : [after.z, before.x];
  return { theta: angle(before.x, after.x, z), d: dot(way, z), a: dot(way, x), alpha: angle(before.z, after.z, x) };
}
