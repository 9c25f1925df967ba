// Rows put in, taken out and moved. Variables are numbered by the rows that introduce them, so that every such change
// renames them in all cells and brings the values of named poses along.

import type { Convention, Letter, RobotFile, Row } from "../engine/types.ts";

export type RowKind = "revolute" | "prismatic" | "fixed";

const FORMULAS = ["theta", "d", "a", "alpha", "r", "gamma", "b"] as const satisfies readonly Letter[];
const VARIABLE = /\b([qQ]|theta|θ)_?(\d+)\b/g;

/** The letters of a table, in the order of the convention. */
export function lettersOf(convention: Convention, branches = false): Letter[] {
  if (convention === "standard") return ["theta", "d", "a", "alpha"];
  if (convention === "craig") return ["alpha", "a", "theta", "d"];
  return branches ? ["gamma", "b", "alpha", "d", "theta", "r"] : ["alpha", "d", "theta", "r"];
}

/** The letter of the displacement along z. */
export function slide(convention: Convention): "d" | "r" {
  return convention === "khalil" ? "r" : "d";
}

/** For each row the number of the variable that it introduces: the first that no row before has. */
export function introduced(rows: Row[]): (number | null)[] {
  const seen = new Set<number>();
  return rows.map((row) => {
    const fresh = numbers(row).filter((number) => !seen.has(number));
    for (const number of fresh) seen.add(number);
    return fresh.length > 0 ? Math.max(...fresh) : null;
  });
}

function numbers(row: Row): number[] {
  return FORMULAS.flatMap((letter) => [...(row[letter] ?? "").matchAll(VARIABLE)].map((match) => Number(match[2])));
}

/** A new row behind the given one (−1 for the first place). */
export function insert(file: RobotFile, after: number, kind: RowKind): RobotFile {
  const numbersNow = introduced(file.joints);
  const number = 1 + numbersNow.slice(0, after + 1).filter((one) => one !== null).length;
  const row: Row = kind === "fixed" ? {} : { [kind === "revolute" ? "theta" : slide(file.convention)]: "q0" };
  const joints = [...file.joints.slice(0, after + 1), row, ...file.joints.slice(after + 1)];
  // The new variable is called q0 until all are numbered again.
  const order = [...numbersNow.slice(0, after + 1), kind === "fixed" ? null : 0, ...numbersNow.slice(after + 1)];
  const next = renumber({ ...file, joints }, order);
  return kind === "fixed" ? next : { ...next, poses: next.poses.map((pose) => ({ ...pose, values: splice(pose.values, number - 1) })) };
}

/** Without a row; a variable that went with it is 0 where other rows are coupled with it. */
export function remove(file: RobotFile, row: number): { file: RobotFile; coupled: boolean } {
  const numbersNow = introduced(file.joints);
  const gone = numbersNow[row];
  const joints = file.joints.filter((_, index) => index !== row);
  const coupled = gone !== null && joints.some((one) => numbers(one).includes(gone));
  const next = renumber({ ...file, joints }, numbersNow.filter((_, index) => index !== row));
  return { file: next, coupled };
}

/** The row changes places with its neighbour. */
export function shift(file: RobotFile, row: number, by: -1 | 1): RobotFile {
  const to = row + by;
  if (to < 0 || to >= file.joints.length) return file;
  const order = introduced(file.joints);
  const joints = [...file.joints];
  [joints[row], joints[to]] = [joints[to], joints[row]];
  [order[row], order[to]] = [order[to], order[row]];
  return renumber({ ...file, joints }, order);
}

/** Numbers the variables in the order of rows, given the number that each row's variable has now. */
function renumber(file: RobotFile, order: (number | null)[]): RobotFile {
  const now = order.filter((number) => number !== null);
  const names = new Map(now.map((number, index) => [number, index + 1]));
  const rename = (text: string) =>
    text.replace(VARIABLE, (whole: string, letter: string, number: string) => {
      const renamed = names.get(Number(number));
      return renamed === undefined ? "0" : whole.replace(letter + number, letter + renamed).replace(`_${number}`, `_${renamed}`);
    });
  const joints = file.joints.map((row) => {
    const next = { ...row };
    for (const letter of FORMULAS) {
      const text = next[letter];
      if (text !== undefined) next[letter] = rename(text);
    }
    return next;
  });
  // A variable without a value yet is the one that was just put in.
  const poses = file.poses.map((pose) => ({ ...pose, values: now.filter((number) => number > 0).map((number) => pose.values[number - 1] ?? "0") }));
  return { ...file, joints, poses };
}

function splice(values: string[], at: number): string[] {
  return [...values.slice(0, at), "0", ...values.slice(at)];
}

/** The same texts under another convention's letters: what turns about z stays so, and so on. Another arm, usually. */
export function reinterpret(file: RobotFile, to: Convention): RobotFile {
  const from = file.convention;
  const joints = file.joints.map((row) => {
    const { d, r, a, gamma, b, ...rest } = row;
    const alongZ = from === "khalil" ? r : d;
    const alongX = from === "khalil" ? d : a;
    const next: Row = { ...rest };
    if (alongZ !== undefined) next[slide(to)] = alongZ;
    if (alongX !== undefined) next[to === "khalil" ? "d" : "a"] = alongX;
    if (to === "khalil") Object.assign(next, gamma !== undefined && { gamma }, b !== undefined && { b });
    return next;
  });
  return { ...file, convention: to, joints };
}
