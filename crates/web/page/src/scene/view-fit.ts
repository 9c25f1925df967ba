// A view in which the whole arm is seen, with some room for it to move; with its workspace where that is shown.

import type { Point, Scene } from "../engine/types.ts";
import { standing } from "../beside/beside.ts";
import { look, robot, scene, selected, workspace } from "../state.ts";
import { floorOf } from "./arm.ts";
import { bounds } from "./body.ts";
import { add, axisOf, cross, originOf, perpendicular, scale, turned, unit } from "./geometry.ts";
import { corners } from "./looks.ts";
import type { Stage } from "./stage.ts";

/** What stands over the edges of the picture, pixels: labels above, the tool bar below. */
const EDGES = { top: 40, right: 30, bottom: 56, left: 30 };
/** Where a row is explained its card stands to the left, if there is room for both. */
const CARD = 258;
const ROOM = 700;
/** In a small picture the edges take no more of it than this, and that of the tool bar so much. */
const MOST = 0.14;
const MOST_BELOW = 0.24;

export function fit(stage: Stage, isEased: boolean): void {
  const now = scene.peek();
  if (!now) return;
  stage.orbit.frame(wanted(now), edgesOf(stage.orbit), isEased ? stage.ease : 0);
  stage.viewChanged();
}

function edgesOf({ width, height }: { width: number; height: number }): typeof EDGES {
  const { top, right, bottom, left } = EDGES;
  return { top: Math.min(top, MOST * height), right: Math.min(right, MOST * width), bottom: Math.min(bottom, MOST_BELOW * height), left: selected.peek() !== null && width >= ROOM ? CARD : Math.min(left, MOST * width) };
}

/** The points that have to be seen. */
function wanted(now: Scene): Point[] {
  const space = workspace.peek();
  if (look.peek().workspace !== "none" && space) {
    const edge = space.boundary.flat().map(([u, v]) => add(add(space.origin, space.first, u), space.second, v));
    const { axis } = space;
    if (edge.length > 0) return space.revolves && axis ? edge.flatMap((p) => round(p, axis)) : edge;
  }
  const axes = now.frames.flatMap((frame) => ([0, 2] as const).map((k) => add(originOf(frame), axisOf(frame, k), 3 * now.unit)));
  const beside = standing.peek().flatMap(({ scene: other }) => [...plateOf(other), ...partsOf(other)]);
  const points = [...beside, ...plateOf(now), ...now.frames.map(originOf), ...axes, ...corners(), ...partsOf(now)];
  // An arm that is folded up will unfold.
  const { centre, radius } = bounds(now, points);
  const room = 0.36 * (robot.peek()?.reach ?? 0);
  return radius < room ? [...points, ...ball(centre, room)] : points;
}

/** The ends of its links, joints as thick as they are, and both fingers. */
function partsOf({ bars, symbols, gripper, unit: size }: Scene): Point[] {
  const joints = symbols.flatMap(({ centre, axis, half, radius }) => {
    const [u, v] = [perpendicular(axis), cross(axis, perpendicular(axis))];
    const edge = [u, v].flatMap((side) => [-radius, radius].map((by) => add(centre, side, by)));
    return edge.flatMap((p) => [add(p, axis, -half), add(p, axis, half)]);
  });
  const tip = add(gripper.at, gripper.along, 1.5 * size);
  return [...joints, ...bars.flatMap(({ from, to }) => [from, to]), add(tip, gripper.across, 0.85 * size), add(tip, gripper.across, -0.85 * size)];
}

/** The edge of what the arm stands on, down to the floor. */
function plateOf(now: Scene): Point[] {
  const { at, up } = now.ground;
  const edge = round(add(at, perpendicular(unit(up)), 2 * now.unit), { at, along: up });
  const floorAt = floorOf(now, robot.peek()?.reach ?? 1);
  return up[2] > 0.7 ? [...edge, ...edge.map(([x, y]): Point => [x, y, floorAt])] : edge;
}

/** A point turned about an axis. */
function round(p: Point, { at, along }: { at: Point; along: Point }): Point[] {
  const axis = unit(along);
  return Array.from({ length: 12 }, (_, k) => add(at, turned(add(p, at, -1), axis, (k * Math.PI) / 6)));
}

function ball(centre: Point, radius: number): Point[] {
  return ([0, 1, 2] as const).flatMap((k) => [-1, 1].map((sign): Point => add(centre, scale([+(k === 0), +(k === 1), +(k === 2)], sign * radius))));
}
