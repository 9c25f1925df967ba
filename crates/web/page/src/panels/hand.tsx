// The hand: where the tool is or should be, by numbers and by steps, and every way for the arm to get there.

import { useState } from "preact/hooks";
import { engine, look, pose, reach, robot, said, target } from "../state.ts";
import type { Matrix, OrientationSet, Point } from "../engine/types.ts";
import type { Measure } from "../units.ts";
import { CopyButton } from "../widgets/copy.tsx";
import { NumberField } from "../widgets/number.tsx";
import { Callout } from "../widgets/callout.tsx";
import { Jog } from "./jog.tsx";
import { SolutionsList } from "./solutions.tsx";
import { Button } from "../widgets/button.tsx";

let sets: OrientationSet[] | null = null;

/** The ways to write an orientation; they are the same for every robot. */
function orientationSets(): OrientationSet[] {
  sets ??= engine().now.call("orientations", {}).sets;
  return sets;
}

export function HandPanel() {
  const now = target.value ?? pose.value;
  if (!robot.value || !now) return <p class="quiet">The table has to be put right first.</p>;
  return (
    <>
      <div class="heading">
        <h2>Hand</h2>
        <div class="row-of-buttons">
          {target.value && (
            <Button label="Follow the joints" small hint="Forget the target: the pose is again where the arm is" onClick={() => (target.value = null)} />
          )}
          <CopyButton label="Copy pose" small text={() => matrixText(now)} done="The pose is copied as a matrix, in metres." />
        </div>
      </div>
      <PoseFields pose={now} />
      <Jog pose={now} />
      <SolutionsList />
      <MatrixTable pose={now} />
    </>
  );
}

const SET_KEPT = "denavit.orientation";

function PoseFields({ pose: now }: { pose: Matrix }) {
  const all = orientationSets();
  const [set, setSet] = useState(() => all.find((one) => one.name === kept())?.name ?? all[0].name);
  const names = all.find((one) => one.name === set)?.names ?? [];
  const angles = engine().now.call("angles", { pose: now, set });
  const xyz: Point = [now[0][3], now[1][3], now[2][3]];
  // Four numbers are a quaternion.
  const measure: Measure = names.length === 4 ? "number" : "angle";

  const go = (place: Point, values: number[]) => {
    try {
      reach(engine().now.call("pose", { xyz: place, set, values }).pose);
    } catch (why) {
      said(why);
    }
  };
  return (
    <>
      <div class="pose-fields three">
        {(["x", "y", "z"] as const).map((axis, index) => (
          <div class="labelled" key={axis}>
            <span class={`symbol axis-${axis}`}>{axis}</span>
            <NumberField
              label={`Position ${axis}`}
              value={xyz[index]}
              measure="length"
              onChange={(value) => go(xyz.map((old, at) => (at === index ? value : old)) as Point, angles.values)}
            />
          </div>
        ))}
      </div>
      <div class={`pose-fields ${names.length === 4 ? "four" : "three"}`}>
        {names.map((name, index) => (
          <div class="labelled" key={`${set}-${name}-${index}`}>
            <span class="symbol">{name}</span>
            <NumberField
              label={`Orientation ${name}`}
              value={angles.values[index]}
              measure={measure}
              onChange={(value) => go(xyz, angles.values.map((old, at) => (at === index ? value : old)))}
            />
          </div>
        ))}
      </div>
      <label class="beside">
        <span class="fine">Orientation as</span>
        <select
          class="field"
          value={set}
          onChange={(event) => {
            setSet(event.currentTarget.value);
            keep(event.currentTarget.value);
          }}
        >
          {all.map((one) => (
            <option key={one.name} value={one.name}>
              {one.title}
            </option>
          ))}
        </select>
      </label>
      {angles.singular && (
        <Callout tone="note">
          <span>These angles are not unique here: only a sum or difference is determined, so the last one is set to 0.</span>
        </Callout>
      )}
    </>
  );
}

function kept(): string | null {
  try {
    return localStorage.getItem(SET_KEPT);
  } catch {
    return null;
  }
}

function keep(set: string): void {
  try {
    localStorage.setItem(SET_KEPT, set);
  } catch {
    // A browser that keeps nothing asks again the next time.
  }
}

function matrixText(of: Matrix): string {
  return `[${of.map((row) => `[${row.map((entry) => Number(entry.toFixed(12))).join(", ")}]`).join(",\n ")}]`;
}

function MatrixTable({ pose: now }: { pose: Matrix }) {
  const length = look.value.lengths === "mm" ? 1000 : 1;
  return (
    <details class="section">
      <summary>
        Pose as a matrix <span class="fine">base to tool, lengths in {look.value.lengths}</span>
      </summary>
      <table class="matrix">
        <tbody>
          {now.map((row, r) => (
            <tr key={r}>
              {row.map((entry, c) => (
                <td key={c}>{(c === 3 && r < 3 ? (entry * length).toFixed(length === 1 ? 5 : 2) : clean(entry)).replace("-", "−")}</td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

function clean(entry: number): string {
  const text = entry.toFixed(5);
  return Number(text) === 0 ? "0.00000" : text;
}
