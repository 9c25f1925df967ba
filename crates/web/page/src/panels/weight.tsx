// The weight of the arm: the torques that hold it where it is, and the arm as it falls.

import type { Held, Path } from "../engine/types.ts";
import { plannedFrom } from "../path/points.ts";
import { batch, engine, panel, path, playing, q, revision, robot, time } from "../state.ts";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { short } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { nameOf } from "./joints.tsx";

/** How long a fall is followed, seconds. */
const SECONDS = 6;

const falling = new Task<Path>();

async function fall(): Promise<void> {
  playing.value = false;
  const forRevision = revision.peek();
  const answer = await falling.start(() => engine().solver.call("fall", { q: q.peek(), seconds: SECONDS }));
  if (!answer || forRevision !== revision.peek()) return;
  batch(() => {
    time.value = 0;
    path.value = answer;
    plannedFrom.value = null;
    panel.value = "path";
    playing.value = true;
  });
}

/** What holds the arm; a sentence where that is not known. */
function holding(): Held | string {
  try {
    return engine().now.call("hold", { q: q.value });
  } catch (why) {
    return why instanceof Error ? why.message : String(why);
  }
}

export function Weight() {
  const model = robot.value;
  if (!model) return null;
  const held = holding();
  const progress = falling.progress.value;
  return (
    <section class="section-plain" aria-label="Weight">
      <div class="heading">
        <h3>Torques that hold the arm</h3>
        <Button label="Let it fall" small hint={`How it moves under its weight for ${SECONDS} s, slowed by friction alone`} disabled={typeof held === "string" || falling.running} onClick={() => void fall()} />
      </div>
      {typeof held === "string" ? (
        <p class="fine">{held}</p>
      ) : (
        <>
          <dl class="facts">
            {model.joints.map((joint, k) => (
              <div key={joint.name}>
                <dt>{nameOf(joint)}</dt>
                <dd class="torque">
                  <TorqueBar torque={held.torques[k] ?? 0} most={Math.max(...held.torques.map(Math.abs))} />
                  {short(held.torques[k] ?? NaN, 2)} {joint.kind === "R" ? "N m" : "N"}
                </dd>
              </div>
            ))}
          </dl>
          <p class="fine">
            {held.bars === undefined
              ? `By the masses of the robot: ${short(held.mass, 2)} kg move.`
              : `The robot’s masses are not given: its links count as bars of ${short(held.bars)} kg a metre, with a ball at each joint.`}
          </p>
        </>
      )}
      <ProgressLine task={falling} words="Falling" cancel={() => engine().solver.cancel()} />
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
    </section>
  );
}

/** From the middle to the left or to the right, the largest to the end: not spoken, the number stands beside it. */
function TorqueBar({ torque, most }: { torque: number; most: number }) {
  const share = most > 1e-6 ? (50 * Math.abs(torque)) / most : 0;
  return (
    <span class="torque-bar" aria-hidden="true">
      <span style={{ left: `${(torque < 0 ? 50 - share : 50).toFixed(2)}%`, width: `${share.toFixed(2)}%` }} />
    </span>
  );
}
