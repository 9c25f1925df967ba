// Figures: the arm or its line diagram as a drawing, and the view of the scene as a picture.

import { signal } from "@preact/signals";
import { Picture } from "../formula/figure.tsx";
import { camera, picture } from "../scene/camera.ts";
import { engine, q, revision } from "../state.ts";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { Button, Segments } from "../widgets/button.tsx";
import { rasterised } from "./png.ts";
import { attempt, fileName, save } from "./save.ts";

const kind = signal<"arm" | "scheme">("arm");
const drawing = new Task<{ svg: string; kind: string; revision: number }>();

function draw(): void {
  const [azimuth, elevation] = camera();
  const asked = { q: q.peek(), scheme: kind.peek() === "scheme", azimuth, elevation };
  const known = { kind: kind.peek(), revision: revision.peek() };
  void drawing.start(async () => ({ ...(await engine().formulas.call("figure", asked)), ...known }));
}

export function FigureExport() {
  const progress = drawing.progress.value;
  const made = progress.kind === "done" ? progress.answer : null;
  const name = `${fileName()}-${kind.value === "scheme" ? "diagram" : "arm"}`;
  const isCurrent = made !== null && made.kind === kind.value && made.revision === revision.value;
  return (
    <details class="section">
      <summary>Figure</summary>
      <p class="fine">A drawing with lines for print, seen from where the scene is seen, or the scene as it is.</p>
      <div class="row-of-buttons">
        <Segments
          label="What is drawn"
          options={[
            { value: "arm", label: "Arm" },
            { value: "scheme", label: "Line diagram" },
          ]}
          value={kind.value}
          onChange={(next) => (kind.value = next)}
        />
        <Button label="Draw" disabled={drawing.running} onClick={draw} />
        <Button label="Save the view (PNG)" onClick={() => attempt(async () => save(`${fileName()}-view.png`, await picture()))} />
      </div>
      <ProgressLine task={drawing} words="Drawing" cancel={() => engine().formulas.cancel()}>
        {isCurrent && (
          <>
            <Button label="Save SVG" icon="save" small onClick={() => save(`${name}.svg`, made.svg, "image/svg+xml")} />
            <Button label="Save PNG" icon="save" small onClick={() => attempt(async () => save(`${name}.png`, await rasterised(made.svg, 3)))} />
          </>
        )}
      </ProgressLine>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      {isCurrent && (
        <div class="on-paper">
          <Picture svg={made.svg} words={kind.value === "scheme" ? "Line diagram of the arm" : "The arm"} />
        </div>
      )}
    </details>
  );
}
