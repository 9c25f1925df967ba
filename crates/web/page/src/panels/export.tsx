// What can be taken away beside the robot file: report, code, figures, the path.

import { CodeExport } from "../export/code.tsx";
import { FigureExport } from "../export/figure.tsx";
import { ReportExport } from "../export/report.tsx";
import { fileName, save } from "../export/save.ts";
import { pathCsv } from "../path/csv.ts";
import { path, robot } from "../state.ts";
import { Button } from "../widgets/button.tsx";

export function ExportPanel() {
  const model = robot.value;
  if (!model) return null;
  const planned = path.value;
  const names = model.joints.map((joint) => joint.name);
  return (
    <div class="export-panel">
      <ReportExport />
      <CodeExport />
      <FigureExport />
      <details class="section">
        <summary>Path</summary>
        <p class="fine">{planned ? "Times, joints, speeds and poses as a table; radians and metres." : "There is no path yet: plan one in the panel Path."}</p>
        <div class="row-of-buttons">
          <Button
            label="Save the path (CSV)"
            icon="save"
            disabled={planned === null}
            onClick={() => planned && save(`${fileName()}-path.csv`, pathCsv(planned, names), "text/csv")}
          />
        </div>
      </details>
    </div>
  );
}
