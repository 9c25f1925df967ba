// The game beside its picture: the question, its answers by their letters, and what is said of them.

import { file, look, robot } from "../state.ts";
import { SIGNS } from "../steps/matrix.ts";
import { lettersOf } from "../table/rows.ts";
import { format, formatWithUnit, short } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { answer, begin, canPlay, end, type Game, LETTERS, type Part, pointed, question } from "./game.ts";
import { parameters } from "./rules.ts";

export function GameButton() {
  if (!canPlay.value) return null;
  return (
    <div class="row-of-buttons">
      <Button label="Place the frames yourself" small hint="The arm without its frames: say where each one stands" onClick={begin} />
    </div>
  );
}

const ASKED: Record<Part, (frame: number) => string> = {
  origin: (frame) => `Where does frame ${frame} have its origin?`,
  z: (frame) => `Which way does z of frame ${frame} go?`,
  x: (frame) => `Which way does x of frame ${frame} go?`,
};

/** What the convention asks for, once and in short. */
function rule(standard: boolean): string {
  return standard
    ? "Standard convention: z of frame i lies on the axis of joint i + 1; x of frame i meets z of the frame before at a right angle."
    : "Modified convention: z of frame i lies on the axis of joint i; x of frame i meets the axis of joint i + 1 at a right angle.";
}

export function GamePanel({ now }: { now: Game }) {
  const asked = question.value;
  const last = now.arm.frames.length - 1;
  return (
    <section class="game" aria-label="Place the frames">
      <div class="heading">
        <h2>Place the frames</h2>
        <Button label="Begin anew" icon="reset" small onClick={begin} />
        <Button label="End" icon="close" small onClick={end} />
      </div>
      <p class="fine">{rule(now.arm.convention === "standard")} Frame 0 is given.</p>
      <p class="fine" role="status">
        {now.placed.length - 1} of {last} frames stand; {now.slips === 0 ? "no slip" : now.slips === 1 ? "1 slip" : `${now.slips} slips`} so far.
      </p>
      {asked && (
        <>
          <h3>{ASKED[asked.part](asked.frame)}</h3>
          <ul class="answers" aria-label="Answers">
            {asked.choices.map(({ value }, k) => (
              <li key={k}>
                <button
                  type="button"
                  class="button answer"
                  aria-label={`${LETTERS[k]}, ${placeOf(value, asked.part)}${now.tried.includes(k) ? ", wrong" : ""}`}
                  onPointerEnter={() => (pointed.value = k)}
                  onPointerLeave={() => (pointed.value = null)}
                  onFocus={() => (pointed.value = k)}
                  onBlur={() => (pointed.value = null)}
                  onClick={() => answer(k)}
                >
                  <b>{LETTERS[k]}</b>
                  <span class="fine number">{placeOf(value, asked.part)}</span>
                  {now.tried.includes(k) && <span class="tag warn">wrong</span>}
                </button>
              </li>
            ))}
          </ul>
        </>
      )}
      {now.said && (
        <Callout tone={now.said.right ? "good" : "warning"} alert>
          <span>{now.said.words}</span>
        </Callout>
      )}
      {!asked && <Outcome now={now} />}
    </section>
  );
}

/** A point in the units shown, or a direction: in the base. */
function placeOf(value: readonly number[], part: Part): string {
  return `(${value.map((x) => (part === "origin" ? format(x, "length", look.value, look.value.lengths === "mm" ? 0 : 3) : short(x, 2))).join(", ")})`;
}

/** The table that the placed frames give. */
function Outcome({ now }: { now: Game }) {
  const { convention } = now.arm;
  const letters = lettersOf(convention);
  const rows = now.placed.slice(1).map((frame, k) => parameters(convention, now.placed[k], frame));
  return (
    <>
      <h3>All frames stand{now.slips === 0 ? ", without a slip" : ""}. They give this table</h3>
      <div class="scrolled">
        <table class="numbers" aria-label="The table of the placed frames">
          <thead>
            <tr>
              <td />
              {letters.map((letter) => (
                <th key={letter} scope="col">
                  {SIGNS[letter]}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.map(({ theta, d, a, alpha }, k) => (
              <tr key={k}>
                <th scope="row">{k + 1}</th>
                {letters.map((letter) => {
                  const isOfZ = letter === "r" || (letter === "d" && convention !== "khalil");
                  const value = letter === "theta" ? theta : letter === "alpha" ? alpha : isOfZ ? d : a;
                  return (
                    <td key={letter} class="number">
                      {formatWithUnit(value, letter === "theta" || letter === "alpha" ? "angle" : "length", look.value)}
                    </td>
                  );
                })}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="fine">
        As {file.value.name || "the arm"} stands now: θ of a joint that turns and {convention === "khalil" ? "r" : "d"} of one that slides hold its variable
        {robot.value?.joints[0] ? `, ${robot.value.joints[0].name} in the first row` : ""}. Other right answers give another table of the same arm.
      </p>
    </>
  );
}
