// The way of the hand: a line with a few frames on it, marks where something happens, and where the hand is now.

import type { Path } from "../engine/types.ts";
import { look, path, playing, scene, time } from "../state.ts";
import { drawFrame } from "./frames.ts";
import { originOf } from "./geometry.ts";
import type { Label } from "./labels.ts";
import { Solids } from "./solids.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { colours, type Palette } from "./theme.ts";

const FRAMES = 10;
/** As many pieces as are seen. */
const PIECES = 240;

function nearestSample(along: Path, seconds: number): number {
  const k = along.t.findIndex((t) => t >= seconds);
  return k < 0 ? along.t.length - 1 : k;
}

function draw(stage: Stage, strokes: Strokes, marks: Solids, along: Path, size: number, palette: Palette, hasLabels: boolean): void {
  const points = along.pose.map(originOf);
  const step = Math.max(1, Math.ceil(points.length / PIECES));
  const line = points.filter((_, k) => k % step === 0 || k === points.length - 1);
  strokes.chain(line, { colour: palette.path, width: 3, through: 0.45 });
  for (let k = 0; k <= FRAMES; k++) {
    const pose = along.pose[Math.round((k * (along.pose.length - 1)) / FRAMES)];
    drawFrame(strokes, pose, palette, { length: 1.1 * size, alpha: 0.7, width: 1.5 });
  }
  const labels: Label[] = [];
  const mark = (k: number, words: string, colour: Palette["path"], rank: number, radius = 0.32) => {
    marks.ball(points[k], radius * size, [colour, 0.4]);
    if (hasLabels && words) labels.push({ text: words, at: points[k], colour, size: 12, plate: true, rank });
  };
  mark(0, "start", palette.path, 8);
  mark(points.length - 1, along.reached < 1 ? "as far as it goes" : "end", palette.path, 8);
  for (const event of along.events) {
    const colour = event.kind === "singular" ? palette.singular : event.kind === "limit" ? palette.obstacle : palette.quiet;
    mark(nearestSample(along, event.t), event.words.length > 44 ? event.kind : event.words, colour, 9, 0.26);
  }
  stage.labels.set("path", labels);
}

export function addPath(stage: Stage): void {
  const strokes = new Strokes(12, false, 512);
  const marks = new Solids(["matte"], 2, ["ball"]);
  const now = new Solids(["matte"], 2, ["ball"], 1);
  for (const one of [strokes, marks, now]) {
    stage.add(one.object);
    stage.onEnd(() => one.dispose());
  }
  const shown = () => (look.value.path && path.value && path.value.pose.length > 1 ? path.value : null);
  // The line does not change while it is played.
  stage.watch(
    "path",
    () => ({ along: shown(), size: scene.peek()?.unit ?? 0.05, palette: colours.value, hasLabels: look.value.labels && !playing.value }),
    ({ along, size, palette, hasLabels }) => {
      strokes.begin();
      marks.begin();
      stage.labels.set("path", []);
      if (along) draw(stage, strokes, marks, along, size, palette, hasLabels);
      strokes.end();
      marks.end();
    },
  );
  stage.watch(
    "path now",
    () => ({ along: shown(), seconds: time.value, size: scene.peek()?.unit ?? 0.05, palette: colours.value }),
    ({ along, seconds, size, palette }) => {
      now.begin();
      if (along) now.ball(originOf(along.pose[nearestSample(along, seconds)]), 0.36 * size, [palette.glow, 0.7]);
      now.end();
    },
  );
}
