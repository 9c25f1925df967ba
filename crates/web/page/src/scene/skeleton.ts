// The skeleton of a table: along each axis its offset, along each common normal its length, from step to step. It is drawn over
// the bodies of a robot, which show none of it.

import type { Scene } from "../engine/types.ts";
import { robot, scene, selected } from "../state.ts";
import { isTurn } from "../steps/walk.ts";
import { add, axisOf, originOf, scale } from "./geometry.ts";
import { inBodies } from "./looks.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { colours, type Palette } from "./theme.ts";

/** The symbols of joints where the table has them, and not where a drawing would have room for them. */
export function symbolsOnTable(now: Scene): Scene["symbols"] {
  const joints = robot.peek()?.joints;
  return now.symbols.map((symbol) => {
    const row = symbol.joint === null ? undefined : joints?.[symbol.joint]?.row;
    const moving = row === undefined ? undefined : now.rows[row]?.find((step) => (symbol.kind === "R" ? step.letter === "theta" : step.axis === "z" && !isTurn(step)));
    return moving ? { ...symbol, centre: originOf(moving.frame) } : symbol;
  });
}

function draw(strokes: Strokes, now: Scene, palette: Palette): void {
  for (const step of now.rows.flat()) {
    if (isTurn(step)) continue;
    const from = originOf(step.frame);
    const isAlongX = step.axis === "x";
    const to = add(from, axisOf(step.frame, isAlongX ? 0 : 2), step.value);
    strokes.line(from, to, { colour: isAlongX ? palette.a : palette.d, width: 3.2, through: 0.95 });
  }
  // The axes of the joints, farther than their frames.
  for (const { axis, centre, half, radius } of symbolsOnTable(now)) {
    const long = scale(axis, half + 1.2 * radius);
    strokes.line(add(centre, long, -1), add(centre, long), { colour: palette.normal, width: 1.25, dash: 5, through: 0.8 });
  }
}

export function addSkeleton(stage: Stage): void {
  const strokes = new Strokes(9);
  stage.add(strokes.object);
  stage.onEnd(() => strokes.dispose());
  stage.watch(
    "skeleton",
    () => ({ now: inBodies.value && selected.value === null ? scene.value : null, palette: colours.value }),
    ({ now, palette }) => {
      strokes.begin();
      if (now) draw(strokes, now, palette);
      strokes.end();
    },
  );
}
