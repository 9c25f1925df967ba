// What the check says, claim by claim.

import type { ComponentChildren } from "preact";
import type { Checked, Claim, Entry, Place, Verdict } from "../engine/types.ts";
import { signed } from "../formula/number.ts";
import { look, robot } from "../state.ts";
import { formatWithUnit } from "../units.ts";
import { Callout } from "../widgets/callout.tsx";
import { type Piece, patched } from "./text.ts";

/** In words for one claim, and for a number of them. */
const VERDICTS: Record<Verdict, { words: string; counted: string; path: string }> = {
  equal: { words: "proved equal", counted: "proved", path: "M3.5 9.5 7.3 13.2 14.5 5.5" },
  wrong: { words: "wrong", counted: "wrong", path: "M4.5 4.5l9 9M13.5 4.5l-9 9" },
  conditional: { words: "right under a condition", counted: "right under a condition", path: "M3 9c2-4 4-4 6 0s4 4 6 0" },
  carried: { words: "carried from an earlier error", counted: "carried", path: "M3 5h7v7M10 12l-2.5-2.5M10 12l2.5-2.5" },
  undecided: { words: "not decided", counted: "not decided", path: "M6 6.5a3 3 0 1 1 4.2 2.8c-.8.4-1.2.9-1.2 1.9M9 14v.1" },
  unreadable: { words: "cannot be read", counted: "not readable", path: "M9 4v6.5M9 13.8v.1" },
};
const ORDER: Verdict[] = ["wrong", "carried", "conditional", "undecided", "unreadable", "equal"];

interface Context {
  text: string;
  at: (byte: number) => number;
  select: (place: Place, claim: number | null) => void;
}

export function VerdictIcon({ verdict }: { verdict: Verdict }) {
  return (
    <svg class={`verdict-icon verdict-${verdict}`} width="18" height="18" viewBox="0 0 18 18" fill="none" stroke="currentColor" stroke-width="2" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">
      <path d={VERDICTS[verdict].path} />
    </svg>
  );
}

/** What is equal and not proved agrees with the digits that are printed. */
const IN_NUMBERS = "right in numbers";

/** `3 claims: 1 wrong, 2 proved.` */
export function tallyWords(checked: Checked): string {
  const count = checked.claims.length;
  if (count === 0) return "No claim about the robot was found in this text.";
  const inNumbers = checked.claims.filter((claim) => claim.verdict === "equal" && !claim.proved).length;
  const counts = ORDER.map((verdict) => ({ count: checked.tally[verdict] - (verdict === "equal" ? inNumbers : 0), words: VERDICTS[verdict].counted }));
  counts.push({ count: inNumbers, words: IN_NUMBERS });
  const parts = counts.filter(({ count }) => count > 0).map(({ count, words }) => `${count} ${words}`);
  const open = checked.tally.unjudged;
  const rest = open === 0 ? "" : ` ${open} ${open === 1 ? "line" : "lines"} not judged.`;
  return `${count} ${count === 1 ? "claim" : "claims"}: ${parts.join(", ")}.${rest}`;
}

export function Claims({ checked, context, chosen }: { checked: Checked; context: Context; chosen: number | null }) {
  return (
    <>
      {checked.causes.map((cause, k) => (
        <Callout key={k} tone="warning">
          <span>
            <strong>{sentence(cause.change)}</strong> would turn right: {cause.turns_right.join(", ")}.
          </span>
        </Callout>
      ))}
      <ul class="claims">
        {checked.claims.map((claim, k) => (
          <ClaimItem key={k} claim={claim} index={k} context={context} isChosen={k === chosen} />
        ))}
      </ul>
      {checked.unjudged.length > 0 && (
        <details class="section" open>
          <summary>
            Not judged <span class="fine">{checked.unjudged.length}</span>
          </summary>
          <ul class="check-notes">
            {checked.unjudged.map((line, k) => (
              <li key={k} class="warning">
                <PlaceButton place={line.at} context={context} />
                <span>
                  <code>{line.text}</code> <span class="quiet">{line.why}</span>
                </span>
              </li>
            ))}
          </ul>
        </details>
      )}
      {checked.notes.length > 0 && (
        <details class="section" open={checked.claims.length === 0}>
          <summary>
            Notes on the text <span class="fine">{checked.notes.length}</span>
          </summary>
          <ul class="check-notes">
            {checked.notes.map((note, k) => (
              <li key={k} class={note.severity}>
                <PlaceButton place={note.at} context={context} />
                <span>
                  {note.message} {note.hint && <span class="quiet">{note.hint}</span>}
                </span>
              </li>
            ))}
          </ul>
        </details>
      )}
    </>
  );
}

function ClaimItem({ claim, index, context, isChosen }: { claim: Claim; index: number; context: Context; isChosen: boolean }) {
  const told = claim.entries.filter((entry) => entry.verdict !== "equal" || (entry.unless_zero?.length ?? 0) > 0);
  const right = claim.entries.length - claim.entries.filter((entry) => entry.verdict !== "equal").length;
  return (
    <li class={`claim claim-${claim.verdict}`}>
      <button type="button" class="claim-head" aria-pressed={isChosen} title="Show it in the text" onClick={() => context.select(claim.at, index)}>
        <VerdictIcon verdict={claim.verdict} />
        <span class="claim-name">{claim.claim}</span>
        <span class="claim-verdict">{claim.verdict === "equal" && !claim.proved ? IN_NUMBERS : VERDICTS[claim.verdict].words}</span>
        <span class="claim-about">
          {claim.about}, line {claim.at.line}
          {claim.entries.length > 1 && told.length > 0 && `; ${right} of ${claim.entries.length} entries right`}
        </span>
      </button>
      {told.map((entry, k) => (
        <EntryView key={k} entry={entry} context={context} />
      ))}
      {claim.remarks.map((remark, k) => (
        <p key={k} class="claim-remark">
          {sentence(remark)}
        </p>
      ))}
    </li>
  );
}

function EntryView({ entry, context }: { entry: Entry; context: Context }) {
  const pieces = entry.slip ? patched(entry, entry.slip, context.text, context.at) : null;
  const { counterexample } = entry;
  return (
    <dl class="entry">
      {entry.row !== undefined && (
        <Row label="Entry">
          row {entry.row}, column {entry.column}
        </Row>
      )}
      <Row label="Printed" code>
        {pieces ? <Pieces pieces={pieces} /> : entry.printed}
      </Row>
      {entry.slip && <Row label="The slip">{entry.slip.words}</Row>}
      {entry.correct && (
        <Row label="Right" code>
          {entry.correct}
        </Row>
      )}
      {entry.condition && <Row label="Right if">{entry.condition}</Row>}
      {entry.holds_if && <Row label="Holds if">{entry.holds_if}</Row>}
      {entry.why && <Row label="Why">{entry.why}</Row>}
      {entry.difference && (
        <Row label="Difference" code>
          {entry.difference}
        </Row>
      )}
      {counterexample && (
        <Row label="For example">
          {Object.entries(counterexample.at).map(([name, value]) => `${name} = ${measured(name, value)}`).join(", ")}: printed {number(counterexample.printed)}, right {number(counterexample.right)}
        </Row>
      )}
      {entry.unless_zero && entry.unless_zero.length > 0 && (
        <Row label="Unless zero" code>
          {entry.unless_zero.join(", ")}
        </Row>
      )}
      {entry.remarks?.map((remark, k) => (
        <Row key={k} label="Remark">
          {remark}
        </Row>
      ))}
      {entry.errors?.map((error, k) => (
        <Row key={k} label="Error">
          <PlaceButton place={error.at} context={context} /> {error.message} {error.hint && <span class="quiet">{sentence(error.hint)}</span>}
        </Row>
      ))}
    </dl>
  );
}

function Row({ label, code, children }: { label: string; code?: boolean; children: ComponentChildren }) {
  return (
    <div>
      <dt>{label}</dt>
      {/* A long formula scrolls in its own box. */}
      {code ? (
        <dd>
          <div class="formula-text" tabIndex={0} role="group" aria-label={label}>
            {children}
          </div>
        </dd>
      ) : (
        <dd>{children}</dd>
      )}
    </div>
  );
}

/** What is too much struck through, what was missing set in. */
function Pieces({ pieces }: { pieces: Piece[] }) {
  return (
    <>
      {pieces.map((piece, k) =>
        piece.kind === "same" ? (
          piece.text
        ) : (
          <span key={k} class="slip">
            {piece.was && (
              <del>
                <span class="spoken">printed </span>
                {piece.was}
              </del>
            )}
            {piece.now ? (
              <ins>
                <span class="spoken"> should be </span>
                {piece.now}
              </ins>
            ) : (
              <span class="spoken"> too much </span>
            )}
          </span>
        ),
      )}
    </>
  );
}

function PlaceButton({ place, context }: { place: Place; context: Context }) {
  return (
    <button type="button" class="place" title="Show it in the text" onClick={() => context.select(place, null)}>
      {place.line}:{place.column}
    </button>
  );
}

/** Joints and parameters in the units shown; what is not known by name stays as it is. */
function measured(name: string, value: number): string {
  const joint = robot.value?.joints.find((one) => one.name === name);
  const measure = joint ? (joint.kind === "R" ? "angle" : "length") : robot.value?.parameters.find((one) => one.name === name)?.measure;
  return measure ? formatWithUnit(value, measure, look.value) : number(value);
}

function number(x: number): string {
  return signed(String(Number(x.toPrecision(6))));
}

function sentence(words: string): string {
  return words.charAt(0).toUpperCase() + words.slice(1);
}
