// Paths: way-points, a plan, playing it, and its plots.

import { useEffect, useRef } from "preact/hooks";
import type { Path } from "../engine/types.ts";
import { fileName, save } from "../export/save.ts";
import { pathCsv } from "../path/csv.ts";
import { Player } from "../path/player.tsx";
import { Plots } from "../path/plots.tsx";
import { add, duration, hand, place, plan, plannedFrom, planning, points, setDuration, setSpeed, speed, start, via, wish } from "../path/points.ts";
import { jointWords, pointWords, WaypointList } from "../path/waypoint.tsx";
import { EventSign, seek } from "../plot/plot.tsx";
import { engine, note, path, q, revision, robot } from "../state.ts";
import { Failure, ProgressLine } from "../task.tsx";
import { Button } from "../widgets/button.tsx";
import { NumberField } from "../widgets/number.tsx";

export function PathPanel() {
  // Who opens the panel and then moves the arm, here or in another panel, means to come from where it was.
  useEffect(() => {
    start.value ??= q.peek();
  }, [revision.value]);
  const model = robot.value;
  if (!model) return null;
  const planned = path.value;
  const progress = planning.progress.value;
  const isOld = planned !== null && plannedFrom.value !== null && plannedFrom.value !== wish();
  const noLimits = model.joints.some((joint) => joint.velocity === null);
  return (
    <section class="path-panel" aria-label="Path">
      <WaypointList />
      <AddPoints />
      <div class="fields path-options">
        <label>
          <span>Duration</span>
          <DurationField />
        </label>
        {noLimits && (
          <label>
            <span>Speed of the hand (m/s)</span>
            <NumberField label="Speed of the hand, metres a second" value={speed.value} measure="number" onChange={(value) => value > 0 && setSpeed(value)} />
          </label>
        )}
      </div>
      <div class="row-of-buttons">
        <Button label={isOld ? "Plan again" : "Plan"} kind="main" disabled={points.value.length === 0 || planning.running} onClick={() => void plan()} />
        <ProgressLine task={planning} words="Planning" cancel={() => engine().solver.cancel()}>
          {progress.kind === "cancelled" && <span class="quiet">Not planned.</span>}
          {points.value.length === 0 && <span class="quiet">A path needs a way-point at least.</span>}
          {isOld && progress.kind !== "cancelled" && <span class="quiet">The way-points have changed since.</span>}
        </ProgressLine>
      </div>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      {planned && <Planned planned={planned} />}
    </section>
  );
}

/** Buttons that make way-points of what the arm does now. */
function AddPoints() {
  const taken = via.value;
  const line = () => {
    const pose = hand();
    if (pose) add({ kind: "line", pose });
  };
  const arc = () => {
    const pose = hand();
    if (!pose) return;
    if (!taken) {
      via.value = place(pose);
      note("The arc goes through here. Now move the hand to where it ends.");
    } else {
      add({ kind: "arc", via: taken, pose });
      via.value = null;
    }
  };
  return (
    <div class="row-of-buttons" role="group" aria-label="Add a way-point">
      <Button label="Add joints" icon="plus" hint="Move the joints to where they are now" small onClick={() => add({ kind: "joint", q: q.peek() })} />
      <Button label="Add line" icon="plus" hint="Move the hand straight to where it is now" small onClick={line} />
      <Button label={taken ? "End the arc here" : "Add arc"} icon="plus" hint={taken ? `An arc through ${pointWords(taken)} to where the hand is now` : "Move the hand on an arc through where it is now"} small onClick={arc} />
      {taken && <Button label="No arc" small onClick={() => (via.value = null)} />}
    </div>
  );
}

/** Empty: as fast as the limits allow. */
function DurationField() {
  const input = useRef<HTMLInputElement>(null);
  return (
    <span class="with-unit">
      <input
        ref={input}
        class="field number"
        type="text"
        inputMode="decimal"
        autocomplete="off"
        data-unit="s"
        aria-label="Duration in seconds; empty for as short as can be"
        placeholder="automatic"
        value={duration.value ?? ""}
        onChange={(event) => {
          const text = event.currentTarget.value.trim().replace(",", ".");
          const value = Number(text);
          const isGood = text === "" || (Number.isFinite(value) && value > 0);
          event.currentTarget.setAttribute("aria-invalid", String(!isGood));
          if (isGood) setDuration(text === "" ? null : value);
        }}
      />
      <span class="unit" aria-hidden="true">
        s
      </span>
    </span>
  );
}

function Planned({ planned }: { planned: Path }) {
  const end = planned.duration;
  const names = robot.value!.joints.map((joint) => joint.name);
  const percent = Math.floor(planned.reached * 1000) / 10;
  return (
    <div class="planned">
      <div role="status">
        <p>
          {sentence(planned.path)} {sentence(planned.timing)}
        </p>
        {planned.reached < 1 && <p class="warning-words">It can be followed for {percent} % of its way only.</p>}
      </div>
      <Player end={end} />
      {planned.events.length > 0 && (
        <ul class="events" aria-label="On the way">
          {planned.events.map((event, k) => (
            <li key={k}>
              <button type="button" onClick={() => seek(event.t, end)} title="Go there">
                <svg width="14" height="14" viewBox="-7 -7 14 14" class={`event event-${event.kind}`} aria-hidden="true">
                  <EventSign kind={event.kind} y={0} />
                </svg>
                <span class="event-time">{event.t.toFixed(2)} s</span>
                <span>{event.words}</span>
              </button>
            </li>
          ))}
        </ul>
      )}
      <Plots path={planned} />
      <Alternatives planned={planned} />
      <div class="row-of-buttons">
        <Button label="Save CSV" icon="save" hint="Times, joints, speeds and poses; radians and metres" onClick={() => save(`${fileName()}-path.csv`, pathCsv(planned, names), "text/csv")} />
      </div>
    </div>
  );
}

/** Other configurations of the start with the same hand. */
function Alternatives({ planned }: { planned: Path }) {
  if (planned.starts.length === 0) return null;
  return (
    <details class="alternatives" open={planned.reached < 1}>
      <summary>Other configurations to start in ({planned.starts.length})</summary>
      <ul>
        {planned.starts.map((other, k) => (
          <li key={k}>
            <div>
              <p>{jointWords(other.q)}</p>
              <p class="quiet">
                {other.branch}
                {!other.within_limits && " Beyond the limits."}
              </p>
            </div>
            <Button label="Start so" hint="Plan the path again from this configuration" small disabled={planning.running} onClick={() => void plan(other.q)} />
          </li>
        ))}
      </ul>
    </details>
  );
}

function sentence(words: string): string {
  const text = words.charAt(0).toUpperCase() + words.slice(1);
  return text === "" || /[.!?]$/.test(text) ? text : `${text}.`;
}
