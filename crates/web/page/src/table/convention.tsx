// The convention, and the two ways to another one: the same arm in other numbers, or the same numbers read otherwise.

import { useState } from "preact/hooks";
import type { Convention, Output } from "../engine/types.ts";
import { change, engine, file, note, said, stale } from "../state.ts";
import { carry } from "../tree/open.ts";
import { Button } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { sentence, Words } from "../widgets/words.tsx";
import { flush } from "./cells.ts";
import { reinterpret } from "./rows.ts";

export const CONVENTIONS: { value: Convention; label: string; product: string }[] = [
  { value: "standard", label: "Standard (Denavit–Hartenberg)", product: "Rz(θ) · Tz(d) · Tx(a) · Rx(α)" },
  { value: "craig", label: "Modified (Craig)", product: "Rx(α) · Tx(a) · Rz(θ) · Tz(d)" },
  { value: "khalil", label: "Modified (Khalil–Kleinfinger)", product: "Rx(α) · Tx(d) · Rz(θ) · Tz(r)" },
];

export function ConventionChoice() {
  const [wanted, setWanted] = useState<Convention | null>(null);
  const [outcome, setOutcome] = useState<Output<"convert"> | null>(null);
  const now = file.value.convention;
  const shown = wanted && wanted !== now ? wanted : now;
  const label = CONVENTIONS.find((one) => one.value === shown)?.label ?? shown;

  const convert = () => {
    try {
      flush();
      const answer = engine().now.call("convert", { to: shown });
      // The arm stays, and so does the tree that it is a chain of.
      if (answer.proved) carry(answer.file);
      change(answer.file);
      setOutcome(answer);
      note("The table is converted; the arm is the same.");
      setWanted(null);
    } catch (why) {
      said(why);
    }
  };
  const read = () => {
    flush();
    change(reinterpret(file.value, shown));
    setOutcome(null);
    setWanted(null);
    note("The same cells are read in another convention; the arm is usually another one.");
  };

  return (
    <div class="convention">
      <label class="beside">
        <span class="fine">Convention</span>
        <select
          class="field"
          value={shown}
          onChange={(event) => {
            setOutcome(null);
            setWanted(event.currentTarget.value as Convention);
          }}
        >
          {CONVENTIONS.map((one) => (
            <option key={one.value} value={one.value}>
              {one.label}
            </option>
          ))}
        </select>
      </label>
      <p class="fine product">{CONVENTIONS.find((one) => one.value === shown)?.product}</p>
      {shown !== now && (
        <div class="choice" role="group" aria-label={`Change to ${label}`}>
          <Button label="Convert the table" kind="main" small disabled={stale.value} hint="Other numbers for the same arm" onClick={convert} />
          <Button label="Read these cells so" small hint="The same numbers in the other convention: usually another arm" onClick={read} />
          <Button label="Leave it" kind="plain" small onClick={() => setWanted(null)} />
          <p class="fine">
            Converting keeps the arm and changes the numbers{stale.value ? " (once the table has no errors)" : ""}; reading keeps the numbers, and the
            arm is usually another one.
          </p>
        </div>
      )}
      {outcome?.file === file.value && (
        <Callout tone={outcome.proved ? "good" : "note"} alert>
          <span>
            <Words text={sentence(outcome.words)} />
          </span>
          <span class="fine">{outcome.proved ? "Proved: both tables give the same pose of the tool for all joint values." : "Not proved; compared by numbers."}</span>
        </Callout>
      )}
    </div>
  );
}
