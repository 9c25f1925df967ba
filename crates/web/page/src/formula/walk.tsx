// A derivation step by step: one formula after another, what comes behind it hidden, and the arm showing what each is about: its joints, the
// row of a link transform, the coordinate that a name stands for.

import type { RefObject } from "preact";
import { useEffect, useState } from "preact/hooks";
import { batch, highlighted, revision, robot, scene, selected } from "../state.ts";
import { Button } from "../widgets/button.tsx";
import type { Symbols } from "./marks.ts";
import { component, meaningOf, meant, wordsOf } from "./meaning.ts";
import type { CurrentValues } from "./values.ts";

/** What appears with the formulas: all that stands by itself in the document. */
const PARTS = "h2, h3, h4, p, ul, dl, figure, .table-box, .formula-line, .tree";

const linesOf = (root: Element): HTMLElement[] => [...root.querySelectorAll<HTMLElement>(".formula-line")];

function lowered(digits: string): number {
  return Number([...digits].map((one) => "₀₁₂₃₄₅₆₇₈₉".indexOf(one)).join(""));
}

function raised(digits: string): number {
  return Number([...digits].map((one) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(one)).join(""));
}

/** The row (from 0) whose transform a formula is. */
function rowOf(text: string): number | null {
  const [, from, to] = /^([⁰¹²³⁴⁵⁶⁷⁸⁹]+)T([₀₁₂₃₄₅₆₇₈₉]+) =/.exec(text) ?? [];
  return from !== undefined && to !== undefined && lowered(to) === raised(from) + 1 ? raised(from) : null;
}

function nothing(): void {
  batch(() => {
    meant.value = null;
    selected.value = null;
    highlighted.value = new Set();
  });
}

interface WalkProps {
  root: RefObject<HTMLDivElement | null>;
  symbols: RefObject<Symbols | null>;
  values: CurrentValues | null;
}

export function Walk({ root, symbols, values }: WalkProps) {
  const [at, setAt] = useState<number | null>(null);
  const [said, say] = useState("");
  const [count, setCount] = useState(0);

  useEffect(() => {
    const element = root.current;
    const lines = element ? linesOf(element) : [];
    setCount(lines.length);
    if (!element || at === null) return;
    const now = lines[Math.min(at, lines.length - 1)];
    if (!now) return;
    const parts = [...element.querySelectorAll(PARTS)];
    for (const part of parts) part.classList.toggle("walk-ahead", part !== now && !!(now.compareDocumentPosition(part) & Node.DOCUMENT_POSITION_FOLLOWING) && !now.contains(part));
    now.classList.add("walk-now");
    now.scrollIntoView({ block: "nearest" });
    say(shown(now, symbols.current, values));
    return () => {
      now.classList.remove("walk-now");
      for (const part of parts) part.classList.remove("walk-ahead");
      nothing();
    };
  }, [at, revision.value]);

  const step = (by: 1 | -1) => setAt((old) => Math.min(count - 1, Math.max(0, (old ?? 0) + by)));
  if (count < 2) return null;
  if (at === null) {
    return (
      <div class="row-of-buttons walk">
        <Button label="Step by step" small hint="One formula after another, and what each is about in the picture" onClick={() => setAt(0)} />
      </div>
    );
  }
  return (
    <div class="walk walking" role="group" aria-label="Step by step">
      <div class="row-of-buttons">
        <Button label="Back" small disabled={at === 0} onClick={() => step(-1)} />
        <Button label="Next" kind="main" small disabled={at >= count - 1} onClick={() => step(1)} />
        <span class="number fine">
          {at + 1} of {count}
        </span>
        <span class="space" />
        <Button label="Show all" small onClick={() => setAt(null)} />
      </div>
      <p class="fine" role="status">
        {said}
      </p>
    </div>
  );
}

/** Shows in the picture what a formula is about; says it. */
function shown(line: HTMLElement, symbols: Symbols | null, values: CurrentValues | null): string {
  const box = line.querySelector(".formula-box");
  const [name, text] = [box?.getAttribute("aria-label") ?? "", box?.querySelector("math")?.getAttribute("alttext") ?? ""];
  const joints = new Set(box ? (symbols?.within(box).flatMap((symbol) => symbols.joints(symbol)) ?? []) : []);
  const row = rowOf(text);
  const now = scene.peek();
  const meaning = meaningOf(name);
  // A name is drawn as what its number shows it to be: of an entry of the matrix that is so by definition.
  const number = values?.now(name);
  const length = meaning && now ? component(meaning, now) : null;
  const isSo = meaning !== null && length !== null && (number === undefined ? name.startsWith("t") : Math.abs(number - length) < 1e-9 * Math.max(1, Math.abs(length)));
  batch(() => {
    selected.value = row !== null && row < (robot.peek()?.rows ?? 0) ? row : null;
    highlighted.value = row === null ? joints : new Set();
    meant.value = isSo ? meaning : null;
  });
  const words: string[] = [];
  if (row !== null) words.push(`Row ${row + 1}: from frame ${row} to frame ${row + 1}.`);
  if (isSo && meaning) words.push(`${name} is ${wordsOf(meaning)}.`);
  if (joints.size > 0 && row === null) {
    const names = [...joints].sort((a, b) => a - b).map((k) => robot.peek()?.joints[k]?.name ?? String(k + 1));
    words.push(`It is about ${names.join(", ")}.`);
  }
  return words.join(" ");
}
