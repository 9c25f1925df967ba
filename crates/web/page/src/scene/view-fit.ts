// A view in which the whole arm is seen, with some room for it to move; with its workspace where that is shown.

import type { Point } from "../engine/types.ts";
import { look, robot, scene, workspace } from "../state.ts";
import { bounds } from "./body.ts";
import { add, between, originOf } from "./geometry.ts";
import { corners } from "./looks.ts";
import type { Stage } from "./stage.ts";

/** Pixels. */
const STRIP = 44;

export function fit(stage: Stage, isEased: boolean): void {
  const now = scene.peek();
  if (!now) return;
  const { centre, radius } = bounds(now, [now.ground.at, ...now.frames.map(originOf), ...corners()]);
  // An arm that is folded up will unfold.
  const room = Math.max(radius + 3 * now.unit, 0.45 * (robot.peek()?.reach ?? 0));
  let ball = { centre, radius: room };
  const space = workspace.peek();
  if (look.peek().workspace !== "none" && space) {
    const edge = space.boundary.flat().map(([u, v]) => add(add(space.origin, space.first, u), space.second, v));
    if (edge.length > 0) ball = about(edge, space.revolves && space.axis ? space.axis.at : null);
  }
  // The toolbar covers a strip at the bottom.
  const covered = Math.min(0.3, STRIP / stage.orbit.height);
  const distance = stage.orbit.distanceFor(ball.radius / (1 - covered));
  const target = add(ball.centre, stage.orbit.up, -covered * ball.radius);
  stage.orbit.go({ target, distance }, isEased ? stage.ease : 0);
  stage.viewChanged();
}

/** A ball about points; about those of a section that turns it stands on the axis. */
function about(points: Point[], axis: Point | null): { centre: Point; radius: number } {
  const low = ([0, 1, 2] as const).map((k) => Math.min(...points.map((p) => p[k])));
  const high = ([0, 1, 2] as const).map((k) => Math.max(...points.map((p) => p[k])));
  const [x, y, z] = low.map((a, k) => (a + high[k]) / 2);
  const centre: Point = axis ? [axis[0], axis[1], z] : [x, y, z];
  return { centre, radius: Math.max(...points.map((p) => between(p, centre))) };
}
