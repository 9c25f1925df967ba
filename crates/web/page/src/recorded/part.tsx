// A recording held against the robot: what was found, how far the hand is off, and the motion played.

import { useMemo } from "preact/hooks";
import type { RecordedAnswer } from "../engine/types.ts";
import { fileName, save } from "../export/save.ts";
import { Player } from "../path/player.tsx";
import { Plots } from "../path/plots.tsx";
import { Plot } from "../plot/plot.tsx";
import { locate } from "../plot/scale.ts";
import { engine, panel, path, reach, revision, robot, time } from "../state.ts";
import { Failure, ProgressLine } from "../task.tsx";
import { Button, Segments } from "../widgets/button.tsx";
import { Callout } from "../widgets/callout.tsx";
import { sentence } from "../widgets/words.tsx";
import { close, hold, holding, opened, show, view } from "./recorded.ts";

export function RecordingPart() {
  const file = opened.value;
  if (!file) return null;
  const progress = holding.progress.value;
  const done = progress.kind === "done" ? progress.answer : null;
  const isOld = done !== null && done.revision !== revision.value;
  return (
    <section class="recording" aria-label="Recording">
      <div class="row-of-buttons">
        <strong>{file.name}</strong>
        {isOld && <Button label="Hold again" kind="main" hint="The robot has changed since" small onClick={() => void hold()} />}
        <Button label="Close" hint="Forget the recording" kind="plain" small onClick={close} />
      </div>
      {!done && (
        <ProgressLine task={holding} words="Holding it against the robot" cancel={() => engine().formulas.cancel()}>
          {progress.kind === "cancelled" && <span class="quiet">Not held against the robot.</span>}
        </ProgressLine>
      )}
      {isOld && <p class="quiet">The robot has changed since.</p>}
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      {done && <Found answer={done.answer} left={done.left} isOld={isOld} />}
    </section>
  );
}

function Found({ answer, left, isOld }: { answer: RecordedAnswer; left: string[]; isOld: boolean }) {
  const { recorded } = answer;
  const count = recorded.findings.length;
  const moves = !recorded.unseen.some(({ joint }) => joint === null);
  const tone = !recorded.understood || !moves ? "error" : count > 0 ? "warning" : "good";
  const verdict = !moves ? "It does not move: nothing can be told." : !recorded.understood ? "The recording is not understood." : count === 0 ? "Nothing is wrong with it." : count === 1 ? "1 finding." : `${count} findings.`;
  const { joints, position, rotation, time: clock } = recorded.roles;
  return (
    <>
      <p class="quiet">
        {recorded.rows} rows against {recorded.robot}: joints {list(joints)}; position {list(position)}; orientation {list(rotation)}
        {clock !== null && `; time ${clock}`}.
        {left.length > 0 && ` Left out, for they are no numbers: ${list(left)}.`}
        {answer.remarks.map((remark) => ` ${sentence(remark)}`)}
      </p>
      <Callout tone={tone}>
        <strong>{verdict}</strong>
      </Callout>
      <ul class="recorded-lines" aria-label="What was found">
        {answer.lines.map((line, k) => (
          <li key={k}>{line}</li>
        ))}
      </ul>
      {!isOld && answer.views.length > 0 && <Played answer={answer} />}
      <div class="row-of-buttons">
        {answer.fixed !== null && <Button label="Save it undone" icon="save" hint="All of it undone, as CSV: joints in radians and metres, the pose of the tool" onClick={() => save(`${fileName()}-fixed.csv`, answer.fixed!, "text/csv")} />}
        <Button label="Save the recipe" icon="save" hint="What the columns mean, as TOML, for the command line" onClick={() => save(`${fileName()}-recipe.toml`, recorded.recipe, "application/toml")} />
      </div>
    </>
  );
}

/** Metres and radians that nobody measures. */
const ROUNDING = 1e-8;

/** The motion: by the joints, beside the hand that was recorded. */
function Played({ answer }: { answer: RecordedAnswer }) {
  const chosen = answer.views[Math.min(view.value, answer.views.length - 1)]!;
  const { path: motion } = chosen;
  const shift = useMemo(() => [{ name: "distance", joint: null, values: chosen.shift.map((x) => 1e3 * x) }], [chosen]);
  const turn = useMemo(() => [{ name: "angle", joint: null, values: chosen.turn.map((x) => (x * 180) / Math.PI) }], [chosen]);
  const isRounding = [...chosen.shift, ...chosen.turn].every((x) => x < ROUNDING);
  const common = { times: motion.t, events: [] };
  const solve = () => {
    const { index } = locate(motion.t, time.peek());
    const pose = motion.pose[index];
    if (!pose) return;
    panel.value = "hand";
    reach(pose);
  };
  return (
    <>
      {answer.views.length > 1 && (
        <Segments label="Which motion" value={String(answer.views.indexOf(chosen))} options={answer.views.map((one, k) => ({ value: String(k), label: one.path.path.replace("recorded motion, ", "") }))} onChange={(k) => show(answer, Number(k))} />
      )}
      {path.value === motion ? <Player end={motion.duration} /> : <Button label="Play the recording" onClick={() => show(answer, view.peek())} />}
      <p class="quiet">The arm is moved by the joints; the line is the hand that was recorded. {sentence(motion.timing)}</p>
      {isRounding ? (
        <p class="quiet">But for rounding the hand is where the joints say.</p>
      ) : (
        <div class="plots" key={motion.path}>
          <Plot title="Position off" unit="mm" fromZero series={shift} {...common} />
          <Plot title="Orientation off" unit="°" fromZero series={turn} {...common} />
        </div>
      )}
      <Button label="Solve the recorded hand" hint={`All configurations of ${robot.value?.robot ?? "the arm"} for the hand that was recorded at this time`} onClick={solve} />
      <details>
        <summary>Joints</summary>
        <Plots path={motion} />
      </details>
    </>
  );
}

/** Names: all, or the first and the last of many. */
function list(names: string[]): string {
  return names.length > 6 ? `${names[0]} … ${names.at(-1)}` : names.join(", ");
}
