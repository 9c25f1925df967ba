// What a formula stands for, drawn: the vector, the axis along which it is measured, and its component there.

import type { Scene } from "../engine/types.ts";
import { drawFrame } from "../scene/frames.ts";
import { add, axisOf, dot, originOf, scale, sub } from "../scene/geometry.ts";
import type { Stage } from "../scene/stage.ts";
import { Strokes } from "../scene/strokes.ts";
import { colours, type Palette } from "../scene/theme.ts";
import { scene } from "../state.ts";
import { type Meaning, meant } from "./meaning.ts";

function draw(strokes: Strokes, { frame, axis, of }: Meaning, now: Scene, palette: Palette): void {
  const [first, last] = [now.frames[frame], now.frames[now.rows.length]];
  if (!first || !last) return;
  const along = axisOf(first, axis);
  const colour = [palette.x, palette.y, palette.z][axis];
  // A direction is drawn where it is measured, and as long as the arm's joints are large.
  const from = originOf(first);
  const way = of === "origin" ? sub(originOf(last), from) : scale(axisOf(last, of), 6 * now.unit);
  const end = add(from, way);
  const foot = add(from, along, dot(way, along));
  drawFrame(strokes, first, palette, { length: 3 * now.unit, alpha: 0.9, width: 2.4 });
  drawFrame(strokes, last, palette, { length: 3 * now.unit, alpha: 0.9, width: 2.4 });
  strokes.line(from, end, { colour: palette.now, width: 3, head: 14, through: 0.8 });
  strokes.line(foot, end, { colour: palette.normal, width: 1.5, dash: 4, through: 0.8 });
  strokes.line(from, foot, { colour, width: 6, head: 16, through: 0.9 });
}

export function addMeaning(stage: Stage): void {
  const strokes = new Strokes(22, false, 64);
  stage.add(strokes.object);
  stage.onEnd(() => strokes.dispose());
  stage.watch("meaning", () => ({ now: scene.value, what: meant.value, palette: colours.value }), ({ now, what, palette }) => {
    strokes.begin();
    if (now && what) draw(strokes, what, now, palette);
    strokes.end();
  });
}
