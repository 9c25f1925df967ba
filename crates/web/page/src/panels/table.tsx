// The table: its convention, rows, limits and parameters, base and tool, named poses.

import { game } from "../game/game.ts";
import { GameButton, GamePanel } from "../game/panel.tsx";
import { file, findings, robot } from "../state.ts";
import { CellFindings } from "../table/cell.tsx";
import { ConventionChoice } from "../table/convention.tsx";
import { DhTable } from "../table/dh.tsx";
import { FrameEditor } from "../table/frame.tsx";
import { LimitsTable } from "../table/limits.tsx";
import { ParametersTable } from "../table/parameters.tsx";
import { PosesTable } from "../table/poses.tsx";
import { Cell } from "../table/cell.tsx";
import { Findings } from "../widgets/callout.tsx";

export function TablePanel() {
  return game.value ? <GamePanel now={game.value} /> : <Tables />;
}

function Tables() {
  // What belongs to no cell on this page is said below the rows, so that they stay in place while one types.
  const loose = findings.value.filter((finding) => !finding.cell || !SHOWN.test(finding.cell));
  return (
    <>
      <h2 class="spoken">Table</h2>
      <div class="table-name">
        <Cell cell="name" label="Name of the robot" placeholder="Name of the robot" words class="name" />
        <CellFindings cells={[{ cell: "name", name: "Name" }]} />
      </div>
      <ConventionChoice />
      <DhTable />
      <GameButton />
      {loose.length > 0 && <Findings findings={loose} />}
      <ParametersTable />
      <LimitsTable />
      <FrameEditor of="base" title="Base" words="from the world to the first frame" />
      <FrameEditor of="tool" title="Tool" words="from the last frame to the hand" />
      <PosesTable />
      <details class="section">
        <summary>About</summary>
        <label class="labelled">
          Where the numbers come from
          <Cell cell="source" label="Where the numbers come from" words />
        </label>
        <CellFindings cells={[{ cell: "source", name: "Source" }]} />
        {robot.value && robot.value.remarks.length > 0 && (
          <ul class="remarks">
            {robot.value.remarks.map((remark) => (
              <li key={remark}>{remark}</li>
            ))}
          </ul>
        )}
        {file.value.gravity && <p class="fine">Gravity: {file.value.gravity.join(", ")}</p>}
      </details>
    </>
  );
}

/** Cells that have a field on this page. */
const SHOWN =
  /^(name|source|convention|joints\.\d+\.(name|theta|d|a|alpha|r|gamma|b|velocity|acceleration|limits\.[01])|parameters\.\d+\.(name|value)|(base|tool)\.(xyz|rpy|matrix\.\d)\.\d|poses\.\d+\.(name|values\.\d+))$/;
