// Named configurations, as the file has them.

import { JointSymbol } from "../panels/joints.tsx";
import { change, file, robot } from "../state.ts";
import { Button } from "../widgets/button.tsx";
import { onGridKey } from "../widgets/grid.ts";
import { Cell, CellFindings } from "./cell.tsx";
import { findingsOf, flush } from "./cells.ts";

export function PosesTable() {
  const { poses } = file.value;
  const joints = robot.value?.joints ?? [];
  const remove = (index: number) => {
    flush();
    change({ ...file.value, poses: poses.filter((_, at) => at !== index) });
  };
  return (
    <details class="section">
      <summary>
        Named poses <span class="fine">{poses.length === 0 ? "none: save one among the joints" : poses.map((pose) => pose.name).join(", ")}</span>
      </summary>
      {poses.length > 0 && (
        <div class="scroll">
          <table class="cells wide" onKeyDown={onGridKey}>
            <caption class="spoken">Named poses</caption>
            <thead>
              <tr>
                <th scope="col">Name</th>
                {joints.map((joint) => (
                  <th scope="col" key={joint.name}>
                    <JointSymbol name={joint.name} />
                  </th>
                ))}
                <th class="tool-column">
                  <span class="spoken">Remove</span>
                </th>
              </tr>
            </thead>
            <tbody>
              {poses.map((pose, index) => {
                const cells = [
                  { cell: `poses.${index}.name`, name: "Name" },
                  ...pose.values.map((_, at) => ({ cell: `poses.${index}.values.${at}`, name: joints[at]?.name ?? `value ${at + 1}` })),
                ];
                return [
                  <tr key={index}>
                    {cells.map(({ cell, name }, column) => (
                      <td key={column}>
                        <Cell cell={cell} label={`Pose ${index + 1}, ${name}`} row={index} column={column} words={column === 0} />
                      </td>
                    ))}
                    <td class="tool-column">
                      <Button label={`Remove the pose ${pose.name}`} icon="trash" bare small kind="plain" onClick={() => remove(index)} />
                    </td>
                  </tr>,
                  cells.some(({ cell }) => findingsOf(cell).length > 0) && (
                    <tr key={`${index}-findings`} class="finding-row">
                      <td colSpan={cells.length + 1}>
                        <CellFindings cells={cells} />
                      </td>
                    </tr>
                  ),
                ];
              })}
            </tbody>
          </table>
        </div>
      )}
    </details>
  );
}
