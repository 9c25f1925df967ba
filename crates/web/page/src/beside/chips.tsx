// What stands beside the arm, and the way to take it away again.

import { look } from "../state.ts";
import { formatWithUnit } from "../units.ts";
import { movesAlong, others, takeAway } from "./beside.ts";

export function BesideChips() {
  return (
    <>
      {others.value.map((one, k) => (
        <div key={k} class="scene-chip">
          <span>
            {one.model.robot}: reaches {formatWithUnit(one.model.reach, "length", look.value, look.value.lengths === "mm" ? 0 : 2)}
            {movesAlong(one) ? ", moves along" : ""}
          </span>
          <button type="button" class="scene-chip-button" aria-label={`Take ${one.model.robot} away`} onClick={() => takeAway(one)}>
            ×
          </button>
        </div>
      ))}
    </>
  );
}
