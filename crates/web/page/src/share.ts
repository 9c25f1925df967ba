// Keeps the address in step with the page, and the page with the address that was opened.

import { decode, encode, type Shared } from "./fragment.ts";
import { points, start } from "./path/points.ts";
import { camera, setCamera } from "./scene/camera.ts";
import { batch, effect, file, forget, look, message, move, panel, q, reach, replace, robot, selected, show, target } from "./state.ts";

/** From the last change to the address, milliseconds. */
const DEBOUNCE = 400;
/** A longer address is cut off by mail programs and messengers. */
export const LONG_ADDRESS = 8000;

/** What the page shows now. Reading it in an effect subscribes to all of it but the camera. */
export function present(): Shared {
  // The theme is the reader's, not the writer's.
  const { theme: _, ...shown } = look.value;
  const seen = camera();
  return {
    file: file.value,
    q: q.value,
    target: target.value ?? undefined,
    look: shown,
    panel: panel.value,
    selected: selected.value ?? undefined,
    camera: seen.length > 0 ? seen : undefined,
    points: points.value.length > 0 ? points.value : undefined,
    start: start.value ?? undefined,
  };
}

/** The address of the whole page with everything in it. */
export async function address(): Promise<string> {
  const url = new URL(location.href);
  // What was asked for there is in the state by now.
  url.search = "";
  url.hash = await encode(present());
  return url.href;
}

/** Shows what somebody shared; throws what the engine says of a robot that it cannot take. */
export function restore(shared: Shared): void {
  replace(shared.file);
  batch(() => {
    if (shared.look) show(shared.look);
    if (shared.panel) panel.value = shared.panel;
    selected.value = shared.selected ?? null;
  });
  if (shared.camera) setCamera(shared.camera);
  if (shared.points) points.value = shared.points;
  start.value = shared.start ?? null;
  const joints = robot.value?.joints.length;
  if (shared.q && shared.q.length === joints) {
    if (shared.target) {
      q.value = shared.q;
      reach(shared.target);
    } else move(shared.q);
  } else if (shared.target && joints) reach(shared.target);
}

/** Shows what the address carries, if it carries something; whether it did. */
export async function restoreAddress(): Promise<boolean> {
  if (location.hash.length <= 1) return false;
  try {
    restore(await decode(location.hash));
    forget();
    return true;
  } catch (why) {
    message.value = {
      words: why instanceof Error ? why.message : "The address cannot be read.",
      hint: robot.value ? undefined : "Here is another robot to begin with.",
      severity: "error",
    };
    return false;
  }
}

let timer: ReturnType<typeof setTimeout> | undefined;
let written = "";

/** From now on every change goes into the address, without a step in the browser's history. */
export function keepAddress(): void {
  written = JSON.stringify(present());
  effect(() => {
    present();
    writeSoon();
  });
  // The camera is no signal: it has moved when a hand leaves the mouse or the keys.
  for (const kind of ["pointerup", "keyup", "wheel"]) document.querySelector(".scene")?.addEventListener(kind, writeSoon, { passive: true });
  addEventListener("hashchange", () => void restoreAddress());
}

function writeSoon(): void {
  clearTimeout(timer);
  timer = setTimeout(() => void write(), DEBOUNCE);
}

async function write(): Promise<void> {
  const now = present();
  const text = JSON.stringify(now);
  if (text === written) return;
  written = text;
  const fragment = await encode(now);
  history.replaceState(history.state, "", fragment);
}
