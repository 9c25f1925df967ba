// Pictures of robots of the catalogue: each is read by an engine beside the page, one after the other, when it comes into view.

import { signal } from "@preact/signals";
import type { Scene } from "../engine/types.ts";
import { Cancelled } from "../engine/client.ts";
import { engine } from "../state.ts";

/** By the robot's name; nothing where it cannot be drawn. */
export const pictures = signal<ReadonlyMap<string, Scene | null>>(new Map());

const wanted = new Set<string>();
let isRunning = false;

export function want(name: string): void {
  if (pictures.peek().has(name)) return;
  wanted.add(name);
  if (!isRunning) void run();
}

/** What has left the view before its turn is not wanted. */
export function unwant(name: string): void {
  wanted.delete(name);
}

async function run(): Promise<void> {
  isRunning = true;
  for (let [name] = wanted; name !== undefined; [name] = wanted) {
    try {
      const found = await sceneOf(name);
      pictures.value = new Map(pictures.peek()).set(name, found);
      wanted.delete(name);
    } catch (why) {
      // A cancelled one is asked for again.
      if (why instanceof Cancelled) continue;
      pictures.value = new Map(pictures.peek()).set(name, null);
      wanted.delete(name);
    }
  }
  isRunning = false;
}

async function sceneOf(name: string): Promise<Scene | null> {
  const { files } = engine();
  const { file } = await files.call("open", { text: name, kind: "robot" });
  if (!file) return null;
  const { robot } = await files.call("edit", { file });
  return robot && files.call("scene", { q: robot.q });
}
