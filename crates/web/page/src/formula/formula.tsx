// Formulas on lines of their own: each in a box that scrolls, with its number, its proof and its current value.

import { computed } from "@preact/signals";
import type { RefObject } from "preact";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import type { Block, Formula } from "../engine/types.ts";
import { CopyButton, copyFormulas, openCopyMenu } from "./copy.tsx";
import type { CurrentValues } from "./values.ts";

type Proof = NonNullable<Extract<Block, { kind: "formula" }>["proof"]>;

const PROOFS: Record<Proof, { mark: string; words: string }> = {
  proved: { mark: "✓", words: "proved" },
  sampled: { mark: "≈", words: "checked at sample poses" },
  wrong: { mark: "✗", words: "not true" },
};

export function ProofMark({ proof }: { proof: Proof }) {
  const { mark, words } = PROOFS[proof];
  return (
    <span class={`proof proof-${proof}`} role="img" aria-label={words} title={words}>
      {mark}
    </span>
  );
}

export function FormulaLine(props: { formula: Formula; number?: number; proof?: Proof; values: CurrentValues | null  }) {
  const { formula, number, proof, values } = props;
  // The same list each time: the menu knows its formulas by identity.
  const all = useRef<Formula[]>([formula]);
  if (all.current[0] !== formula) all.current = [formula];
  const name = formula.name ?? (number === undefined ? "formula" : `formula ${number}`);
  return (
    <div class="formula-line">
      <div
        class="formula-box"
        tabIndex={0}
        role="group"
        aria-label={name}
        aria-roledescription="formula"
        data-symbols=""
        onKeyDown={(event) => keys(event, all.current)}
        dangerouslySetInnerHTML={{ __html: formula.mathml }}
      />
      <div class="formula-side">
        {values && formula.name && (
          <span class="formula-value" title="At the present joints; metres and radians">
            {<Value values={values} name={formula.name} />}
          </span>
        )}
        {number !== undefined && <span class="formula-number">({number})</span>}
        {proof && <ProofMark proof={proof} />}
        <CopyButton formulas={all.current} label={`Copy ${name}`} />
      </div>
    </div>
  );
}

/** Bound to the text alone: a number changes with every frame. */
function Value({ values, name }: { values: CurrentValues; name: string }) {
  const [text, before] = useMemo(() => {
    const text = values.of(name);
    return [text, computed(() => (text.value ? "now " : ""))];
  }, [values, name]);
  return (
    <>
      <span class="spoken">{before}</span>
      {text}
    </>
  );
}

/** Enter opens the menu, the keys for copying copy in the format that was used last. */
function keys(event: KeyboardEvent, formulas: Formula[]): void {
  if (event.target !== event.currentTarget) return;
  const isCopy = (event.ctrlKey || event.metaKey) && event.key === "c" && !String(getSelection() ?? "");
  if (isCopy) void copyFormulas(formulas);
  else if (event.key === "Enter") openCopyMenu(formulas, event.currentTarget as HTMLElement);
  else return;
  event.preventDefault();
}

/** Equations below each other, aligned at their signs. */
export function Equations(props: { formulas: Formula[]; values: CurrentValues | null }) {
  const list = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => align(list), [props.formulas]);
  return (
    <div class="equations" ref={list}>
      {props.formulas.length > 1 && (
        <div class="equations-head">
          <CopyButton formulas={props.formulas} label={`Copy all ${props.formulas.length} equations`} words="Copy all" />
        </div>
      )}
      {props.formulas.map((formula, k) => (
        <FormulaLine key={k} formula={formula} values={props.values} />
      ))}
    </div>
  );
}

/** Left sides that are much wider than the others do not push them away, em. */
const WIDEST_LEFT = 6;

/** Gives all left sides the width of the widest, so that the signs of equality stand below each other. */
function align(list: RefObject<HTMLDivElement | null>): void {
  const cells = [...(list.current?.querySelectorAll<HTMLElement>(".formula-box > math > * > mtr:first-child > mtd:first-child, .formula-box > math > mtable > mtr:first-child > mtd:first-child") ?? [])];
  const em = list.current ? parseFloat(getComputedStyle(list.current).fontSize) : 16;
  const widths = cells.map((cell) => cell.getBoundingClientRect().width);
  const widest = Math.max(0, ...widths.filter((width) => width <= WIDEST_LEFT * em));
  cells.forEach((cell, k) => {
    const missing = widest - widths[k]!;
    if (missing > 0.5) cell.style.paddingLeft = `${missing}px`;
  });
}
