// All inverse solutions of the hand's pose, as a list that arrow keys go through.

import type { TargetedKeyboardEvent } from "preact";
import { useState } from "preact/hooks";
import type { Answer, Family, Motion, Solution } from "../engine/types.ts";
import { answerNow, batch, ghost, highlighted, look, move, q, robot, solvedIn, solving, target } from "../state.ts";
import { format, formatWithUnit, short } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { Slider } from "../widgets/slider.tsx";
import { sentence, Words } from "../widgets/words.tsx";
import { JointSymbol, measureOf } from "./joints.tsx";
import { byKey } from "../widgets/keys.ts";

/** The arm in another configuration with the hand where it is: the list stays as it is. */
function take(next: number[], answer: Answer): void {
  batch(() => {
    target.value ??= answer.pose;
    q.value = next;
  });
}

export function SolutionsList() {
  const answer = answerNow.value;
  return (
    <section class="section-plain" aria-label="Inverse solutions" aria-busy={solving.value}>
      <div class="heading">
        <h3>{answer ? heading(answer) : "Inverse solutions"}</h3>
        <span class="fine number">{solving.value ? "solving …" : answer && solvedIn.value !== null ? took(solvedIn.value, answer) : ""}</span>
      </div>
      {answer ? <Found answer={answer} /> : <p class="fine">{solving.value ? "The first time a robot is solved, its formulas are derived." : "No answer yet."}</p>}
    </section>
  );
}

/** The members of a curve stand about so far from one another, radians of all joints together. */
const NEAR = 0.5;

/** More self-motions than this are shown when asked for. */
const MANY = 6;

function Found({ answer }: { answer: Answer }) {
  const { solutions, families, stop } = answer;
  const given = Object.entries(answer.given ?? {});
  const places = families.map((family) => nearest(family.curve ?? [], q.value));
  const least = Math.min(...places.map((place) => place.distance));
  const [all, setAll] = useState(false);
  // The nearest first to be seen, where there are dozens.
  const shown = all || families.length <= MANY ? families : families.filter((_, k) => places[k].distance <= [...places].map((p) => p.distance).sort((a, b) => a - b)[MANY - 1]);
  return (
    <>
      {stop && answer.obstacle && <Obstacle words={stop.words} obstacle={answer.obstacle} />}
      {stop && solutions.length + families.length > 0 && <p class="fine">Ways to the nearest pose:</p>}
      {solutions.length > 0 && <Listbox answer={answer} />}
      {families.map((family, index) => shown.includes(family) && (
        <FamilySlider
          key={index}
          family={family}
          motion={answer.motions[index]}
          answer={answer}
          name={families.length > 1 ? `Self-motion ${index + 1}` : "Self-motion"}
          at={places[index].index}
          isHere={places[index].distance === least && least < NEAR}
        />
      ))}
      {shown.length < families.length && (
        <Button label={`Show all ${families.length} self-motions`} small onClick={() => setAll(true)} />
      )}
      {given.length > 0 && (
        <p class="fine">
          Given beside the pose: {given.map(([name, value]) => `${name} = ${formatJoint(name, value)}`).join(", ")}
        </p>
      )}
      <p class="fine">
        By {METHODS[answer.method]}.{" "}
        {answer.complete ? (stop ? "No solution is missed." : "These are all there are.") : `There may be more${answer.doubt ? `: ${answer.doubt}` : ""}.`}
      </p>
    </>
  );
}

const METHODS: Record<Answer["method"], string> = {
  "closed form": "formulas in closed form",
  elimination: "elimination to one polynomial",
  "self-motion": "following the self-motion",
  descent: "descent from several starts",
};

function heading({ solutions, families, obstacle }: Answer): string {
  if (obstacle) return "Out of reach";
  const parts = [];
  if (solutions.length > 0 || families.length === 0) parts.push(`${solutions.length} solution${solutions.length === 1 ? "" : "s"}`);
  if (families.length > 0) parts.push(`${families.length} famil${families.length === 1 ? "y" : "ies"}`);
  return parts.join(" and ");
}

function took(milliseconds: number, answer: Answer): string {
  // The first answer for a robot takes as long as its derivation.
  if (answer.method === "closed form" && milliseconds > 50) return `derived and solved in ${milliseconds.toFixed(0)} ms`;
  return milliseconds < 0.095 ? "under 0.1 ms" : `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms`;
}

function jointName(index: number): string {
  return robot.value?.joints[index]?.name ?? `q${index + 1}`;
}

function formatJoint(name: string, value: number): string {
  const joint = robot.value?.joints.find((one) => one.name === name);
  return joint ? formatWithUnit(value, measureOf(joint), look.value, 2) : short(value);
}

/** Whether two configurations are the same but for whole turns. */
function same(one: number[], other: number[]): boolean {
  return one.every((value, index) => {
    const by = value - (other[index] ?? Number.NaN);
    const turns = robot.value?.joints[index]?.kind === "R" ? Math.round(by / (2 * Math.PI)) * 2 * Math.PI : 0;
    return Math.abs(by - turns) < 1e-5;
  });
}

function Listbox({ answer }: { answer: Answer }) {
  const [active, setActive] = useState(0);
  const { solutions } = answer;
  const current = solutions.findIndex((solution) => same(solution.q, q.value));
  const at = Math.min(active, solutions.length - 1);
  const narrow = solutions[0].q.length > 7;

  const step = (to: number) => {
    setActive(to);
    ghost.value = to;
    document.getElementById(optionId(to))?.scrollIntoView({ block: "nearest" });
  };
  const onKeyDown = (event: TargetedKeyboardEvent<HTMLDivElement>) => {
    const last = solutions.length - 1;
    const to = byKey(event, { ArrowDown: Math.min(at + 1, last), ArrowUp: Math.max(at - 1, 0), Home: 0, End: last });
    if (to !== undefined) {
      event.preventDefault();
      step(to);
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      take(solutions[at].q, answer);
    }
  };
  return (
    <div class={narrow ? "solutions wide" : "solutions"}>
      <div class="solutions-head" aria-hidden="true">
        <span />
        {solutions[0].q.map((_, index) => (
          <span key={index} class={highlighted.value.has(index) ? "lit" : undefined}>
            <JointSymbol name={jointName(index)} />
          </span>
        ))}
      </div>
      <div
        class="solutions-list"
        role="listbox"
        tabIndex={0}
        aria-label="Inverse solutions: arrows show one, Enter takes it"
        aria-activedescendant={optionId(at)}
        onKeyDown={onKeyDown}
        onFocus={() => (ghost.value = at)}
        onBlur={() => (ghost.value = null)}
        onPointerLeave={() => (ghost.value = null)}
      >
        {solutions.map((solution, index) => (
          <Option
            key={index}
            solution={solution}
            index={index}
            isActive={index === at}
            isCurrent={index === current}
            onTake={() => {
              setActive(index);
              take(solution.q, answer);
            }}
          />
        ))}
      </div>
    </div>
  );
}

function optionId(index: number): string {
  return `solution-${index}`;
}

interface OptionProps {
  solution: Solution;
  index: number;
  isActive: boolean;
  isCurrent: boolean;
  onTake(): void;
}

function Option({ solution, index, isActive, isCurrent, onTake }: OptionProps) {
  const remarks = [
    solution.within_limits ? "" : "outside the limits",
    solution.multiplicity > 1 ? `${solution.multiplicity} branches coincide` : "",
    solution.residual > 1e-9 ? `residual ${solution.residual.toExponential(0)}` : "",
  ].filter(Boolean);
  const names = ["solution", isActive && "active", isCurrent && "current", !solution.within_limits && "beyond", ghost.value === index && "ghosted"];
  return (
    <div
      class={names.filter(Boolean).join(" ")}
      role="option"
      id={optionId(index)}
      aria-selected={isCurrent}
      onClick={onTake}
      onPointerEnter={() => (ghost.value = index)}
    >
      <span class="solution-words">
        <span class="solution-number">{index + 1}</span>
        <span>{solution.branch || "–"}</span>
        {isCurrent && <span class="tag">arm is here</span>}
        {remarks.map((remark) => (
          <span class="tag warn" key={remark}>
            {remark}
          </span>
        ))}
        <span class="residual" title="How far from the pose this solution puts the hand, by the arm's size">
          {solution.residual.toExponential(0).replace("-", "−")}
        </span>
      </span>
      <span class="solution-values">
        {solution.q.map((value, at) => {
          const joint = robot.value?.joints[at];
          return (
            <span key={at} class={highlighted.value.has(at) ? "lit" : undefined}>
              {joint ? format(value, measureOf(joint), look.value, joint.kind === "R" && look.value.angles === "rad" ? 3 : undefined) : short(value)}
            </span>
          );
        })}
      </span>
    </div>
  );
}

interface FamilyProps {
  family: Family;
  motion: Motion;
  answer: Answer;
  name: string;
  /** The member of the curve that is nearest to the arm. */
  at: number;
  isHere: boolean;
}

function FamilySlider({ family, motion, answer, name, at, isHere }: FamilyProps) {
  const curve = family.curve ?? [];
  const last = curve.length - 1;
  return (
    <div class="family">
      <div class="heading">
        <h3>
          {name} {isHere && <span class="tag">arm is here</span>}
        </h3>
        <span class="fine">{motion.closed ? "all round" : "between ends"}</span>
        {!isHere && <Button label="Go there" small onClick={() => take(curve[at] ?? family.q, answer)} />}
      </div>
      <p class="fine clamped" title={motion.words}>
        <Words text={sentence(motion.words)} />
        {family.dimension > 1 && ` There are ${family.dimension} degrees of freedom; the slider goes along one.`}
      </p>
      {last > 0 && (
        <Slider
          label={`${name}: along the curve`}
          value={at}
          range={[0, last]}
          measure="number"
          step={1}
          origin={0}
          text={`${Math.round((100 * at) / last)} percent of the way${motion.closed ? " round" : ""}`}
          onChange={(to) => take(curve[Math.round(Math.min(last, Math.max(0, to)))], answer)}
        />
      )}
    </div>
  );
}

/** The member nearest to a configuration, up to whole turns. */
function nearest(curve: number[][], to: number[]): { index: number; distance: number } {
  let best = 0;
  let least = Number.POSITIVE_INFINITY;
  curve.forEach((member, index) => {
    const distance = member.reduce((sum, value, joint) => {
      const by = value - (to[joint] ?? 0);
      const turned = robot.value?.joints[joint]?.kind === "R" ? by - Math.round(by / (2 * Math.PI)) * 2 * Math.PI : by;
      return sum + turned * turned;
    }, 0);
    if (distance < least) [best, least] = [index, distance];
  });
  return { index: best, distance: Math.sqrt(least) };
}

function Obstacle({ words, obstacle }: { words: string; obstacle: NonNullable<Answer["obstacle"]> }) {
  const apart = [
    obstacle.distance > 1e-9 ? formatWithUnit(obstacle.distance, "length", look.value) : "",
    obstacle.angle > 1e-9 ? formatWithUnit(obstacle.angle, "angle", look.value) : "",
  ].filter(Boolean);
  return (
    <Callout tone="warning">
      <span>
        <Words text={sentence(words)} />
      </span>
      {apart.length > 0 && <span>The nearest pose the arm reaches is {apart.join(" and ")} away.</span>}
      <span>
        <Button label="Go to the nearest" icon="target" small onClick={() => move(obstacle.nearest)} />
      </span>
    </Callout>
  );
}
