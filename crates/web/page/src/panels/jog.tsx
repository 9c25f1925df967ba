// Steps of the hand along and about the axes of the base or of the tool, by buttons and by keys.

import type { TargetedKeyboardEvent } from "preact";
import { useState } from "preact/hooks";
import type { Matrix } from "../engine/types.ts";
import { reach } from "../state.ts";
import { Segments } from "../widgets/button.tsx";
import { NumberField } from "../widgets/number.tsx";
import { byKey } from "../widgets/keys.ts";

type Axis = 0 | 1 | 2;
const AXES = ["x", "y", "z"] as const;

export function Jog({ pose }: { pose: Matrix }) {
  const [frame, setFrame] = useState<"base" | "tool">("base");
  const [way, setWay] = useState(0.01);
  const [turn, setTurn] = useState(Math.PI / 36);

  const step = (kind: "along" | "about", axis: Axis, sign: number) => {
    const by = kind === "along" ? translation(axis, sign * way) : rotation(axis, sign * turn);
    reach(frame === "tool" ? multiply(pose, by) : kind === "along" ? multiply(by, pose) : aboutPoint(by, pose));
  };

  const onKeyDown = (event: TargetedKeyboardEvent<HTMLDivElement>) => {
    const of = byKey(event, { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 1], ArrowDown: [1, -1], PageUp: [2, 1], PageDown: [2, -1] });
    // In the fields for the size of a step the arrows are theirs.
    if (!of || event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    step(event.shiftKey ? "about" : "along", of[0] as Axis, of[1]);
  };

  return (
    <section class="jog section-plain" aria-label="Steps of the hand">
      <div class="heading">
        <h3>Steps</h3>
        <Segments
          label="Axes of"
          options={[
            { value: "base" as const, label: "Base axes" },
            { value: "tool" as const, label: "Tool axes" },
          ]}
          value={frame}
          onChange={(next) => setFrame(next)}
        />
      </div>
      <div class="jog-grid" role="group" aria-label="Step the hand: arrows for x and y, page up and down for z, with shift about the axis" onKeyDown={onKeyDown}>
        {(["along", "about"] as const).map((kind) => (
          <div class="jog-row" key={kind}>
            <span class="fine">{kind === "along" ? "Along" : "About"}</span>
            {AXES.map((name, axis) => (
              <span class="jog-pair" key={name}>
                <button type="button" class="button small" aria-label={`Step ${kind} minus ${name}`} onClick={() => step(kind, axis as Axis, -1)}>
                  −
                </button>
                <span class={`symbol axis-${name}`} aria-hidden="true">
                  {name}
                </span>
                <button type="button" class="button small" aria-label={`Step ${kind} plus ${name}`} onClick={() => step(kind, axis as Axis, 1)}>
                  +
                </button>
              </span>
            ))}
            {kind === "along" ? (
              <NumberField label="Step along an axis" value={way} measure="length" onChange={setWay} />
            ) : (
              <NumberField label="Step about an axis" value={turn} measure="angle" onChange={setTurn} />
            )}
          </div>
        ))}
      </div>
      <p class="fine keys">
        <kbd>←</kbd> <kbd>→</kbd> x, <kbd>↑</kbd> <kbd>↓</kbd> y, <kbd>PgUp</kbd> <kbd>PgDn</kbd> z; with <kbd>Shift</kbd> about it.
      </p>
    </section>
  );
}

export function multiply(left: Matrix, right: Matrix): Matrix {
  return left.map((row) => [0, 1, 2, 3].map((c) => row[0] * right[0][c] + row[1] * right[1][c] + row[2] * right[2][c] + row[3] * right[3][c]));
}

function translation(axis: Axis, by: number): Matrix {
  return [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => (r === c ? 1 : c === 3 && r === axis ? by : 0)));
}

function rotation(axis: Axis, angle: number): Matrix {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const matrix = translation(axis, 0);
  matrix[u][u] = c;
  matrix[u][v] = -s;
  matrix[v][u] = s;
  matrix[v][v] = c;
  return matrix;
}

/** Turns a pose about base axes through its own origin: the hand turns where it is. */
function aboutPoint(by: Matrix, pose: Matrix): Matrix {
  const turned = multiply(by, pose);
  return turned.map((row, r) => (r < 3 ? [row[0], row[1], row[2], pose[r][3]] : row));
}
