// The formulas of the robot, topic by topic, with the numbers that they have now.

import { effect, signal } from "@preact/signals";
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Formulas, Topic } from "../engine/types.ts";
import { Blocks } from "../formula/blocks.tsx";
import { CopyMenu } from "../formula/copy.tsx";
import { keepFitted } from "../formula/fit.ts";
import { bind, type Symbols } from "../formula/marks.ts";
import { CurrentValues } from "../formula/values.ts";
import { Walk } from "../formula/walk.tsx";
import { engine, q, revision, robot, stale, topic } from "../state.ts";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { short } from "../units.ts";
import { Button, Segments } from "../widgets/button.tsx";
import { panelId, tabId, Tabs } from "../widgets/tabs.tsx";

const TOPICS: { key: Topic; title: string; working: string }[] = [
  { key: "table", title: "DH table", working: "Writing the table" },
  { key: "links", title: "Links", working: "Writing the link transforms" },
  { key: "forward", title: "Forward model", working: "Deriving the forward model" },
  { key: "algorithm", title: "Algorithm", working: "Looking for the shortest algorithm" },
  { key: "inverse", title: "Inverse", working: "Deriving the inverse kinematics" },
  { key: "jacobian", title: "Jacobian", working: "Deriving the Jacobian" },
  { key: "singularities", title: "Singularities", working: "Looking for the singularities" },
];
/** Topics that name their intermediates. */
const NAMED: ReadonlySet<Topic> = new Set(["forward", "algorithm", "inverse"]);

// The letters of formulas are there before the first one is shown, and come after the first picture of the arm.
setTimeout(() => void document.fonts.load('16px "Denavit Maths"').catch(() => {}), 1500);

/** From a change of the table to a derivation, milliseconds. */
const EDIT_PAUSE = 120;

const task = new Task<Formulas>();
/** What was derived for this revision, by topic. */
const known = new Map<Topic, Formulas>();
const shown = signal<{ formulas: Formulas; revision: number } | null>(null);
let knownFor = -1;
/** What runs now, so that it is not asked for twice. */
let asked: { topic: Topic; revision: number } | null = null;

/** Shows the topic: at once if it is known, else once it is derived. */
async function derive(wanted: Topic, forRevision: number): Promise<void> {
  if (topic.peek() !== wanted || revision.peek() !== forRevision) return;
  if (knownFor !== forRevision) known.clear();
  knownFor = forRevision;
  const before = known.get(wanted);
  if (before) {
    if (asked) engine().formulas.cancel();
    asked = null;
    task.reset();
    shown.value = { formulas: before, revision: forRevision };
    return;
  }
  if (asked?.topic === wanted && asked.revision === forRevision) return;
  // Another topic is not waited for. What belonged to another robot was ended with it.
  if (asked?.revision === forRevision && task.running) engine().formulas.cancel();
  const mine = { topic: wanted, revision: forRevision };
  asked = mine;
  const answer = await task.start(() => engine().formulas.call("formulas", { topic: wanted, q: q.peek() }));
  if (asked === mine) asked = null;
  if (!answer || forRevision !== revision.peek()) return;
  known.set(wanted, answer);
  if (topic.peek() === wanted) shown.value = { formulas: answer, revision: forRevision };
}

export function FormulasPanel() {
  useEffect(
    () =>
      effect(() => {
        if (!robot.value) return;
        const [wanted, forRevision] = [topic.value, revision.value];
        // Whoever changed the robot tells the worker right after: the question comes behind that. And while somebody
        // types, not every letter is worth a derivation.
        const isEdit = shown.peek() !== null && shown.peek()?.revision !== forRevision;
        setTimeout(() => void derive(wanted, forRevision), isEdit ? EDIT_PAUSE : 0);
      }),
    [],
  );
  const { working } = TOPICS.find((t) => t.key === topic.value)!;
  const progress = task.progress.value;
  const now = shown.value;
  const fits = now !== null && now.formulas.topic === topic.value;
  const isRunning = progress.kind === "running";
  const again = () => void derive(topic.value, revision.value);

  return (
    <section class="formulas-panel" aria-label="Formulas">
      <Tabs
        label="Topics"
        id="topic"
        tabs={TOPICS.map(({ key, title }) => ({ value: key, label: title }))}
        value={topic.value}
        onChange={(next) => (topic.value = next)}
      />
      <ProgressLine task={task} words={working} cancel={() => engine().formulas.cancel()}>
        {progress.kind === "cancelled" ? (
          <>
            <span>Not derived.</span>
            <Button label="Derive" small onClick={again} />
          </>
        ) : (
          <span class="quiet">
            {stale.value ? "The table has errors; these are the formulas from before." : "Formulas are exact; numbers are those of the present joints, in metres and radians."}
          </span>
        )}
      </ProgressLine>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      <div id={panelId("topic")} role="tabpanel" aria-labelledby={tabId("topic", topic.value)} aria-busy={isRunning}>
        {now && (fits || isRunning) && <Document now={now} dimmed={!fits || now.revision !== revision.value} />}
      </div>
      <CopyMenu />
    </section>
  );
}

/** The matrix at the present joints, at the tool's origin. */
function NumericJacobian() {
  const [frame, setFrame] = useState<"base" | "tool">("base");
  if (!robot.value || q.value.length !== robot.value.joints.length) return null;
  const { rows, jacobian } = engine().now.call("jacobian", { q: q.value, frame });
  return (
    <section class="section-plain numeric-jacobian" aria-label="Jacobian in numbers">
      <div class="heading">
        <h3>At the present joints, of the tool</h3>
        <Segments
          label="Axes of the Jacobian"
          options={[
            { value: "base" as const, label: "Base axes" },
            { value: "tool" as const, label: "Tool axes" },
          ]}
          value={frame}
          onChange={(next) => setFrame(next)}
        />
      </div>
      <div class="scrolled" tabIndex={0} role="group" aria-label="Jacobian in numbers, metres and radians">
        <table class="numbers">
          <thead>
            <tr>
              <td />
              {robot.value.joints.map((joint) => (
                <th key={joint.name} scope="col">
                  {joint.name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {jacobian.map((row, k) => (
              <tr key={rows[k]}>
                <th scope="row">{rows[k]}</th>
                {row.map((x, j) => (
                  <td key={j} class="number">
                    {short(x, 4)}
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

/** A topic with its symbols bound to the joints. What is out of date stays until the next is there, at its height. */
function Document({ now, dimmed }: { now: { formulas: Formulas; revision: number }; dimmed: boolean }) {
  const root = useRef<HTMLDivElement>(null);
  const symbols = useRef<Symbols>(null);
  const [words, say] = useState("");
  const { formulas } = now;

  const values = useMemo(() => (NAMED.has(formulas.topic) ? new CurrentValues(formulas.topic) : null), [now]);
  useEffect(() => {
    if (values && now.revision === revision.peek()) return values.follow();
  }, [values]);

  useLayoutEffect(() => {
    const bound = bind(root.current!, formulas.joints, say);
    symbols.current = bound;
    const loose = keepFitted(root.current!);
    return () => {
      loose();
      bound.dispose();
    };
  }, [formulas]);

  return (
    <>
      <Walk key={`walk ${formulas.topic} ${now.revision}`} root={root} symbols={symbols} values={values} />
      <div ref={root} key={`${formulas.topic} ${now.revision}`} class={dimmed ? "document dimmed" : "document"}>
        <Blocks blocks={formulas.blocks} values={values} />
      </div>
      {formulas.topic === "jacobian" && <NumericJacobian />}
      <p class="spoken" role="status">
        {words}
      </p>
    </>
  );
}
