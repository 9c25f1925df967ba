// The report: everything about the robot as a document.

import { addressOf } from "../files.ts";
import { signal } from "@preact/signals";
import type { Input, Output } from "../engine/types.ts";
import { engine, q } from "../state.ts";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { Button, Segments } from "../widgets/button.tsx";
import { zip } from "../zip.ts";
import { fileName, save } from "./save.ts";

type Format = Input<"report">["format"];

const FORMATS: { key: Format; title: string; ending: string; type: string }[] = [
  { key: "html", title: "HTML", ending: "html", type: "text/html" },
  { key: "latex", title: "LaTeX", ending: "tex", type: "text/plain" },
  { key: "typst", title: "Typst", ending: "typ", type: "text/plain" },
  { key: "markdown", title: "Markdown (zip)", ending: "md", type: "text/markdown" },
];

const format = signal<Format>("html");
const language = signal<Input<"report">["language"]>("en");
const writing = new Task<Output<"report">>();

async function write(): Promise<void> {
  const asked = { format: format.peek(), language: language.peek(), q: q.peek() };
  const name = `${fileName()}-report`;
  const answer = await writing.start(() => engine().formulas.call("report", asked));
  if (!answer) return;
  const { ending, type } = FORMATS.find(({ key }) => key === asked.format)!;
  if (answer.files?.length) save(`${name}.zip`, zip([{ path: `${name}/report.md`, text: answer.text }, ...answer.files.map((file) => ({ ...file, path: `${name}/${file.path}` }))]));
  else save(`${name}.${ending}`, asked.format === "html" ? await withFont(answer.text) : answer.text, type);
}

/** The engine leaves a place for the font of the formulas: the page has it already. */
async function withFont(text: string): Promise<string> {
  const bytes = new Uint8Array(await (await fetch(addressOf("maths.woff2"))).arrayBuffer());
  return text.replace("base64,FONT", `base64,${btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))}`);
}

export function ReportExport() {
  const progress = writing.progress.value;
  return (
    <details class="section" open>
      <summary>Report</summary>
      <p class="fine">Figures, table, models, solutions, singularities and workspace, with the present joints as the example.</p>
      <div class="row-of-buttons">
        <select class="field" aria-label="Format of the report" value={format.value} onChange={(event) => (format.value = event.currentTarget.value as Format)}>
          {FORMATS.map(({ key, title }) => (
            <option key={key} value={key}>
              {title}
            </option>
          ))}
        </select>
        <Segments
          label="Language of the report"
          options={[
            { value: "en", label: "English" },
            { value: "fr", label: "Français" },
            { value: "de", label: "Deutsch" },
            { value: "es", label: "Español" },
          ]}
          value={language.value}
          onChange={(next) => (language.value = next)}
        />
        <Button label="Save the report" icon="save" kind="main" disabled={writing.running} onClick={() => void write()} />
      </div>
      <ProgressLine task={writing} words="Writing the report" cancel={() => engine().formulas.cancel()}>
        {progress.kind === "cancelled" && <span class="quiet">Not written.</span>}
      </ProgressLine>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
    </details>
  );
}
