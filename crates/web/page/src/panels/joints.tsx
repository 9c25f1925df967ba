// The joints: a slider and a field each, named poses, and how near the arm is to a singular configuration.

import { useState } from "preact/hooks";
import type { Joint } from "../engine/types.ts";
import { change, file, highlighted, look, move, note, q, robot, scene, stale } from "../state.ts";
import { MobilityPart } from "../mobility/part.tsx";
import { isExact, nearness, smallest } from "../scene/arm.ts";
import { forFile, formatWithUnit, type Measure, short, unitOf, format } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { NumberField } from "../widgets/number.tsx";
import { Slider } from "../widgets/slider.tsx";
import { Weight } from "./weight.tsx";

export function measureOf(joint: Joint): Measure {
  return joint.kind === "R" ? "angle" : "length";
}

/** `q1 (shoulder)` */
export function nameOf(joint: Joint): string {
  return joint.title ? `${joint.name} (${joint.title})` : joint.name;
}

export function JointsPanel() {
  const model = robot.value;
  if (!model) return <p class="quiet">The table has to be put right first.</p>;
  return (
    <>
      <div class="heading">
        <h2>Joints</h2>
        <div class="row-of-buttons">
          <Button label="Reset" icon="reset" small hint="Back to the robot's first configuration" onClick={() => move(model.q)} />
          <Button label="Random" icon="dice" small hint="A random configuration within the ranges" onClick={() => move(model.joints.map(anywhere))} />
        </div>
      </div>
      <ul class="joints">
        {model.joints.map((joint, index) => (
          <JointRow key={joint.name} joint={joint} index={index} />
        ))}
      </ul>
      <p class="fine keys">
        <kbd>←</kbd> <kbd>→</kbd> 1° or 1 mm, with <kbd>Shift</kbd> ten times as much, with <kbd>Alt</kbd> a tenth.
        {model.joints.every((joint) => !joint.limits) && " No limits are given."}
      </p>
      <Poses />
      <Measures />
      <Weight />
    </>
  );
}

function anywhere(joint: Joint): number {
  const [low, high] = joint.range;
  return low + Math.random() * (high - low);
}

function JointRow({ joint, index }: { joint: Joint; index: number }) {
  const value = q.value[index] ?? 0;
  const measure = measureOf(joint);
  const inside = scene.value?.within_limits[index] ?? true;
  const lit = highlighted.value.has(index);
  const light = () => (highlighted.value = new Set([index]));
  const dark = () => (highlighted.value = new Set());
  const set = (next: number) => move(q.value.map((old, at) => (at === index ? next : old)));
  const someLimits = robot.value?.joints.some((other) => other.limits);
  // Without limits the range is a guess, which the first configuration may know better.
  const start = robot.value?.q[index] ?? 0;
  const [low, high] = joint.limits ?? [Math.min(joint.range[0], start), Math.max(joint.range[1], start)];
  const remark = `limits-${joint.name}`;
  return (
    <li class={`joint${lit ? " lit" : ""}${inside ? "" : " beyond"}`} onPointerEnter={light} onPointerLeave={dark}>
      <span class="joint-name" title={joint.title ?? undefined}>
        <JointSymbol name={joint.name} />
        {joint.title && <span class="joint-title">{joint.title}</span>}
      </span>
      <span class="joint-slider">
        <Slider label={nameOf(joint)} value={value} range={[low, high]} measure={measure} onChange={set} onFocus={light} onBlur={dark} />
        <span class="ends" id={remark}>
          <span>{format(low, measure, look.value, ends(joint))}</span>
          {!inside && <strong>outside the limits</strong>}
          {!joint.limits && someLimits && <span>no limits given</span>}
          <span>{formatWithUnit(high, measure, look.value, ends(joint))}</span>
        </span>
      </span>
      <NumberField
        label={nameOf(joint)}
        value={value}
        measure={measure}
        onChange={set}
        invalid={!inside}
        describedBy={remark}
        onFocus={light}
        onBlur={dark}
      />
    </li>
  );
}

/** Decimals under the ends of a slider: as few as tell them. */
function ends(joint: Joint): number {
  const unit = unitOf(measureOf(joint), look.value);
  return unit === "°" || unit === "mm" ? (joint.range.some((end) => Math.abs(shown(end, unit) % 1) > 0.05) ? 1 : 0) : 2;
}

function shown(value: number, unit: string): number {
  return unit === "°" ? Math.round((value * 1800) / Math.PI) / 10 : Math.round(value * 1e4) / 10;
}

/** q₁ as it is printed. */
export function JointSymbol({ name }: { name: string }) {
  const [, letter, number] = /^([A-Za-z]+)(\d+)$/.exec(name) ?? [];
  if (!letter) return <span class="symbol">{name}</span>;
  return (
    <span class="symbol">
      {letter}
      <sub>{number}</sub>
    </span>
  );
}

function Poses() {
  const model = robot.value;
  const [name, setName] = useState("");
  if (!model) return null;
  const save = () => {
    const wanted = name.trim() || freeName(file.value.poses.map((pose) => pose.name));
    const values = model.joints.map((joint, index) => forFile(q.value[index], measureOf(joint), look.value));
    const poses = file.value.poses.filter((pose) => pose.name !== wanted);
    change({ ...file.value, poses: [...poses, { name: wanted, values }] });
    setName("");
    note(`The pose is in the table as “${wanted}”.`);
  };
  return (
    <section class="section-plain" aria-label="Named poses">
      <h3>Named poses</h3>
      <div class="row-of-buttons poses">
        {model.poses.map((pose) => (
          <Button key={pose.name} label={pose.name} small onClick={() => move(pose.q)} />
        ))}
        {model.poses.length === 0 && <span class="fine">None yet.</span>}
      </div>
      <form
        class="save-pose"
        onSubmit={(event) => {
          event.preventDefault();
          save();
        }}
      >
        <input
          class="field"
          aria-label="Name for this pose"
          placeholder="Name for this pose"
          maxLength={60}
          value={name}
          onInput={(event) => setName(event.currentTarget.value)}
        />
        <Button label="Save this pose" disabled={stale.value} onClick={save} />
      </form>
    </section>
  );
}

function freeName(taken: string[]): string {
  for (let number = 1; ; number += 1) {
    if (!taken.includes(`pose ${number}`)) return `pose ${number}`;
  }
}

/** The scene's sign of being nearly singular, from here on. */
const NEAR = 0.05;

function Measures() {
  const now = scene.value;
  if (!now) return null;
  const { manipulability } = now.measures;
  const condition = now.measures.condition ?? Infinity;
  // 0 where the arm is singular, 1 where the hand moves equally well in all directions.
  const evenness = condition > 0 ? Math.min(1, 1 / condition) : 0;
  const near = nearness(now, robot.value?.reach ?? 1) > NEAR;
  return (
    <section class="section-plain" aria-label="Distance from singular configurations">
      <h3>
        How well the hand moves here{near && <span class="problem">{isExact(now) ? " in a singularity" : " near a singularity"}</span>}
      </h3>
      <div class={near ? "gauge near" : "gauge"} role="meter" aria-label="Evenness, one by the condition number" aria-valuemin={0} aria-valuemax={1} aria-valuenow={evenness}>
        <span style={{ width: `${(100 * evenness).toFixed(1)}%` }} />
      </div>
      <dl class="facts">
        <div>
          <dt>Manipulability, lengths by the reach</dt>
          <dd>{short(manipulability, 4)}</dd>
        </div>
        <div>
          <dt>Smallest singular value</dt>
          <dd>{short(smallest(now), 4)}</dd>
        </div>
        <div>
          <dt>Condition number</dt>
          <dd>{condition > 0 && condition <= 1e6 ? short(condition, 1) : "∞"}</dd>
        </div>
      </dl>
      <MobilityPart />
    </section>
  );
}
