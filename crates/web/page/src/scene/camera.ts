// What other parts of the page may ask of the scene: its picture, and from where it is seen.

import type { Stage } from "./stage.ts";

let stage: Stage | null = null;
/** A view that was asked for before there was a scene. */
let waiting: number[] | null = null;

/** The scene that is on the page, or none. */
export function present(shown: Stage | null): void {
  stage = shown;
  if (stage && waiting) setCamera(waiting);
}

/** Whether a view was asked for, which a first look at a robot must not replace. */
export function isAskedFor(): boolean {
  return waiting !== null;
}

/** The present view as a PNG at twice its size, with labels. */
export function picture(): Promise<Blob> {
  return stage ? stage.picture() : Promise.reject(new Error("there is no picture: this browser has no WebGL"));
}

/** Azimuth, elevation (radians), distance, and the point looked at (metres). */
export function camera(): number[] {
  if (!stage) return waiting ?? [];
  const { azimuth, elevation, distance, target } = stage.orbit.view;
  return [azimuth, elevation, distance, ...target].map((x) => Number(x.toFixed(4)));
}

/** Looks from there; numbers that make no view are ignored. */
export function setCamera(numbers: number[]): void {
  const [azimuth, elevation, distance, x, y, z] = numbers;
  if (numbers.length !== 6 || !numbers.every(Number.isFinite) || distance <= 0) return;
  waiting = numbers;
  if (!stage) return;
  stage.orbit.go({ azimuth, elevation, distance, target: [x, y, z] }, 0);
  stage.orbit.isChosen = true;
  stage.viewChanged();
}
