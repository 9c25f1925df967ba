// The ellipsoid of velocities about the hand, its axes, and the directions that the hand has lost.

import type { Point, Scene } from "../engine/types.ts";
import { add, originOf, perpendicular, scale } from "../scene/geometry.ts";
import type { Label } from "../scene/labels.ts";
import type { Stage } from "../scene/stage.ts";
import { Strokes } from "../scene/strokes.ts";
import { colours, type Palette } from "../scene/theme.ts";
import { look, playing, pose, scene } from "../state.ts";
import { short } from "../units.ts";
import { drawn, type Mobility, mobility } from "./mobility.ts";

const PIECES = 48;

function ellipsoid(strokes: Strokes, at: Point, axes: Point[], palette: Palette): void {
  for (const [u, v] of [[0, 1], [0, 2], [1, 2]]) {
    const points = Array.from({ length: PIECES + 1 }, (_, k) => {
      const angle = (2 * Math.PI * k) / PIECES;
      return add(add(at, axes[u], Math.cos(angle)), axes[v], Math.sin(angle));
    });
    strokes.chain(points, { colour: palette.velocity, width: 2, alpha: 0.9, through: 0.6 });
  }
  for (const axis of axes) strokes.line(add(at, axis, -1), add(at, axis), { colour: palette.velocity, width: 1.25, dash: 4, through: 0.6 });
}

function draw(strokes: Strokes, now: Scene, at: Point, found: Mobility, palette: Palette): Label[] {
  const axes = drawn(found);
  ellipsoid(strokes, at, axes, palette);
  const labels = found.axes.flatMap(({ length }, k): Label[] => {
    if (length < 5e-3) return [];
    return [{ text: `${short(length, 2)} m/s`, at: add(at, axes[k]), toward: axes[k], colour: palette.velocity, size: 12, plate: true, rank: 8 - k }];
  });
  const long = 6 * now.unit;
  for (const { kind, direction } of found.lost) {
    // An equation between ways and turns has no direction of its own.
    if (kind === "both") continue;
    strokes.line(add(at, direction, -long), add(at, direction, long), { colour: palette.singular, width: 3, dash: 7, through: 0.8 });
    if (kind === "about") strokes.arc(at, direction, scale(perpendicular(direction), 0.5 * long), 1.7 * Math.PI, { colour: palette.singular, width: 3, head: 12, through: 0.8 });
    const text = kind === "along" ? "no motion along it" : "no turn about it";
    labels.push({ text, at: add(at, direction, long), toward: direction, colour: palette.singular, size: 12, plate: true, rank: 25 });
  }
  return labels;
}

export function addEllipsoid(stage: Stage): void {
  const strokes = new Strokes(12, false, 256);
  stage.add(strokes.object);
  stage.onEnd(() => strokes.dispose());
  stage.watch(
    "ellipsoid",
    () => ({
      now: scene.value,
      here: pose.value,
      found: look.value.ellipsoid ? mobility.value : null,
      palette: colours.value,
      hasLabels: look.value.labels && !playing.value,
    }),
    ({ now, here, found, palette, hasLabels }) => {
      strokes.begin();
      const labels = now && here && found ? draw(strokes, now, originOf(here), found, palette) : [];
      stage.labels.set("ellipsoid", hasLabels ? labels : []);
      strokes.end();
    },
  );
}
