// Formulas that somebody printed, and motion that was recorded, held against the robot.

import { signal } from "@preact/signals";
import { useMemo, useRef, useState } from "preact/hooks";
import { MarkedArea } from "../check/area.tsx";
import { Claims, tallyWords } from "../check/claims.tsx";
import { example } from "../check/example.ts";
import { characters, documentName, type Kind, range, spans } from "../check/text.ts";
import type { Checked, Place } from "../engine/types.ts";
import { engine, note, revision, robot } from "../state.ts";
import { chooseFile } from "./robots.tsx";
import { RecordingPart } from "../recorded/part.tsx";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { Button } from "../widgets/button.tsx";

/** What is in the text area; kept while other panels are open. */
export const text = signal("");
const kind = signal<Kind>("detect");
const checking = new Task<{ checked: Checked; text: string; revision: number }>();

const KINDS: { value: Kind; title: string }[] = [
  { value: "detect", title: "Detect the format" },
  { value: "md", title: "Markdown or text" },
  { value: "tex", title: "LaTeX" },
  { value: "py", title: "Python" },
  { value: "m", title: "MATLAB" },
];

function check(): void {
  const asked = text.peek();
  if (asked.trim() === "" || checking.running) return;
  const forRevision = revision.peek();
  const name = documentName(asked, kind.peek());
  void checking.start(async () => {
    const checked = await engine().formulas.call("check", { text: asked, name });
    return { checked, text: asked, revision: forRevision };
  });
}

async function putExample(): Promise<void> {
  try {
    const made = await example();
    if (made === null) note("The forward model of this robot is too long for an example.");
    else {
      text.value = made;
      check();
    }
  } catch (why) {
    note(why instanceof Error ? why.message : String(why));
  }
}

export function CheckPanel() {
  const area = useRef<HTMLTextAreaElement>(null);
  const [chosen, choose] = useState<number | null>(null);
  const progress = checking.progress.value;
  const done = progress.kind === "done" ? progress.answer : null;
  const isCurrent = done !== null && done.text === text.value;
  const marks = useMemo(() => (done && isCurrent ? spans(done.checked, done.text) : []), [done, isCurrent]);
  const at = useMemo(() => characters(done?.text ?? ""), [done]);

  const select = (place: Place, claim: number | null) => {
    const element = area.current;
    if (!element || !isCurrent) return;
    const [from, to] = range(place, at);
    element.focus({ preventScroll: true });
    element.setSelectionRange(from, to);
    element.scrollIntoView({ block: "nearest" });
    choose(claim);
  };
  return (
    <section class="check-panel" aria-label="Check">
      <RecordingPart />
      <MarkedArea
        text={text.value}
        spans={marks}
        chosen={chosen}
        area={area}
        describedBy="check-names"
        onInput={(next) => {
          text.value = next;
          choose(null);
        }}
        onSubmit={check}
      />
      <Names />
      <div class="row-of-buttons">
        <Button label="Check" kind="main" disabled={text.value.trim() === "" || checking.running} hint="Ctrl+Enter in the text" onClick={check} />
        <select class="field" aria-label="How the text is read" value={kind.value} onChange={(event) => (kind.value = event.currentTarget.value as Kind)}>
          {KINDS.map(({ value, title }) => (
            <option key={value} value={value}>
              {title}
            </option>
          ))}
        </select>
        <Button label="Example" hint="Formulas of this robot with a slip in them" onClick={() => void putExample()} />
        <Button label="Open a recording" hint="Joints and hand poses as CSV, JSON Lines, NPY, NPZ or Parquet; it may be dropped anywhere, too" onClick={chooseFile} />
        {text.value !== "" && <Button label="Clear" kind="plain" onClick={() => (text.value = "")} />}
      </div>
      <ProgressLine task={checking} words="Checking" cancel={() => engine().formulas.cancel()}>
        {progress.kind === "cancelled" && <span class="quiet">Not checked.</span>}
        {done && <strong>{tallyWords(done.checked)}</strong>}
        {done && !isCurrent && <span class="quiet">The text has changed since.</span>}
        {done && isCurrent && done.revision !== revision.value && <span class="quiet">The table has changed since.</span>}
      </ProgressLine>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      {done && <Claims checked={done.checked} context={{ text: done.text, at, select }} chosen={isCurrent ? chosen : null} />}
    </section>
  );
}

/** The names that are understood for this robot. */
function Names() {
  const model = robot.value;
  if (!model) return <p id="check-names" />;
  const last = model.rows;
  const names = [
    `T0${last}, T01 … (poses of frames)`,
    "A1 … (link transforms)",
    "P_x, n_x, t_34 (entries)",
    `${model.joints[0]?.name ?? "q1"} … ${model.joints.at(-1)?.name ?? ""}`,
    model.joints.some((joint) => joint.kind === "R") && "C1, S23 (cosines, sines)",
    "J (Jacobian)",
    ...model.parameters.slice(0, 8).map((parameter) => parameter.name),
  ];
  return (
    <p id="check-names" class="fine">
      Names understood: {names.filter(Boolean).join("; ")}.
    </p>
  );
}
