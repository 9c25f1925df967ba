// A row of the table as it stands in space. Its steps are walked in the convention's order: each begins at the frame that
// the engine gives and goes along or about that frame's x or z. A way is a dimension line, a turn an arc from the axis
// before to the axis after; the two joint axes and the common normal are drawn out beyond them.

import { computed } from "@preact/signals";
import type { Letter, Point, Scene, Step } from "../engine/types.ts";
import { look, scene, selected } from "../state.ts";
import { SIGNS } from "../steps/matrix.ts";
import { after, doneNow, frameNow, isNothing, isTurn, share } from "../steps/walk.ts";
import { drawFrame } from "./frames.ts";
import { add, axisOf, cross, dot, middle, norm, originOf, scale, turned, unit } from "./geometry.ts";
import type { Label } from "./labels.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { type Colour, colours, type Palette } from "./theme.ts";
import { inAngle, inLength } from "./units.ts";

export interface Said {
  letter: Letter;
  /** `θ` */
  sign: string;
  index: number;
  /** `q2 + π/2`, or nothing where the cell is just a number. */
  cell: string;
  /** `121.3°` */
  number: string;
  isZero: boolean;
  /** The parameter that it is in the standard convention: that has the colour. */
  hue: "theta" | "d" | "a" | "alpha";
  colour: Colour;
  shape: "turn" | "way";
  /** Whose axis: `z` and 3. */
  axis: { name: "x" | "z"; index: number };
  words: string;
}

function hueOf(step: Step): Said["hue"] {
  if (step.axis === "z") return isTurn(step) ? "theta" : "d";
  return isTurn(step) ? "alpha" : "a";
}

/** A cell that is only a number says nothing that the number does not. */
function isNumber(text: string): boolean {
  return /^[\s\d.,+\-−*/°()πe]*(deg|rad|mm|cm|m)?$/iu.test(text);
}

function say(step: Step, row: number, isBefore: boolean, palette: Palette): Said {
  const turns = isTurn(step);
  const axis = { name: step.axis, index: isBefore ? row : row + 1 };
  return {
    letter: step.letter,
    sign: SIGNS[step.letter],
    index: row + 1,
    cell: isNumber(step.text) ? "" : step.text,
    number: turns ? inAngle(step.value) : inLength(step.value),
    isZero: isNothing(step),
    hue: hueOf(step),
    colour: palette[hueOf(step)],
    shape: turns ? "turn" : "way",
    axis,
    words: `${turns ? "A turn about" : "A way along"} the ${axis.name} axis of frame ${axis.index}`,
  };
}

/** Always the same, so that nobody draws it anew. */
const NOTHING: Said[] = [];

/** What the selected row says, in the order of its steps. */
export const rowNow = computed<Said[]>(() => {
  const now = scene.value;
  const row = selected.value;
  if (!now || row === null || !now.rows[row]) return NOTHING;
  const steps = now.rows[row];
  // The first steps keep to an axis of the frame before, the last ones to one of the frame after.
  return steps.map((step, k) => say(step, row, steps.slice(k).some((later) => later.axis !== step.axis), colours.value));
});

class RowPicture {
  #stage: Stage;
  #strokes = new Strokes(20, false, 128);
  #labels: Label[] = [];

  constructor(stage: Stage) {
    this.#stage = stage;
    stage.add(this.#strokes.object);
    stage.onEnd(() => this.#strokes.dispose());
  }

  draw(now: Scene | null, row: number | null, said: Said[], palette: Palette, hasLabels: boolean, done: number | null): void {
    this.#strokes.begin();
    this.#labels = [];
    const steps = now && row !== null ? now.rows[row] : undefined;
    if (now && row !== null && steps) {
      this.#axes(now, row, steps, palette);
      // Arcs at one place get radii of their own.
      let arcs = 0;
      steps.forEach((step, k) => {
        if (said[k].isZero) return;
        // Of the steps that are made one after another, those that are done, and a part of the one that is being made.
        const part = done === null ? 1 : share(k, done);
        const radius = now.unit * (2.5 + (isTurn(step) ? 0.75 * arcs++ : 0));
        if (part === 0) return;
        if (isTurn(step)) this.#turn({ ...step, value: part * step.value }, said[k], radius, palette, part);
        else this.#way({ ...step, value: part * step.value }, said[k], part);
      });
    }
    this.#stage.labels.set("row", hasLabels ? this.#labels : this.#labels.filter((label) => label.plate));
    this.#strokes.end();
  }

  #axes(now: Scene, row: number, steps: Step[], palette: Palette): void {
    const [before, after] = [now.frames[row], now.frames[row + 1]];
    const long = 6 * now.unit;
    for (const [frame, index] of [[before, row], [after, row + 1]] as const) {
      const [at, z, x] = [originOf(frame), axisOf(frame, 2), axisOf(frame, 0)];
      this.#strokes.line(add(at, z, -long), add(at, z, long), { colour: palette.z, width: 1.25, alpha: 0.75, through: 0.5 });
      this.#name(`z_${index}`, add(at, z, long), scale(z, now.unit), palette.z);
      this.#name(`x_${index}`, add(at, x, 2.4 * now.unit), scale(x, now.unit), palette.x);
    }
    // The common normal lies where the step along x is.
    const along = steps.find((step) => step.axis === "x" && !isTurn(step));
    if (!along) return;
    const [at, x] = [originOf(along.frame), axisOf(along.frame, 0)];
    const [low, high] = [Math.min(0, along.value) - 0.5 * long, Math.max(0, along.value) + 0.5 * long];
    this.#strokes.line(add(at, x, low), add(at, x, high), { colour: palette.normal, width: 1.25, dash: 5, through: 0.6 });
  }

  #name(text: string, at: Point, toward: Point, colour: Colour): void {
    this.#labels.push({ text, at, toward, colour, size: 14, rank: 20 });
  }

  /** On the way a step has its letter alone. */
  #text({ sign, index, cell, number }: Said, part: number): string {
    return part < 1 ? `${sign}_${index}` : `${sign}_${index} = ${cell ? `${cell} = ` : ""}${number}`;
  }

  #way(step: Step, said: Said, part: number): void {
    const from = originOf(step.frame);
    const axis = axisOf(step.frame, step.axis === "x" ? 0 : 2);
    const to = add(from, axis, step.value);
    this.#strokes.line(from, to, { colour: said.colour, width: 3.5, head: 13, both: true, through: 0.9 });
    this.#labels.push({ text: this.#text(said, part), at: middle(from, to), toward: this.#beside(axis), colour: said.colour, size: 14, plate: true, rank: 30 });
  }

  #turn(step: Step, said: Said, radius: number, palette: Palette, part: number): void {
    const at = originOf(step.frame);
    const isAboutZ = step.axis === "z";
    const axis = axisOf(step.frame, isAboutZ ? 2 : 0);
    const start = axisOf(step.frame, isAboutZ ? 0 : 2);
    const end = turned(start, axis, step.value);
    const leg = { width: 1.5, alpha: 0.9, through: 0.6, colour: isAboutZ ? palette.x : palette.z };
    this.#strokes.line(at, add(at, start, 1.25 * radius), { ...leg, dash: 4 });
    this.#strokes.line(at, add(at, end, 1.25 * radius), leg);
    // More than a whole turn is drawn as what is left of it.
    const shown = Math.abs(step.value) > 2 * Math.PI ? step.value % (2 * Math.PI) : step.value;
    this.#strokes.arc(at, axis, scale(start, radius), shown, { colour: said.colour, width: 3, head: 13, through: 0.9 });
    const half = turned(start, axis, shown / 2);
    this.#labels.push({ text: this.#text(said, part), at: add(at, half, radius), toward: scale(half, radius), colour: said.colour, size: 14, plate: true, rank: 30 });
  }

  /** A direction at a right angle to a line as it is seen, upward. */
  #beside(axis: Point): Point {
    const { back, up } = this.#stage.orbit;
    const side = cross(axis, back);
    return norm(side) < 0.05 ? up : scale(unit(side), dot(side, up) < 0 ? -0.1 : 0.1);
  }
}

export function addRow(stage: Stage): void {
  const picture = new RowPicture(stage);
  stage.watch(
    "row",
    () => ({ now: scene.value, row: selected.value, said: rowNow.value, palette: colours.value, hasLabels: look.value.labels, done: doneNow.value }),
    ({ now, row, said, palette, hasLabels, done }) => picture.draw(now, row, said, palette, hasLabels, done),
  );

  // The frame that goes from one to the other, and where it was after each step.
  const moving = new Strokes(21);
  stage.add(moving.object);
  stage.onEnd(() => moving.dispose());
  stage.watch(
    "moving frame",
    () => ({ now: scene.value, row: selected.value, done: doneNow.value, frame: frameNow.value, palette: colours.value }),
    ({ now, row, done, frame, palette }) => {
      moving.begin();
      if (now && row !== null && done !== null && frame) {
        const before = now.rows[row].filter((step, k) => k + 1 < done && !isNothing(step));
        for (const step of before) drawFrame(moving, after(step), palette, { length: 2.4 * now.unit, alpha: 0.3, width: 2 });
        drawFrame(moving, frame, palette, { length: 3.6 * now.unit, alpha: 1, width: 4 });
      }
      moving.end();
    },
  );
}
