// From frame to frame: buttons that make the steps of a row one after another, and the transform of the row as they fill it in.

import { useEffect, useState } from "preact/hooks";
import type { Step } from "../engine/types.ts";
import { look, scene, selected, stale } from "../state.ts";
import { rowNow } from "../scene/row.ts";
import { format, short } from "../units.ts";
import { Segments } from "../widgets/button.tsx";
import { Slider } from "../widgets/slider.tsx";
import { frameNow, canStep, doneNow, isTurn, put, run, running, step, stepNow, stepsNow } from "./walk.ts";
import { inLetters, seenFrom, SIGNS, written } from "./matrix.ts";

const DRAWINGS = {
  play: "M5 3l10 6-10 6Z",
  back: "M13 3 3 9l10 6Z",
  pause: "M4.5 3.5h3v11h-3zM10.5 3.5h3v11h-3z",
  next: "M4 3.5 11 9l-7 5.5ZM12 3.5h2.5v11H12z",
  last: "M14 3.5 7 9l7 5.5ZM3.5 3.5H6v11H3.5z",
};

function Key({ drawing, label, disabled, onClick }: { drawing: keyof typeof DRAWINGS; label: string; disabled?: boolean; onClick(): void }) {
  return (
    <button type="button" class="button icon small" aria-label={label} title={label} aria-disabled={disabled ? "true" : undefined} onClick={() => disabled || onClick()}>
      <svg width="16" height="16" viewBox="0 0 18 18" fill="currentColor" aria-hidden="true">
        <path d={DRAWINGS[drawing]} />
      </svg>
    </button>
  );
}

/** Play and pause both ways, and a step at a time. */
export function StepKeys() {
  const way = running.value;
  const isThere = scene.value !== null && !stale.value;
  return (
    <div class="step-keys" role="group" aria-label="Steps from frame to frame">
      <Key drawing={way < 0 ? "pause" : "back"} label={way < 0 ? "Pause the steps" : "Play the steps backwards"} disabled={!isThere} onClick={() => run(-1)} />
      <Key drawing="last" label="A step back" disabled={!isThere || !canStep(-1)} onClick={() => step(-1)} />
      <Key drawing="next" label="A step forward" disabled={!isThere || !canStep(1)} onClick={() => step(1)} />
      <Key drawing={way > 0 ? "pause" : "play"} label={way > 0 ? "Pause the steps" : "Play the steps"} disabled={!isThere} onClick={() => run(1)} />
    </div>
  );
}

/** What the frame does now, in words: they change once a step. */
function wordsOf(): string {
  const [row, done, k] = [selected.value, doneNow.value, stepNow.value];
  if (row === null || done === null) return "";
  if (k === null) return `At frame ${row}.`;
  const said = rowNow.value[k];
  if (!said) return "";
  const end = done >= stepsNow.value.length ? ` The frame is frame ${row + 1}.` : "";
  const value = `${said.sign} = ${said.cell && !said.isZero ? `${said.cell} = ` : ""}${said.number}`;
  return `Step ${k + 1}: ${said.shape === "turn" ? "turned about" : "moved along"} ${said.axis.name}${said.axis.index} by ${value}${said.isZero ? ", which is nothing" : ""}.${end}`;
}

/** `Rz(θ) · Tz(d)`, with the step that is being made in its colour. */
function Product({ steps }: { steps: Step[] }) {
  const [now, done] = [stepNow.value, doneNow.value ?? steps.length];
  return (
    <p class="steps-product">
      {steps.map((one, k) => {
        const names = [k === now ? `now letter-${rowNow.value[k]?.hue ?? ""}` : "", k >= Math.ceil(done) ? "ahead" : ""];
        return (
          <span key={one.letter}>
            {k > 0 && " · "}
            <span class={names.filter(Boolean).join(" ") || undefined}>
              {isTurn(one) ? "R" : "T"}
              <sub>{one.axis}</sub>({SIGNS[one.letter]})
            </span>
          </span>
        );
      })}
    </p>
  );
}

/** The product of the steps that are done, or being made. */
function Filled({ row, steps, kind }: { row: number; steps: Step[]; kind: "letters" | "numbers" }) {
  const done = doneNow.value ?? steps.length;
  const count = Math.ceil(done);
  const [letters, before] = [inLetters(steps, count), inLetters(steps, Math.max(0, count - 1))];
  const start = scene.value?.frames[row];
  const pose = frameNow.value ?? scene.value?.frames[row + 1];
  const numbers = start && pose ? seenFrom(start, pose) : null;
  const hue = doneNow.value === null || count === 0 ? "" : `letter-${rowNow.value[count - 1]?.hue ?? ""}`;
  return (
    <div class="scrolled">
      <table class={`matrix steps-matrix ${kind}`} aria-label={`Transform of row ${row + 1}, ${count} of ${steps.length} steps done, in ${kind}`}>
        <tbody>
          {letters.map((line, r) => (
            <tr key={r}>
              {line.map((entry, c) => {
                const text = kind === "letters" ? written(entry) : numbers && r < 3 ? (c < 3 ? short(numbers[r][c], 4) : format(numbers[r][c], "length", look.value)) : written(entry);
                return (
                  <td key={c} class={hue && written(entry) !== written(before[r][c]) ? `${hue} now` : undefined}>
                    {text}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** Under the table: the way from the frame before the selected row to that behind it. */
export function Steps() {
  const [kind, setKind] = useState<"letters" | "numbers">("letters");
  useEffect(() => () => void (running.value = 0), []);
  const row = selected.value;
  const steps = stepsNow.value;
  const words = wordsOf();
  return (
    <section class="section-plain steps" aria-label="From frame to frame">
      <div class="heading">
        <h3>{row === null ? "From frame to frame" : `From frame ${row} to frame ${row + 1}`}</h3>
        <StepKeys />
      </div>
      {row !== null && steps.length > 0 && (
        <>
          <Slider
            label="Steps that are done"
            value={doneNow.value ?? steps.length}
            range={[0, steps.length]}
            measure="number"
            step={1}
            text={words || `all ${steps.length} steps`}
            onChange={(done) => put(row, done)}
          />
          <div class="heading">
            <Product steps={steps} />
            <Segments
              label="The transform in"
              options={[
                { value: "letters" as const, label: "Letters" },
                { value: "numbers" as const, label: "Numbers" },
              ]}
              value={kind}
              onChange={(next) => setKind(next)}
            />
          </div>
          <Filled row={row} steps={steps} kind={kind} />
          {kind === "letters" && <p class="fine">c and s are cosine and sine.</p>}
        </>
      )}
      <p class="fine steps-words" role="status">
        {words || "The frame goes from one to the next: a turn or a way at a time."}
      </p>
    </section>
  );
}

