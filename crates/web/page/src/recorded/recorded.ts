// A recording in hand: opened from a file, held against the robot, played.

import { signal } from "@preact/signals";
import type { RecordedAnswer, RecordedColumn } from "../engine/types.ts";
import { plannedFrom } from "../path/points.ts";
import { batch, engine, motions, panel, path, playing, q, revision, time } from "../state.ts";
import { Task } from "../task.tsx";
import type { Lying } from "../tree/files.ts";
import { lazy } from "../tree/lazy.ts";

/** More is for the command line. */
const MOST_BYTES = 64 * 2 ** 20;
/** Fewer lines and columns are a table of a robot. */
const LEAST = { lines: 9, columns: 7 };

interface Told {
  answer: RecordedAnswer;
  revision: number;
  /** What is left out of the file, for it is no number. */
  left: string[];
}

type Opened = { name: string; latin1: string } | { name: string; columns: RecordedColumn[]; left: string[] };

export const opened = signal<Opened | null>(null);
export const holding = new Task<Told>();
/** Which motion is shown: with all of it undone, or as the columns stand. */
export const view = signal(0);

/** True for a file of columns: by its ending, and where a robot's table may have it, by its lines. */
export async function isRecording(file: Lying): Promise<boolean> {
  if (/\.(jsonl|ndjson|npy|npz|parquet)$/i.test(file.path)) return true;
  if (!/\.(csv|tsv|dat|log)$/i.test(file.path)) return false;
  const start = new TextDecoder().decode((await file.read()).subarray(0, 100_000));
  const lines = start.split(/\r?\n/).filter((line) => line.trim() !== "");
  const columns = lines.slice(-Math.max(1, lines.length >> 1)).map((line) => line.trim().split(/[,;\t]|\s+/).length);
  return lines.length > LEAST.lines && columns.every((n) => n >= LEAST.columns);
}

/** Reads a file, and holds it against the robot. */
export async function openRecording(file: Lying): Promise<void> {
  if (file.size > MOST_BYTES) throw new Error(`${file.path} has more than ${MOST_BYTES / 2 ** 20} MiB: \`denavit check\` reads more.`);
  const bytes = await file.read();
  opened.value = /\.parquet$/i.test(file.path) ? { name: file.path, ...(await (await lazy("parquet")).columnsOf(bytes)) } : { name: file.path, latin1: characters(bytes) };
  panel.value = "check";
  await hold();
}

/** Holds the recording against the robot as it is now. */
export async function hold(): Promise<void> {
  const file = opened.peek();
  if (!file) return;
  const forRevision = revision.peek();
  const left = "left" in file ? file.left : [];
  const asked = "latin1" in file ? { name: file.name, latin1: file.latin1 } : { name: file.name, columns: file.columns };
  const told = await holding.start(async () => ({ answer: await engine().formulas.call("recording", asked), revision: forRevision, left }));
  if (told && forRevision === revision.peek()) show(told.answer, 0);
}

/** Puts a motion of the recording where paths are played. */
export function show(answer: RecordedAnswer, k: number): void {
  const chosen = answer.views[k];
  if (!chosen) return;
  batch(() => {
    view.value = k;
    playing.value = false;
    plannedFrom.value = null;
    time.value = 0;
    path.value = chosen.path;
    if (chosen.path.q[0]) q.value = chosen.path.q[0];
    motions.value += 1;
  });
}

export function close(): void {
  opened.value = null;
  holding.reset();
}

/** A character a byte. */
function characters(bytes: Uint8Array): string {
  let out = "";
  for (let at = 0; at < bytes.length; at += 8192) out += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return out;
}
