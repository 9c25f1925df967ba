// What the name of a formula stands for in the picture: an entry of the forward model is a coordinate of the last frame's origin or of one of its
// axes; `x4y` is the y component, in frame 4, of its x axis.

import { signal } from "@preact/signals";
import type { Scene } from "../engine/types.ts";
import { axisOf, dot, originOf, sub } from "../scene/geometry.ts";

export interface Meaning {
  /** The frame along whose axis it is measured. */
  frame: number;
  axis: 0 | 1 | 2;
  /** Of the last frame's origin, or of its x, y or z axis. */
  of: "origin" | 0 | 1 | 2;
}

/** What is drawn now. */
export const meant = signal<Meaning | null>(null);

const AXES = ["x", "y", "z"] as const;
type Axis = Meaning["axis"];

export function meaningOf(name: string): Meaning | null {
  const [, row, column] = /^t([123])([1234])$/.exec(name) ?? [];
  if (row) return { frame: 0, axis: (Number(row) - 1) as Axis, of: column === "4" ? "origin" : ((Number(column) - 1) as Axis) };
  const [, of, frame, axis] = /^([xyz])(\d)([xyz])$/.exec(name) ?? [];
  if (!of) return null;
  return { frame: Number(frame), axis: AXES.indexOf(axis as "x") as Axis, of: AXES.indexOf(of as "x") as Axis };
}

/** The number that it is in the picture; nothing where there is no such frame. */
export function component({ frame, axis, of }: Meaning, { frames, rows }: Scene): number | null {
  const [first, last] = [frames[frame], frames[rows.length]];
  if (!first || !last || frame > rows.length) return null;
  const along = axisOf(first, axis);
  return of === "origin" ? dot(sub(originOf(last), originOf(first)), along) : dot(axisOf(last, of), along);
}

/** `the x coordinate, in frame 0, of the last frame's origin` */
export function wordsOf({ frame, axis, of }: Meaning): string {
  return `the ${AXES[axis]} ${of === "origin" ? "coordinate" : "component"}, in frame ${frame}, of the last frame’s ${of === "origin" ? "origin" : `${AXES[of]} axis`}`;
}
