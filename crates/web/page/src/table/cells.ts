// A cell of the robot file by its path, as findings name it: `joints.2.theta`, `tool.xyz.0`. What is typed goes into
// the file a moment later, so that a word is one change and not one for each letter. When the cell is left, names that
// are new in it become parameters.

import { signal } from "@preact/signals";
import type { Finding, RobotFile } from "../engine/types.ts";
import { change, file, findings, look, note, said } from "../state.ts";
import { SI, undeclared, withUnits } from "./bare.ts";

/** From a key to the picture, milliseconds. */
const DEBOUNCE = 60;

const typing = signal<{ cell: string; text: string } | null>(null);
let timer: ReturnType<typeof setTimeout> | undefined;
/** Counts stays in cells: what is typed in one stay is undone together. */
let stay = 0;

/** The text of a cell: as typed while one is in it, else as the file has it. */
export function textOf(cell: string): string {
  return typing.value?.cell === cell ? typing.value.text : withUnits(cell, inFile(cell), SI);
}

function inFile(cell: string): string {
  const found = at(file.value, cell.split("."));
  return typeof found === "string" ? found : "";
}

export function type(cell: string, text: string): void {
  if (typing.value && typing.value.cell !== cell) flush();
  typing.value = { cell, text };
  clearTimeout(timer);
  timer = setTimeout(write, DEBOUNCE);
}

/** Puts what was typed into the file; the cell keeps it as it was typed. */
function write(): void {
  clearTimeout(timer);
  const typed = typing.value;
  if (!typed) return;
  try {
    const text = withUnits(typed.cell, typed.text, look.value);
    if (inFile(typed.cell) !== text) change(withCell(file.value, typed.cell, text), `${typed.cell} ${stay}`);
  } catch (why) {
    said(why);
  }
}

/** Puts what was typed into the file, now, and shows what it has become. */
export function flush(): void {
  write();
  typing.value = null;
}

/** What was typed is meant: names that are new in the cell become parameters. */
export function settle(): void {
  const typed = typing.value;
  flush();
  if (typed) declare(typed.cell);
}

/** A cell was left: the next change is another one. */
export function leave(): void {
  settle();
  stay += 1;
}

/** Gives the names that a cell uses and nobody declared a place among the parameters; it is undone with the cell. */
function declare(cell: string): void {
  const names = [...new Set(findingsOf(cell).map(undeclared))].filter((name) => name !== null);
  if (names.length === 0) return;
  try {
    const added = names.map((name) => ({ name, value: "" }));
    change({ ...file.value, parameters: [...file.value.parameters, ...added] }, `${cell} ${stay}`);
    note(`${names.join(", ")} ${names.length === 1 ? "is a new parameter: its value has" : "are new parameters: their values have"} a place under “Parameters”.`);
  } catch (why) {
    said(why);
  }
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
