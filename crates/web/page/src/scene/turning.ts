// A joint taken with the pointer turns, or slides, along with it.

import type { Matrix, Scene } from "../engine/types.ts";
import { engine, highlighted, move, q, robot } from "../state.ts";
import { add, axisOf, cross, dot, nearestOnLine, originOf, sub } from "./geometry.ts";
import type { Drag } from "./gizmo.ts";
import type { Stage } from "./stage.ts";

type Symbol = Scene["symbols"][number];

/** How much a symbol's axis moves for a change of its variable: −1 where the table turns it round, 2 for a doubled one. */
function rate(joint: number, symbol: Symbol): number {
  const step = 1e-4;
  const now = q.peek();
  const then = now.map((x, k) => (k === joint ? x + step : x));
  const [before, after] = [now, then].map((at) => engine().now.call("scene", { q: at }).frames);
  const k = before.findIndex((frame, i) => differs(frame, after[i]));
  if (k < 0) return 1;
  if (symbol.kind === "P") {
    const moved = dot(sub(originOf(after[k]), originOf(before[k])), symbol.axis) / step;
    return Math.abs(moved) > 0.1 ? moved : 1;
  }
  // ω × e summed over the axes e of a frame is twice the turn.
  let turn = 0;
  for (const i of [0, 1, 2] as const) turn += dot(cross(axisOf(before[k], i), axisOf(after[k], i)), symbol.axis) / 2 / step;
  return Math.abs(turn) > 0.1 ? turn : 1;
}

function differs(a: Matrix, b: Matrix): boolean {
  return a.some((row, i) => row.some((x, j) => Math.abs(x - b[i][j]) > 1e-6));
}

/** How far, in pixels, the pointer goes for a radian: joints are small, and a hand is not that steady. */
const LEVER = 70;

/** How much a revolute joint turns for a way of the pointer from a place in the picture. */
function turnOf(stage: Stage, { axis, centre, radius }: Symbol): (x: number, y: number, dx: number, dy: number) => number {
  const { orbit } = stage;
  const facing = dot(axis, orbit.back);
  const middle = orbit.project(centre);
  // Seen from the side, what is in front of the axis goes this way.
  const ahead = orbit.project(add(centre, cross(axis, orbit.back), radius));
  const length = Math.max(1e-6, Math.hypot(ahead.x - middle.x, ahead.y - middle.y));
  const way = { x: (ahead.x - middle.x) / length, y: (ahead.y - middle.y) / length };
  return (x, y, dx, dy) => {
    const [rx, ry] = [x - middle.x, y - middle.y];
    const r = Math.hypot(rx, ry);
    // Seen from its end, round its middle; the page's second direction is down.
    if (Math.abs(facing) > 0.5 && r > 6) return (Math.sign(facing) * (ry * dx - rx * dy)) / r / Math.max(LEVER, r);
    return (dx * way.x + dy * way.y) / LEVER;
  };
}

export function takeJoint(stage: Stage, symbol: Symbol, x: number, y: number): Drag | null {
  const { joint, axis, centre, kind } = symbol;
  const model = robot.peek();
  if (joint === null || !model) return null;
  const { orbit } = stage;
  const first = q.peek();
  const ratio = rate(joint, symbol);
  const limits = model.joints[joint].limits;
  const turn = turnOf(stage, symbol);
  const start = nearestOnLine(orbit.ray(x, y), centre, axis);
  let [lastX, lastY, total] = [x, y, 0];
  highlighted.value = new Set([joint]);
  return {
    move: (nextX, nextY) => {
      if (kind === "P") total = nearestOnLine(orbit.ray(nextX, nextY), centre, axis) - start;
      else total += turn(lastX, lastY, nextX - lastX, nextY - lastY);
      [lastX, lastY] = [nextX, nextY];
      let value = first[joint] + total / ratio;
      if (limits) value = Math.min(Math.max(value, Math.min(limits[0], first[joint])), Math.max(limits[1], first[joint]));
      move(first.map((one, k) => (k === joint ? value : one)));
    },
    end: () => {
      highlighted.value = new Set();
    },
  };
}
