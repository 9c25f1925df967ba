// A constant transform at an end of the chain: a displacement and angles about fixed axes, or a matrix.

import { change, file } from "../state.ts";
import { Button } from "../widgets/button.tsx";
import { onGridKey } from "../widgets/grid.ts";
import { Cell, CellFindings } from "./cell.tsx";
import { flush } from "./cells.ts";

interface FrameEditorProps {
  of: "base" | "tool";
  title: string;
  words: string;
}

export function FrameEditor({ of, title, words }: FrameEditorProps) {
  const frame = file.value[of];
  const set = (next: typeof frame) => {
    flush();
    const { [of]: _, ...rest } = file.value;
    change(next ? { ...rest, [of]: next } : rest);
  };
  return (
    <details class="section" open={frame !== undefined || undefined}>
      <summary>
        {title} <span class="fine">{frame ? words : "none"}</span>
      </summary>
      {frame?.matrix ? <MatrixCells of={of} matrix={frame.matrix} /> : <FrameCells of={of} />}
      {frame && (
        <div class="row-of-buttons">
          <Button label={`No ${of}`} icon="trash" small kind="plain" onClick={() => set(undefined)} />
          {frame.matrix && <Button label="Type xyz and rpy instead" small onClick={() => set({ xyz: ["0", "0", "0"], rpy: ["0", "0", "0"] })} />}
        </div>
      )}
    </details>
  );
}

const ROWS = [
  { key: "xyz", words: "Displacement", names: ["x", "y", "z"] },
  { key: "rpy", words: "Roll, pitch, yaw", names: ["roll", "pitch", "yaw"] },
];

function FrameCells({ of }: { of: "base" | "tool" }) {
  return (
    <table class="cells" onKeyDown={onGridKey}>
      <tbody>
        {ROWS.map(({ key, words, names }, row) => [
          <tr key={key}>
            <th scope="row" class="row-words">
              {words}
            </th>
            {names.map((name, column) => (
              <td key={name}>
                <Cell cell={`${of}.${key}.${column}`} label={`${of}, ${name}`} row={row} column={column} placeholder="0" />
              </td>
            ))}
          </tr>,
          <tr key={`${key}-findings`} class="finding-row">
            <td colSpan={4}>
              <CellFindings cells={names.map((name, column) => ({ cell: `${of}.${key}.${column}`, name }))} />
            </td>
          </tr>,
        ])}
      </tbody>
    </table>
  );
}

function MatrixCells({ of, matrix }: { of: "base" | "tool"; matrix: string[][] }) {
  return (
    <table class="cells" onKeyDown={onGridKey}>
      <caption class="spoken">{`${of} as a matrix`}</caption>
      <tbody>
        {matrix.map((entries, row) => [
          <tr key={row}>
            {entries.map((_, column) => (
              <td key={column}>
                <Cell cell={`${of}.matrix.${row}.${column}`} label={`${of}, row ${row + 1}, column ${column + 1}`} row={row} column={column} />
              </td>
            ))}
          </tr>,
          <tr key={`${row}-findings`} class="finding-row">
            <td colSpan={4}>
              <CellFindings cells={entries.map((_, column) => ({ cell: `${of}.matrix.${row}.${column}`, name: `column ${column + 1}` }))} />
            </td>
          </tr>,
        ])}
      </tbody>
    </table>
  );
}
