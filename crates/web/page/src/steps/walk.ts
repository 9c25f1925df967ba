// The way from a frame of the table to the next, step by step: where on it the frame is that moves, and its clock. A step
// forward or back goes on into the row behind or before.

import { computed, signal } from "@preact/signals";
import type { Matrix, Step } from "../engine/types.ts";
import { axisOf, movedPose, scale } from "../scene/geometry.ts";
import { stillness } from "../scene/theme.ts";
import { batch, effect, scene, selected } from "../state.ts";

/** How long a step takes, and how long the frame rests behind it, milliseconds. A step by nothing is only shown. */
const STEP = 900;
const NOTHING = 250;
const REST = 350;

export const isTurn = ({ letter }: Pick<Step, "letter">): boolean => letter === "theta" || letter === "alpha" || letter === "gamma";
export const isNothing = (step: Step): boolean => Math.abs(step.value) < 1e-9;

/** The row (from 0) that was begun, and how many of its steps are done; a part of one counts as a part. */
const begun = signal<{ row: number; done: number } | null>(null);
/** Which way the frame runs by itself: 1 forward, −1 back, 0 not. */
export const running = signal<1 | -1 | 0>(0);

/** The steps of the selected row. */
export const stepsNow = computed<Step[]>(() => (selected.value === null ? undefined : scene.value?.rows[selected.value]) ?? []);

/** How many steps of the selected row are done; nothing where its row is shown as a whole. */
export const doneNow = computed<number | null>(() => {
  const now = begun.value;
  return now && now.row === selected.value ? Math.min(now.done, stepsNow.value.length) : null;
});

/** How much of its value a step has, where so many are done: from 0 to 1. */
export function share(k: number, done: number): number {
  return Math.min(1, Math.max(0, done - k));
}

/** The pose that a step makes of the frame before it. */
export function after(step: Step, part = 1): Matrix {
  const axis = axisOf(step.frame, step.axis === "x" ? 0 : 2);
  const by = part * step.value;
  return isTurn(step) ? movedPose(step.frame, axis, by, [0, 0, 0]) : movedPose(step.frame, axis, 0, scale(axis, by));
}

/** The frame that moves, in the base. */
export const frameNow = computed<Matrix | null>(() => {
  const [steps, done] = [stepsNow.value, doneNow.value];
  if (done === null || steps.length === 0) return null;
  const k = Math.min(steps.length - 1, Math.floor(done));
  return after(steps[k], share(k, done));
});

/** The step that is being made, or the last one that was. */
export const stepNow = computed<number | null>(() => {
  const done = doneNow.value;
  return done === null || done === 0 ? null : Math.ceil(done) - 1;
});

/** So many steps of a row are done. */
export function put(row: number, done: number): void {
  batch(() => {
    selected.value = row;
    begun.value = { row, done };
  });
}

/** The row is shown as a whole again. */
export function whole(): void {
  batch(() => {
    running.value = 0;
    begun.value = null;
  });
}

/** Where a step forward or back begins: a row that is shown as a whole begins anew, or has all its steps behind it. */
function place(way: 1 | -1): { row: number; done: number; steps: number } | null {
  const rows = scene.peek()?.rows ?? [];
  if (rows.length === 0) return null;
  const row = selected.peek() ?? (way > 0 ? 0 : rows.length - 1);
  const steps = rows[row].length;
  const done = doneNow.peek() ?? (way > 0 ? 0 : steps);
  const isOver = way > 0 ? done >= steps : done <= 0;
  if (!isOver || doneNow.peek() === null) return { row, done, steps };
  const next = row + way;
  if (!rows[next]) return null;
  return { row: next, done: way > 0 ? 0 : rows[next].length, steps: rows[next].length };
}

/** Whether there is a step in that direction. */
export const canStep = (way: 1 | -1): boolean => {
  void scene.value;
  void selected.value;
  void doneNow.value;
  return place(way) !== null;
};

/** One whole step. */
export function step(way: 1 | -1): void {
  running.value = 0;
  const from = place(way);
  if (!from) return;
  put(from.row, way > 0 ? Math.floor(from.done) + 1 : Math.ceil(from.done) - 1);
}

/** Runs that way to the end of the arm, or stops. At the end it begins anew. */
export function run(way: 1 | -1): void {
  if (running.peek() === way) {
    running.value = 0;
    return;
  }
  const rows = scene.peek()?.rows ?? [];
  if (rows.length === 0) return;
  const from = place(way);
  const first = way > 0 ? 0 : rows.length - 1;
  if (from) put(from.row, from.done);
  else put(first, way > 0 ? 0 : rows[first].length);
  running.value = way;
}

/** Runs the clock until what it returns is called. */
export function runSteps(): () => void {
  let frame = 0;
  let last = 0;
  /** Milliseconds that the frame still rests. */
  let rest = 0;

  /** A moment of the way; where a step ends, the frame rests. */
  const moved = (way: 1 | -1, passed: number): void => {
    if (rest > 0) {
      rest -= passed;
      return;
    }
    const from = place(way);
    if (!from) {
      running.value = 0;
      return;
    }
    const rows = scene.peek()?.rows ?? [];
    const k = way > 0 ? Math.floor(from.done) : Math.ceil(from.done) - 1;
    const end = way > 0 ? k + 1 : k;
    const lasts = isNothing(rows[from.row][k]) ? NOTHING : STEP;
    // Who asked for less motion sees each step whole.
    const next = stillness.matches ? end : from.done + (way * passed) / lasts;
    const isAtEnd = way > 0 ? next >= end : next <= end;
    put(from.row, isAtEnd ? end : next);
    if (isAtEnd) rest = stillness.matches ? lasts + REST : REST;
  };

  const tick = (now: number): void => {
    const way = running.peek();
    if (way === 0) return;
    moved(way, last ? Math.min(100, now - last) : 0);
    last = now;
    frame = requestAnimationFrame(tick);
  };

  const follow = effect(() => {
    const way = running.value;
    cancelAnimationFrame(frame);
    if (way === 0) return;
    [last, rest] = [0, 0];
    frame = requestAnimationFrame(tick);
  });
  // Nothing runs where no row is shown, or another was chosen.
  const stop = effect(() => {
    if (running.value !== 0 && doneNow.value === null) running.value = 0;
  });
  return () => {
    cancelAnimationFrame(frame);
    follow();
    stop();
  };
}
