// The game: the arm stands without its frames, and they are placed one after another, each by its origin, its z and its x.

import { computed, signal } from "@preact/signals";
import type { Point, Scene } from "../engine/types.ts";
import { batch, effect, file, note, panel, robot, scene, selected, stale } from "../state.ts";
import { type Choice, origins, xs, zs } from "./choices.ts";
import { type Arm, armOf, type Placed, type Verdict } from "./rules.ts";

export type Part = "origin" | "z" | "x";

export interface Game {
  arm: Arm;
  /** The arm as it stands while the frames are placed. */
  scene: Scene;
  /** Frame 0 is given. */
  placed: Placed[];
  /** What is there of the next one. */
  origin: Point | null;
  z: Point | null;
  /** The wrong answers to this question by their places, and how many there were to all. */
  tried: number[];
  slips: number;
  said: Verdict | null;
}

export const game = signal<Game | null>(null);
/** The choice that is pointed at, by its place in the list. */
export const pointed = signal<number | null>(null);

export const LETTERS = "ABCDEF";

/** Whether each row of the table has a joint of its own: else there would be no telling where a frame belongs. */
export const canPlay = computed(() => {
  const model = robot.value;
  return model !== null && !stale.value && model.rows > 0 && model.joints.length === model.rows && model.joints.every(({ row }, k) => row === k);
});

export function begin(): void {
  const [model, now] = [robot.peek(), scene.peek()];
  if (!model || !now || !canPlay.peek()) return;
  const arm = armOf(file.peek().convention, now.frames.slice(0, model.rows + 1), model.joints.map(({ kind }) => kind), model.reach);
  batch(() => {
    selected.value = null;
    game.value = { arm, scene: now, placed: [arm.frames[0]], origin: null, z: null, tried: [], slips: 0, said: null };
  });
}

export function end(): void {
  game.value = null;
}

/** The question: which frame, and which part of it; nothing when all frames stand. */
export const question = computed<{ frame: number; part: Part; choices: Choice[] } | null>(() => {
  const now = game.value;
  if (!now || now.placed.length === now.arm.frames.length) return null;
  const frame = now.placed.length;
  const before = now.placed[frame - 1];
  if (!now.origin) return { frame, part: "origin", choices: origins(now.arm, frame, before) };
  if (!now.z) return { frame, part: "z", choices: zs(now.arm, frame, before, now.origin) };
  return { frame, part: "x", choices: xs(now.arm, frame, before, { origin: now.origin, z: now.z }) };
});

/** An answer: a right one is put there, a wrong one is said why. */
export function answer(index: number): void {
  const [now, asked] = [game.peek(), question.peek()];
  const choice = asked?.choices[index];
  if (!now || !asked || !choice) return;
  const { value, verdict } = choice;
  if (!verdict.right) {
    const isNew = !now.tried.includes(index);
    game.value = { ...now, tried: isNew ? [...now.tried, index] : now.tried, slips: now.slips + (isNew ? 1 : 0), said: verdict };
    return;
  }
  pointed.value = null;
  const next = { ...now, tried: [], said: verdict };
  if (asked.part === "origin") game.value = { ...next, origin: value };
  else if (asked.part === "z") game.value = { ...next, z: value };
  else if (now.origin && now.z) game.value = { ...next, placed: [...now.placed, { origin: now.origin, z: now.z, x: value }], origin: null, z: null };
}

// The frames belong to the arm as it stood, and to the panel in which they are placed.
effect(() => {
  const now = game.value;
  if (!now) return;
  if (panel.value !== "table" || selected.value !== null) game.value = null;
  else if (scene.value !== now.scene) {
    game.value = null;
    note("The arm has changed: its frames are to be placed anew.");
  }
});
