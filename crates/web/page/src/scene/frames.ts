// The frames of the table as axes with their names, the tool's frame, and the frame where the hand is wanted.

import type { Matrix, Scene } from "../engine/types.ts";
import { game } from "../game/game.ts";
import { look, playing, pose, scene, selected, target } from "../state.ts";
import { add, apart, axisOf, originOf, scale } from "./geometry.ts";
import { inBodies } from "./looks.ts";
import type { Label } from "./labels.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { colours, type Palette } from "./theme.ts";

const NAMES = ["x", "y", "z"] as const;

export interface Drawn {
  length: number;
  alpha: number;
  width: number;
}

/** Three axes of a frame. */
export function drawFrame(strokes: Strokes, frame: Matrix, palette: Palette, { length, alpha, width }: Drawn): void {
  const origin = originOf(frame);
  for (const k of [1, 0, 2] as const) {
    const reach = k === 1 ? 0.6 * length : length;
    strokes.line(origin, add(origin, axisOf(frame, k), reach), {
      colour: palette[NAMES[k]],
      width: k === 1 ? 0.75 * width : width,
      head: (k === 1 ? 3 : 4.2) * width,
      alpha: k === 1 ? 0.8 * alpha : alpha,
      through: inBodies.peek() ? 0.85 : 0.35,
    });
  }
}

/** The frames to be shown with their names; a tool where the last frame is has no name of its own. */
function named(now: Scene): { frame: Matrix; name: string; index: number }[] {
  const frames = now.frames.map((frame, index) => ({ frame, name: String(index), index }));
  const tool = frames.at(-1);
  const last = frames.at(-2);
  if (tool && last) {
    const { distance, angle } = apart(tool.frame, last.frame);
    if (distance < 1e-6 && angle < 1e-6) frames.pop();
    else tool.name = "tool";
  }
  return frames;
}

function draw(stage: Stage, strokes: Strokes, now: Scene, palette: Palette, row: number | null, hasLabels: boolean): void {
  const labels: Label[] = [];
  /** Axes that end at the same point have one label: `z_0,1`. */
  const ends = new Map<string, Label>();
  for (const { frame, name, index } of named(now)) {
    // Of a row that is explained only its two frames matter, and they are named by the row.
    const isOfRow = row !== null && (index === row || index === row + 1);
    const length = now.unit * (name === "tool" || index === 0 ? 2.9 : 2.4);
    drawFrame(strokes, frame, palette, { length, alpha: row === null ? 1 : isOfRow ? 0.9 : 0.12, width: isOfRow ? 2.6 : 2 });
    if (!hasLabels || row !== null) continue;
    const origin = originOf(frame);
    for (const k of [0, 2] as const) {
      const axis = axisOf(frame, k);
      const place = [...origin, ...axis].map((x) => Math.round(x * 1e5)).join() + NAMES[k];
      const there = ends.get(place);
      if (there) {
        there.text += `,${name}`;
        continue;
      }
      const label: Label = { text: `${NAMES[k]}_${name}`, at: add(origin, axis, length), toward: scale(axis, now.unit), colour: palette[NAMES[k]], size: 14, rank: k };
      ends.set(place, label);
      labels.push(label);
    }
  }
  stage.labels.set("frames", labels);
}

export function addFrames(stage: Stage): void {
  const strokes = new Strokes(10);
  stage.add(strokes.object);
  stage.onEnd(() => strokes.dispose());
  stage.watch(
    "frames",
    () => ({ now: scene.value, palette: colours.value, isShown: look.value.frames && game.value === null, row: selected.value, hasLabels: look.value.labels && !playing.value, isInside: inBodies.value }),
    ({ now, palette, isShown, row, hasLabels }) => {
      strokes.begin();
      if (now && isShown) draw(stage, strokes, now, palette, row, hasLabels);
      else stage.labels.set("frames", []);
      strokes.end();
    },
  );

  // Where the hand is wanted and cannot be: a frame there, and a line to the nearest that can.
  const wish = new Strokes(11);
  stage.add(wish.object);
  stage.onEnd(() => wish.dispose());
  stage.watch(
    "target",
    () => ({ now: scene.value, wanted: target.value, here: pose.value, palette: colours.value }),
    ({ now, wanted, here, palette }) => {
      wish.begin();
      const labels: Label[] = [];
      if (now && wanted && here) {
        const { distance, angle } = apart(wanted, here);
        if (distance > 0.02 * now.unit || angle > 0.01) {
          drawFrame(wish, wanted, palette, { length: 2.9 * now.unit, alpha: 0.85, width: 2 });
          wish.line(originOf(here), originOf(wanted), { colour: palette.obstacle, width: 2, dash: 5, through: 0.6 });
          labels.push({ text: "target", at: originOf(wanted), colour: palette.obstacle, size: 12, rank: 6 });
        }
      }
      stage.labels.set("target", labels);
      wish.end();
    },
  );
}
