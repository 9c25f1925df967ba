// How the hand can move here, in words and numbers: the ellipsoid's axes, what is lost, and what moves without the hand.

import type { Point } from "../engine/types.ts";
import { answerNow, look, panel, robot, show } from "../state.ts";
import { short } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { type Lost, mobility } from "./mobility.ts";

const NAMES = ["x", "y", "z"];

/** `z`, or `(0, 0.6, 0.8)`, in the base. */
function directionOf(v: Point): string {
  const axis = v.findIndex((x) => Math.abs(Math.abs(x) - 1) < 5e-3);
  return axis >= 0 ? NAMES[axis] : `(${v.map((x) => short(x, 2)).join(", ")})`;
}

function words({ kind, direction, equation, isExact }: Lost): string {
  if (kind === "both") return `All that the hand can do obeys ${sumOf(equation)} ${isExact ? "=" : "≈"} 0, by its velocity v (m/s) and its rate ω (rad/s).`;
  return `The hand ${isExact ? "cannot" : "can hardly"} ${kind === "along" ? "move along" : "turn about"} ${directionOf(direction)}.`;
}

const COMPONENTS = ["vx", "vy", "vz", "ωx", "ωy", "ωz"];

/** `0.5 vx − ωy` */
function sumOf(equation: number[]): string {
  const terms = equation.map((x, k) => ({ x, name: COMPONENTS[k] })).filter(({ x }) => Math.abs(x) > 5e-4);
  return terms
    .map(({ x, name }, k) => {
      const size = short(Math.abs(x), 3);
      return `${x < 0 ? (k > 0 ? " − " : "−") : k > 0 ? " + " : ""}${size === "1" ? "" : `${size} `}${name}`;
    })
    .join("");
}

/** `q4 : q6 = 1 : −1` */
function ratio(rates: number[]): string {
  const moving = rates.map((rate, k) => ({ rate, name: robot.value?.joints[k].name ?? "" })).filter(({ rate }) => Math.abs(rate) > 5e-4);
  if (moving.length === 1) return `${moving[0].name} alone`;
  return `${moving.map(({ name }) => name).join(" : ")} = ${moving.map(({ rate }) => short(rate, 3)).join(" : ")}`;
}

export function MobilityPart() {
  const found = mobility.value;
  if (!found) return null;
  const [first] = found.still;
  const isOn = look.value.ellipsoid;
  // Of an elbow that is stretched the ratio holds at first, and nowhere beside.
  const hasFamily = (answerNow.value?.families.length ?? 0) > 0;
  return (
    <>
      <div class="row-of-buttons mobility">
        <Button label="Velocity ellipsoid" small pressed={isOn} hint="Where the hand can go, and how fast, for joint rates whose squares add up to 1" onClick={() => show({ ellipsoid: !isOn })} />
      </div>
      {isOn && (
        <p class="fine">
          Half axes {found.axes.map(({ length }) => short(length, 3)).join(", ")} m/s: so fast is the hand where the squares of all joint rates add up to
          1 (rad/s)²{robot.value?.joints.some(({ kind }) => kind === "P") ? "; a slide counts by the reach of the arm" : ""}.
        </p>
      )}
      {found.lost.length > 0 && (
        <ul class="remarks lost">
          {found.lost.map((one, k) => (
            <li key={k}>{words(one)}</li>
          ))}
        </ul>
      )}
      {first && (
        <p class="fine still">
          At first the hand stands still while{" "}
          {found.still.length === 1 ? `the joints move in the ratio ${ratio(first)}` : `the joints move in ${found.still.length} ways, for one ${ratio(first)}`}.{" "}
          {hasFamily && <Button label="Move them so" small hint="Along the self-motion, in the panel Hand" onClick={() => (panel.value = "hand")} />}
        </p>
      )}
    </>
  );
}
