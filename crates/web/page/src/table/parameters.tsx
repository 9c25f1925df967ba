// The symbols of the table and their values.

import { change, file } from "../state.ts";
import { Button } from "../widgets/button.tsx";
import { onGridKey } from "../widgets/grid.ts";
import { Cell, CellFindings } from "./cell.tsx";
import { findingsOf, flush } from "./cells.ts";

export function ParametersTable() {
  const { parameters } = file.value;
  const add = () => {
    flush();
    change({ ...file.value, parameters: [...parameters, { name: freeName(), value: "0 mm" }] });
    const cell = `parameters.${parameters.length}.name`;
    requestAnimationFrame(() => document.querySelector<HTMLInputElement>(`input[data-cell="${cell}"]`)?.focus());
  };
  const remove = (index: number) => {
    flush();
    change({ ...file.value, parameters: parameters.filter((_, at) => at !== index) });
  };
  return (
    <details class="section" open>
      <summary>
        Parameters <span class="fine">{parameters.length === 0 ? "none" : "symbols in the table, and their values"}</span>
      </summary>
      {parameters.length > 0 && (
        <table class="cells" onKeyDown={onGridKey}>
          <caption class="spoken">Parameters</caption>
          <thead>
            <tr>
              <th scope="col">Symbol</th>
              <th scope="col">Value</th>
              <th class="tool-column">
                <span class="spoken">Remove</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {parameters.map((parameter, index) => {
              const cells = [
                { cell: `parameters.${index}.name`, name: "Symbol" },
                { cell: `parameters.${index}.value`, name: "Value" },
              ];
              return [
                <tr key={index}>
                  <td>
                    <Cell cell={cells[0].cell} label={`Parameter ${index + 1}, symbol`} row={index} column={0} class="left" />
                  </td>
                  <td>
                    <Cell cell={cells[1].cell} label={`Value of ${parameter.name}`} row={index} column={1} placeholder="no value" />
                  </td>
                  <td class="tool-column">
                    <Button label={`Remove ${parameter.name}`} icon="trash" bare small kind="plain" onClick={() => remove(index)} />
                  </td>
                </tr>,
                cells.some(({ cell }) => findingsOf(cell).length > 0) && (
                  <tr key={`${index}-findings`} class="finding-row">
                    <td colSpan={3}>
                      <CellFindings cells={cells} />
                    </td>
                  </tr>
                ),
              ];
            })}
          </tbody>
        </table>
      )}
      <Button label="Parameter" icon="plus" small hint="Add a parameter" onClick={add} />
    </details>
  );
}

function freeName(): string {
  const taken = new Set(file.value.parameters.map((parameter) => parameter.name));
  for (let number = 1; ; number += 1) {
    if (!taken.has(`L${number}`)) return `L${number}`;
  }
}
