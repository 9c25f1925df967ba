// What is said beside the picture: the row that is explained, what is being computed, and whether the arm is nearly singular.

import { computed } from "@preact/signals";
import type { Singularity } from "../engine/types.ts";
import { look, move, robot, scene, selected, singular } from "../state.ts";
import { isExact, nearness } from "./arm.ts";
import { rowNow } from "./row.ts";
import { singularAt } from "./ghosts.ts";
import { BesideChips } from "../beside/chips.tsx";
import { StepKeys } from "../steps/player.tsx";
import { stepNow } from "../steps/walk.ts";
import { waiting } from "./waiting.ts";

/** The four parameters of the selected row in the order in which they are applied, zero or not. */
function RowList() {
  const said = rowNow.value;
  if (said.length === 0) return null;
  return (
    <div class="scene-row">
      <div class="scene-row-title">
        Row {said[0].index}
        <button type="button" class="scene-row-close" aria-label="Row: show no longer" title="Show no longer" onClick={() => (selected.value = null)}>
          ×
        </button>
      </div>
      <ol>
        {said.map(({ letter, sign, index, cell, number, isZero, words, axis, shape }, k) => (
          <li key={letter} class={[isZero && "scene-row-zero", k === stepNow.value && "scene-row-now"].filter(Boolean).join(" ") || undefined} title={words}>
            <span class={`scene-mark scene-mark-${letter === "r" ? "d" : letter} scene-mark-${shape}`} aria-hidden="true" />
            <span>
              <i>{sign}</i>
              <sub>{index}</sub> = {cell && !isZero ? `${cell} = ` : ""}
              {number}
            </span>
            <span class="scene-row-words">
              {shape === "turn" ? "about" : "along"} <i>{axis.name}</i>
              <sub>{axis.index}</sub>
            </span>
          </li>
        ))}
      </ol>
      <StepKeys />
    </div>
  );
}

function Waits() {
  return (
    <>
      {waiting.value.map(({ words, cancel }) => (
        <div key={words} class="scene-chip">
          <span class="scene-spinner" aria-hidden="true" />
          {words}
          <button type="button" class="scene-chip-button" onClick={cancel}>
            Cancel
          </button>
        </div>
      ))}
    </>
  );
}

/** Changes seldom, so that it is not rendered at every move. */
const isNear = computed(() => scene.value !== null && nearness(scene.value, robot.value?.reach ?? 1) > 0.05);

/** What the orange arms are: each can be taken as the configuration. */
function Singulars() {
  const list = singular.value;
  if (!look.value.singular || !list || list.length === 0 || selected.value !== null) return null;
  const row = ({ factor, why, q }: Singularity, k: number) => (
    <li key={k}>
      <button
        type="button"
        disabled={!q}
        title={why ?? undefined}
        onClick={() => q && move(q)}
        onPointerEnter={() => (singularAt.value = k)}
        onPointerLeave={() => (singularAt.value = null)}
        onFocus={() => (singularAt.value = k)}
        onBlur={() => (singularAt.value = null)}
      >
        <b>{factor.text}</b> {why}
      </button>
    </li>
  );
  // The list numbers all of them, those of the point last.
  const first = list.findIndex((one) => one.of_point);
  const whole = first < 0 ? list.length : first;
  return (
    <div class="scene-row scene-singular">
      {whole > 0 && <div class="scene-row-title">Singular</div>}
      {whole > 0 && <ol>{list.slice(0, whole).map(row)}</ol>}
      {first >= 0 && <div class="scene-row-title">The position alone</div>}
      {first >= 0 && <ol>{list.slice(whole).map((one, k) => row(one, whole + k))}</ol>}
    </div>
  );
}

export function Notes() {
  return (
    <div class="scene-notes">
      <RowList />
      <Singulars />
      <div class="scene-chips" role="status">
        <BesideChips />
        <Waits />
        {isNear.value && <div class="scene-chip scene-chip-near">{isExact(scene.value) ? "Singular" : "Nearly singular"}</div>}
      </div>
    </div>
  );
}
