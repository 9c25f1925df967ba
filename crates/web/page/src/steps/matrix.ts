// The transform of a row as its steps fill it in: in letters, entry by entry, and in numbers. Each step is a turn about or a
// way along x or z, multiplied from the right (Denavit and Hartenberg 1955; the orders are those of the conventions).

import type { Letter, Matrix, Step } from "../engine/types.ts";
import { isTurn } from "./walk.ts";

/** A product of letters and functions of them, with its sign: `−sθcα`. */
interface Term {
  minus: boolean;
  factors: string[];
}
/** A sum; none is 0. */
export type Entry = Term[];

export const SIGNS: Record<Letter, string> = { theta: "θ", d: "d", a: "a", alpha: "α", r: "r", gamma: "γ", b: "b" };

const one = (...factors: string[]): Entry => [{ minus: false, factors }];
const minus = (...factors: string[]): Entry => [{ minus: true, factors }];
const NONE: Entry = [];

const identity = (): Entry[][] => [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => (r === c ? one() : NONE)));

/** The transform of a step in letters. */
function elementary({ letter, axis }: Step): Entry[][] {
  const sign = SIGNS[letter];
  const unit = identity();
  const along = axis === "x" ? 0 : 2;
  if (!isTurn({ letter })) {
    unit[along][3] = one(sign);
    return unit;
  }
  const [u, v] = [(along + 1) % 3, (along + 2) % 3];
  [unit[u][u], unit[u][v], unit[v][u], unit[v][v]] = [one(`c${sign}`), minus(`s${sign}`), one(`s${sign}`), one(`c${sign}`)];
  return unit;
}

/** Each letter stands in one step alone: products of entries have nothing to gather. */
function product(left: Entry[][], right: Entry[][]): Entry[][] {
  const times = (a: Entry, b: Entry): Entry => a.flatMap((x) => b.map((y) => ({ minus: x.minus !== y.minus, factors: [...x.factors, ...y.factors] })));
  return left.map((row) => [0, 1, 2, 3].map((c) => row.flatMap((entry, k) => times(entry, right[k][c]))));
}

/** The transform of so many steps in letters. */
export function inLetters(steps: Step[], count: number): Entry[][] {
  return steps.slice(0, count).map(elementary).reduce(product, identity());
}

/** `cθ cα`, `a sθ`, `1`, `0` */
export function written(entry: Entry): string {
  if (entry.length === 0) return "0";
  const isFunction = (factor: string) => factor.length > 1;
  const product = ({ factors }: Term) => [...factors.filter((one) => !isFunction(one)), ...factors.filter(isFunction)].join(" ") || "1";
  return entry.map((term, k) => `${term.minus ? (k > 0 ? " − " : "−") : k > 0 ? " + " : ""}${product(term)}`).join("");
}

/** A pose as it is seen from a frame: the inverse of a pose with rotation R is Rᵀ. */
export function seenFrom(frame: Matrix, pose: Matrix): Matrix {
  const inner = (r: number, c: number) => [0, 1, 2].reduce((sum, k) => sum + frame[k][r] * (pose[k][c] - (c === 3 ? frame[k][3] : 0)), 0);
  return [...[0, 1, 2].map((r) => [0, 1, 2, 3].map((c) => inner(r, c))), [0, 0, 0, 1]];
}
