// The checked text: from bytes to characters, and the parts that are marked.

import type { Checked, Entry, Place, Slip, Verdict } from "../engine/types.ts";

/** Turns offsets in UTF-8 into offsets in the string. */
export function characters(text: string): (byte: number) => number {
  const bytes = new TextEncoder().encode(text);
  if (bytes.length === text.length) return (byte) => Math.min(byte, text.length);
  const decoder = new TextDecoder();
  return (byte) => decoder.decode(bytes.subarray(0, Math.min(byte, bytes.length))).length;
}

export interface Span {
  from: number;
  to: number;
  verdict: Verdict;
  claim: number;
}

/** The formulas in the text with their verdicts, in order and without overlap. */
export function spans(checked: Checked, text: string): Span[] {
  const at = characters(text);
  const all = checked.claims.flatMap((claim, k) =>
    (claim.entries.length > 0 ? claim.entries : [claim]).map(({ at: { bytes }, verdict }) => ({ from: at(bytes[0]), to: at(bytes[1]), verdict, claim: k })),
  );
  all.sort((a, b) => a.from - b.from || a.to - b.to);
  const out: Span[] = [];
  for (const span of all) {
    const before = out.at(-1)?.to ?? 0;
    if (span.from >= before && span.to > span.from) out.push(span);
  }
  return out;
}

export type Piece = { kind: "same"; text: string } | { kind: "change"; was: string; now: string };

/** A printed formula with the patches of its slip; nothing if the slip lies elsewhere. */
export function patched(entry: Entry, slip: Slip, text: string, at: (byte: number) => number): Piece[] | null {
  const [from, to] = range(entry.at, at);
  const pieces: Piece[] = [];
  let done = from;
  for (const patch of [...slip.patches].sort((a, b) => a.at.bytes[0] - b.at.bytes[0])) {
    const [first, last] = range(patch.at, at);
    if (first < done || last > to) return null;
    if (first > done) pieces.push({ kind: "same", text: text.slice(done, first) });
    pieces.push({ kind: "change", was: text.slice(first, last), now: patch.now });
    done = last;
  }
  if (to > done) pieces.push({ kind: "same", text: text.slice(done, to) });
  return pieces;
}

export function range(place: Place, at: (byte: number) => number): [number, number] {
  return [at(place.bytes[0]), at(place.bytes[1])];
}

/** Under which name the engine reads a text: the ending says how. */
export type Kind = "detect" | "md" | "tex" | "py" | "m";

export function documentName(text: string, kind: Kind): string {
  return `document.${kind === "detect" ? detected(text) : kind}`;
}

/** Programs are known by their looks here; Markdown and LaTeX the engine tells apart by itself. */
function detected(text: string): "txt" | "py" | "m" {
  if (/^\s*```/m.test(text) || text.includes("\\begin{")) return "txt";
  if (/^\s*def \w+\(.*\).*:\s*$/m.test(text) || /^\s*(import|from) \w+/m.test(text)) return "py";
  if (/^\s*function\b.*=/m.test(text) || /=.*;\s*(%.*)?$/m.test(text)) return "m";
  return "txt";
}
