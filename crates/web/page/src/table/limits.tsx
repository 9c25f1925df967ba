// What each joint may do: its limits, and how fast it moves.

import { file, highlighted, robot } from "../state.ts";
import { onGridKey } from "../widgets/grid.ts";
import { Cell, CellFindings } from "./cell.tsx";
import { findingsOf } from "./cells.ts";
import { JointSymbol } from "../panels/joints.tsx";

const COLUMNS = [
  { key: "limits.0", label: "Lowest" },
  { key: "limits.1", label: "Highest" },
  { key: "velocity", label: "Velocity" },
  { key: "acceleration", label: "Acceleration" },
  { key: "name", label: "Name" },
];

export function LimitsTable() {
  const model = robot.value;
  if (!model) return null;
  const given = model.joints.filter((joint) => joint.limits).length;
  return (
    <details class="section" open={file.value.joints.some((_, row) => COLUMNS.some(({ key }) => findingsOf(`joints.${row}.${key}`).some((f) => f.severity === "error"))) || undefined}>
      <summary>
        Limits <span class="fine">{given === 0 ? "none given" : given === model.joints.length ? "for all joints" : `for ${given} of ${model.joints.length} joints`}</span>
      </summary>
      <div class="scroll">
        <table class="cells wide" onKeyDown={onGridKey}>
          <caption class="spoken">Limits of the joints</caption>
          <thead>
            <tr>
              <th scope="col" class="row-number" />
              {COLUMNS.map((column) => (
                <th key={column.key} scope="col">
                  {column.label}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {model.joints.map((joint, index) => {
              const cells = COLUMNS.map(({ key, label }) => ({ cell: `joints.${joint.row}.${key}`, name: label }));
              const wrong = cells.some(({ cell }) => findingsOf(cell).length > 0);
              return [
                <tr key={joint.name} class={highlighted.value.has(index) ? "lit" : undefined}>
                  <th scope="row" class="row-number">
                    <JointSymbol name={joint.name} />
                  </th>
                  {COLUMNS.map(({ key, label }, column) => (
                    <td key={key}>
                      <Cell
                        cell={`joints.${joint.row}.${key}`}
                        label={`${joint.name}, ${label}`}
                        row={index}
                        column={column}
                        words={key === "name"}
                        placeholder={key === "name" ? "" : "–"}
                        onFocus={() => (highlighted.value = new Set([index]))}
                      />
                    </td>
                  ))}
                </tr>,
                wrong && (
                  <tr key={`${joint.name}-findings`} class="finding-row">
                    <td />
                    <td colSpan={COLUMNS.length}>
                      <CellFindings cells={cells} />
                    </td>
                  </tr>
                ),
              ];
            })}
          </tbody>
        </table>
      </div>
    </details>
  );
}
