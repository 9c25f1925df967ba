// A cell of the robot file by its path, as findings name it: `joints.2.theta`, `tool.xyz.0`. What is typed goes into
// the file a moment later, so that a word is one change and not one for each letter.

import { signal } from "@preact/signals";
import type { Finding, RobotFile } from "../engine/types.ts";
import { change, file, findings, said } from "../state.ts";

/** From a key to the picture, milliseconds. */
const DEBOUNCE = 60;

const typing = signal<{ cell: string; text: string } | null>(null);
let timer: ReturnType<typeof setTimeout> | undefined;
/** Counts stays in cells: what is typed in one stay is undone together. */
let stay = 0;

/** The text of a cell, as typed or as the file has it. */
export function textOf(cell: string): string {
  if (typing.value?.cell === cell) return typing.value.text;
  const found = at(file.value, cell.split("."));
  return typeof found === "string" ? found : "";
}

export function type(cell: string, text: string): void {
  if (typing.value && typing.value.cell !== cell) flush();
  typing.value = { cell, text };
  clearTimeout(timer);
  timer = setTimeout(flush, DEBOUNCE);
}

/** Puts what was typed into the file, now. */
export function flush(): void {
  clearTimeout(timer);
  const typed = typing.value;
  if (!typed) return;
  typing.value = null;
  try {
    const now = at(file.value, typed.cell.split("."));
    if ((typeof now === "string" ? now : "") !== typed.text) change(withCell(file.value, typed.cell, typed.text), `${typed.cell} ${stay}`);
  } catch (why) {
    said(why);
  }
}

/** A cell was left: the next change is another one. */
export function leave(): void {
  flush();
  stay += 1;
}

export function findingsOf(cell: string): Finding[] {
  return findings.value.filter((finding) => finding.cell === cell);
}

export function findingId(cell: string): string {
  return `finding-${cell.replaceAll(".", "-")}`;
}

function at(of: unknown, path: string[]): unknown {
  return path.reduce<unknown>((inside, key) => (inside && typeof inside === "object" && Object.hasOwn(inside, key) ? (inside as Record<string, unknown>)[key] : undefined), of);
}

/** What stands where a cell is filled first. */
const EMPTY: Record<string, () => unknown> = {
  limits: () => ["", ""],
  xyz: () => ["0", "0", "0"],
  rpy: () => ["0", "0", "0"],
  gravity: () => ["0", "0", "-9.81"],
  base: () => ({}),
  tool: () => ({}),
};

/** A file with another text in one cell. Cells that may be missing go when they are emptied. */
export function withCell(of: RobotFile, cell: string, text: string): RobotFile {
  const path = cell.split(".");
  // A name or a value stays, empty, where something is named or valued; elsewhere an empty cell is none.
  const keep = path.length === 1 || path[0] === "parameters" || path[0] === "poses";
  return put(of, path, text, keep) as RobotFile;
}

function put(inside: unknown, path: string[], text: string, keep: boolean): unknown {
  const [key, ...rest] = path;
  if (Array.isArray(inside)) {
    return inside.map((old: unknown, index) => (String(index) !== key ? old : rest.length > 0 ? put(old, rest, text, keep) : text));
  }
  const before = inside as Record<string, unknown>;
  if (rest.length > 0) {
    const after = put(before[key] ?? EMPTY[key]?.() ?? {}, rest, text, keep);
    if (key === "limits" && Array.isArray(after) && after.every((limit) => limit === "")) return without(before, key);
    return { ...before, [key]: after };
  }
  return text === "" && !keep ? without(before, key) : { ...before, [key]: text };
}

function without(of: Record<string, unknown>, key: string): Record<string, unknown> {
  const { [key]: _, ...rest } = of;
  return rest;
}
