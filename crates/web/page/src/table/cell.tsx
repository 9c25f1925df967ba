// A cell of the table: a text field that knows what is wrong with it, and the words for that in a row beneath.

import type { Finding } from "../engine/types.ts";
import { sentence, Words } from "../widgets/words.tsx";
import { undeclared } from "./bare.ts";
import { findingId, findingsOf, leave, settle, textOf, type } from "./cells.ts";

interface CellProps {
  /** `joints.2.theta` */
  cell: string;
  label: string;
  row?: number;
  column?: number;
  placeholder?: string;
  /** Text that is not a formula is aligned to the left. */
  words?: boolean;
  class?: string;
  onFocus?(): void;
}

export function Cell({ cell, label, row, column, placeholder, words, class: extra, onFocus }: CellProps) {
  const found = findingsOf(cell);
  const wrong = found.some((finding) => finding.severity === "error");
  const names = ["field", "cell", words ? "words" : "", extra, !wrong && found.length > 0 ? "noted" : ""];
  return (
    <input
      class={names.filter(Boolean).join(" ")}
      type="text"
      autocomplete="off"
      autocapitalize="off"
      spellcheck={false}
      aria-label={label}
      aria-invalid={wrong ? "true" : undefined}
      aria-describedby={found.length > 0 ? findingId(cell) : undefined}
      data-cell={cell}
      data-row={row}
      data-column={column}
      placeholder={placeholder}
      value={textOf(cell)}
      onInput={(event) => type(cell, event.currentTarget.value)}
      onFocus={(event) => {
        event.currentTarget.select();
        onFocus?.();
      }}
      onBlur={leave}
      onKeyDown={(event) => {
        if (event.key === "Enter") settle();
      }}
    />
  );
}

/** What is said of some cells; with the name of each where there are several. */
export function CellFindings({ cells }: { cells: { cell: string; name: string }[] }) {
  const said = cells.flatMap(({ cell, name }) => findingsOf(cell).map((finding) => ({ cell, name, finding })));
  if (said.length === 0) return null;
  return (
    <ul class="cell-findings">
      {said.map(({ cell, name, finding }, index) => (
        <li
          key={index}
          class={finding.severity}
          id={said.findIndex((other) => other.cell === cell) === index ? findingId(cell) : undefined}
        >
          {cells.length > 1 && <strong>{name}: </strong>}
          <Words text={sentence(finding.message)} />
          {hintOf(finding) && (
            <span class="hint">
              {" "}
              <Words text={sentence(hintOf(finding) ?? "")} />
            </span>
          )}
        </li>
      ))}
    </ul>
  );
}

/** A name that nobody declared becomes a parameter on this page; the engine says how to write that into a file. */
function hintOf(finding: Finding): string | null {
  const name = undeclared(finding);
  if (name === null) return finding.hint;
  const [, like] = /^did you mean (`[^`]+`)/.exec(finding.hint ?? "") ?? [];
  return `${like ? `did you mean ${like}? If not, ` : ""}\`${name}\` becomes a parameter when the cell is left`;
}
