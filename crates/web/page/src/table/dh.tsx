// The rows of the table, with what is wrong beneath the cell it is about.

import { useState } from "preact/hooks";
import type { Convention, JointKind, Letter } from "../engine/types.ts";
import { change, file, highlighted, look, note, robot, selected } from "../state.ts";
import { Button } from "../widgets/button.tsx";
import { onGridKey } from "../widgets/grid.ts";
import { Cell, CellFindings } from "./cell.tsx";
import { findingsOf, flush, textOf } from "./cells.ts";
import { SIGNS } from "../steps/matrix.ts";
import { Steps } from "../steps/player.tsx";
import { insert, lettersOf, remove, type RowKind, shift } from "./rows.ts";

/** `joint angle about z` and its colour, the one that the scene draws it in. */
const MEANING: Record<Convention, Partial<Record<Letter, { words: string; colour: string }>>> = {
  standard: {
    theta: { words: "angle about z", colour: "theta" },
    d: { words: "offset along z", colour: "d" },
    a: { words: "length along x", colour: "a" },
    alpha: { words: "twist about x", colour: "alpha" },
  },
  craig: {
    alpha: { words: "twist about x of the frame before", colour: "alpha" },
    a: { words: "length along x of the frame before", colour: "a" },
    theta: { words: "angle about z", colour: "theta" },
    d: { words: "offset along z", colour: "d" },
  },
  khalil: {
    gamma: { words: "angle about z of the frame before, at branches", colour: "theta" },
    b: { words: "offset along z of the frame before, at branches", colour: "d" },
    alpha: { words: "twist about x of the frame before", colour: "alpha" },
    d: { words: "length along x of the frame before", colour: "a" },
    theta: { words: "angle about z", colour: "theta" },
    r: { words: "offset along z", colour: "d" },
  },
};

/** Craig numbers a and α by the link before. */
function subscript(convention: Convention, letter: Letter): string {
  return convention === "craig" && (letter === "a" || letter === "alpha") ? "i−1" : convention === "khalil" ? "j" : "i";
}

export function DhTable() {
  const [branches, setBranches] = useState(false);
  const { convention, joints } = file.value;
  const used = joints.some((row) => row.gamma !== undefined || row.b !== undefined);
  const letters = lettersOf(convention, branches || used);
  return (
    <div class="dh">
      <div class="scroll">
        <table class="cells" onKeyDown={onGridKey}>
          <caption class="spoken">Denavit–Hartenberg table</caption>
          <thead>
            <tr>
              <th scope="col" class="row-number">
                <span class="symbol">{convention === "khalil" ? "j" : "i"}</span>
              </th>
              {letters.map((letter) => (
                <th key={letter} scope="col" class={`letter-${MEANING[convention][letter]?.colour}`}>
                  <span class="symbol" title={MEANING[convention][letter]?.words}>
                    {SIGNS[letter]}
                    <sub>{subscript(convention, letter)}</sub>
                  </span>
                  <span class="meaning">{short(MEANING[convention][letter]?.words)}</span>
                </th>
              ))}
            </tr>
          </thead>
          <tbody onPointerLeave={() => (highlighted.value = new Set())}>
            {joints.map((_, index) => (
              <RowCells key={index} index={index} letters={letters} />
            ))}
          </tbody>
        </table>
      </div>
      <RowTools />
      <Steps />
      <p class="fine">
        A number without a unit is in {look.value.angles === "deg" ? "degrees" : "radians"} or {look.value.lengths === "mm" ? "millimetres" : "metres"}, as the
        page shows them; <code>-pi/2</code> and formulas such as <code>q2 + 90</code> are understood, and a new name such as <code>L2</code> becomes a
        parameter.
      </p>
      {convention === "khalil" && !used && (
        <label class="check">
          <input type="checkbox" checked={branches} onChange={(event) => setBranches(event.currentTarget.checked)} /> Columns γ and b, for branches
        </label>
      )}
    </div>
  );
}

function short(words: string | undefined): string {
  return words?.replace(/ of the frame before.*/, "") ?? "";
}

/** The joint that a row introduces, in the last table without errors. */
export function jointOfRow(row: number): number | null {
  const index = robot.value?.joints.findIndex((joint) => joint.row === row) ?? -1;
  return index < 0 ? null : index;
}

function RowCells({ index, letters }: { index: number; letters: Letter[] }) {
  const joint = jointOfRow(index);
  const kind = joint === null ? null : robot.value?.joints[joint].kind;
  const lit = joint !== null && highlighted.value.has(joint);
  const chosen = selected.value === index;
  const wrong = letters.map((letter, at) => ({ letter, at, cell: `joints.${index}.${letter}` })).filter(({ cell }) => findingsOf(cell).length > 0);
  const light = () => (highlighted.value = new Set(joint === null ? [] : [joint]));
  return (
    <>
      <tr class={[lit && "lit", chosen && "chosen"].filter(Boolean).join(" ")} onPointerEnter={light}>
        <th scope="row" class="row-number">
          <button
            type="button"
            class="row-button"
            aria-pressed={chosen}
            aria-label={`Row ${index + 1}, ${kind ? KINDS[kind].toLowerCase() : "fixed"}: show its four parameters in the scene`}
            title={`${kind ? KINDS[kind] : "Fixed"}; show the four parameters in the scene`}
            onClick={() => (selected.value = chosen ? null : index)}
          >
            {index + 1}
            <KindMark kind={kind ?? null} />
          </button>
        </th>
        {letters.map((letter, at) => {
          const cell = `joints.${index}.${letter}`;
          return (
            <td key={letter}>
              <Cell
                cell={cell}
                label={`Row ${index + 1}, ${letter}`}
                row={index}
                column={at}
                placeholder="0"
                class={/\bq_?\d/.test(textOf(cell)) ? "variable" : undefined}
                onFocus={() => {
                  selected.value = index;
                  light();
                }}
              />
            </td>
          );
        })}
      </tr>
      {wrong.length > 0 && (
        <tr class="finding-row">
          <FindingCells wrong={wrong} columns={letters.length} />
        </tr>
      )}
    </>
  );
}

/** The words begin under the first cell they are about, or end under it where there is no room to the right. */
function FindingCells({ wrong, columns }: { wrong: { letter: Letter; at: number; cell: string }[]; columns: number }) {
  const first = wrong[0].at;
  const cells = wrong.map(({ cell, letter }) => ({ cell, name: SIGNS[letter] }));
  if (first < columns / 2) {
    return (
      <>
        <td colSpan={first + 1} />
        <td colSpan={columns - first}>
          <CellFindings cells={cells} />
        </td>
      </>
    );
  }
  return (
    <>
      <td colSpan={first + 2} class="to-the-right">
        <CellFindings cells={cells} />
      </td>
      {first + 1 < columns && <td colSpan={columns - first - 1} />}
    </>
  );
}

const KINDS: Record<JointKind, string> = { R: "Revolute", P: "Prismatic" };

/** A circle turns, a square slides, a dash is fixed. */
function KindMark({ kind }: { kind: JointKind | null }) {
  return (
    <svg width="9" height="9" viewBox="0 0 10 10" fill="none" stroke="currentColor" stroke-width="1.6" aria-hidden="true">
      {kind === "R" ? <circle cx="5" cy="5" r="3.6" /> : kind === "P" ? <rect x="1.6" y="1.6" width="6.8" height="6.8" /> : <path d="M1 5h8" />}
    </svg>
  );
}

function RowTools() {
  const rows = file.value.joints.length;
  const at = selected.value !== null && selected.value < rows ? selected.value : null;
  const add = (kind: RowKind) => {
    flush();
    const after = at ?? rows - 1;
    change(insert(file.value, after, kind));
    selected.value = after + 1;
  };
  const take = () => {
    if (at === null) return;
    flush();
    const { file: next, coupled } = remove(file.value, at);
    change(next);
    selected.value = next.joints.length === 0 ? null : Math.min(at, next.joints.length - 1);
    note(coupled ? `Row ${at + 1} is gone; rows that were coupled with its joint have 0 there.` : `Row ${at + 1} is gone.`);
  };
  const swap = (by: -1 | 1) => {
    if (at === null || at + by < 0 || at + by >= rows) return;
    flush();
    change(shift(file.value, at, by));
    selected.value = at + by;
  };
  const which = at === null ? "" : ` row ${at + 1}`;
  return (
    <div class="row-tools" role="group" aria-label="Rows">
      <Button label="Revolute" icon="plus" small hint={at === null ? "Add a revolute joint at the end" : `Add a revolute joint after row ${at + 1}`} onClick={() => add("revolute")} />
      <Button label="Prismatic" icon="plus" small onClick={() => add("prismatic")} />
      <Button label="Fixed" icon="plus" small hint="Add a row without a joint" onClick={() => add("fixed")} />
      <span class="space" />
      <Button label={`Move${which} up`} icon="up" bare small kind="plain" disabled={at === null || at === 0} onClick={() => swap(-1)} />
      <Button label={`Move${which} down`} icon="down" bare small kind="plain" disabled={at === null || at === rows - 1} onClick={() => swap(1)} />
      <Button label={`Remove${which}`} icon="trash" bare small kind="plain" disabled={at === null} onClick={take} />
    </div>
  );
}
