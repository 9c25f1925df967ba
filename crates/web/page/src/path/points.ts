// The way-points as they are edited. They outlive the panel, and end with the robot that they belong to.

import { effect, signal } from "@preact/signals";
import type { Matrix, Path, Point, Waypoint } from "../engine/types.ts";
import { engine, note, path, playing, pose, q, record, revision, robot, target, time, undoes } from "../state.ts";
import { Task } from "../task.tsx";

/** Where the path starts; the present joints when it is planned, if nothing was said. */
export const start = undoes(signal<number[] | null>(null));
export const points = undoes(signal<Waypoint[]>([]));
/** The point of an arc that is half described. */
export const via = signal<Point | null>(null);
export const duration = undoes(signal<number | null>(null));
/** Of the hand, m/s, where the robot has no limits of its joints. */
export const speed = undoes(signal(0.25));

export const planning = new Task<Path>();
/** What the path that is shown was planned from; another text means that it is out of date. */
export const plannedFrom = signal<string | null>(null);

const SAMPLES = 401;

/** Where the hand is wanted, or is. */
export function hand(): Matrix | null {
  return target.peek() ?? pose.peek();
}

/** All that a plan depends on, to be compared. */
export function wish(): string {
  return JSON.stringify([start.value, points.value, duration.value, speed.value]);
}

export function place(matrix: Matrix): Point {
  return [matrix[0]![3]!, matrix[1]![3]!, matrix[2]![3]!];
}

/** Adds a point, unless the way to it would have no length. */
export function add(point: Waypoint): boolean {
  const before = points.peek().at(-1) ?? (start.peek() ? { kind: "joint" as const, q: start.peek()! } : null);
  if (before && isSame(before, point)) {
    note("The arm is still where the path ends: move it, then add the point.");
    return false;
  }
  change([...points.value, point]);
  return true;
}

function isSame(before: Waypoint, point: Waypoint): boolean {
  if (point.kind === "arc") return false;
  if (point.kind === "joint") return before.kind === "joint" && before.q.every((x, k) => Math.abs(x - point.q[k]!) < 1e-9);
  const pose = before.kind === "joint" ? engine().now.call("scene", { q: before.q }).frames.at(-1) : before.pose;
  return pose !== undefined && pose.flat().every((x, k) => Math.abs(x - point.pose.flat()[k]!) < 1e-9);
}

export function put(index: number, point: Waypoint): void {
  change(points.value.map((old, k) => (k === index ? point : old)), `point ${index}`);
}

export function remove(index: number): void {
  change(points.value.filter((_, k) => k !== index));
}

/** Exchanges a point with the one before or behind it. */
export function shift(index: number, by: -1 | 1): void {
  const next = [...points.value];
  const other = index + by;
  if (!next[index] || !next[other]) return;
  [next[index], next[other]] = [next[other], next[index]];
  change(next);
}

/** Other points, which can be undone. */
function change(next: Waypoint[], of?: string): void {
  record(of);
  points.value = next;
}

export function setDuration(seconds: number | null): void {
  if (seconds === duration.peek()) return;
  record();
  duration.value = seconds;
}

export function setSpeed(next: number): void {
  record("speed of the hand");
  speed.value = next;
}

/** The path begins at the present joints. */
export function startHere(): void {
  record();
  start.value = q.peek();
}

export async function plan(from: number[] = start.peek() ?? q.peek()): Promise<void> {
  if (points.peek().length === 0) return;
  start.value = from;
  playing.value = false;
  const wanted = wish();
  const forRevision = revision.peek();
  const request = { start: from, points: points.peek(), duration: duration.peek() ?? undefined, speed: speed.peek(), samples: SAMPLES };
  const answer = await planning.start(() => engine().solver.call("path", request));
  if (!answer || forRevision !== revision.peek()) return;
  time.value = 0;
  path.value = answer;
  // The arm stands where the time is.
  if (answer.q[0]) q.value = answer.q[0];
  plannedFrom.value = wanted;
}

let joints = "";
effect(() => {
  const model = robot.value;
  if (!model) return;
  // Another table of the same kind keeps its points, another arm has no use for them.
  const now = model.joints.map((j) => j.kind).join(" ") + model.robot;
  if (now === joints) return;
  joints = now;
  start.value = null;
  points.value = [];
  via.value = null;
  planning.reset();
  plannedFrom.value = null;
});
