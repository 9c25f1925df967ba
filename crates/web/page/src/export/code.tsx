// Source code for the robot: a folder that builds and tests itself, looked at and saved.

import { signal } from "@preact/signals";
import { useId } from "preact/hooks";
import type { Input, Output } from "../engine/types.ts";
import { Code } from "../formula/blocks.tsx";
import { engine, revision } from "../state.ts";
import { Failure, ProgressLine, Task } from "../task.tsx";
import { Button } from "../widgets/button.tsx";
import { zip } from "../zip.ts";
import { attempt, fileName, save } from "./save.ts";

type Language = Input<"code">["language"];

const LANGUAGES: { key: Language; title: string }[] = [
  { key: "rust", title: "Rust" },
  { key: "c", title: "C" },
  { key: "python", title: "Python" },
  { key: "matlab", title: "MATLAB" },
  { key: "javascript", title: "JavaScript" },
  { key: "cuda", title: "CUDA" },
  { key: "ikfast", title: "IKFast" },
];

const language = signal<Language>("c");
const opened = signal("");
const writing = new Task<Output<"code"> & { language: Language; revision: number }>();

function write(): void {
  const asked = language.peek();
  const forRevision = revision.peek();
  void writing.start(async () => ({ ...(await engine().formulas.call("code", { language: asked, name: fileName() })), language: asked, revision: forRevision }));
}

export function CodeExport() {
  const progress = writing.progress.value;
  const made = progress.kind === "done" ? progress.answer : null;
  const isCurrent = made !== null && made.language === language.value && made.revision === revision.value;
  return (
    <details class="section">
      <summary>Code</summary>
      <p class="fine">Poses, Jacobian and, where there is a closed form, all inverse solutions; without dependencies, in a folder that tests itself.</p>
      <div class="row-of-buttons">
        <select class="field" aria-label="Language of the code" value={language.value} onChange={(event) => (language.value = event.currentTarget.value as Language)}>
          {LANGUAGES.map(({ key, title }) => (
            <option key={key} value={key}>
              {title}
            </option>
          ))}
        </select>
        <Button label="Write the code" disabled={writing.running} onClick={write} />
        {isCurrent && <Button label="Save as zip" icon="save" kind="main" onClick={() => attempt(() => saved(made))} />}
      </div>
      <ProgressLine task={writing} words="Writing the code" cancel={() => engine().formulas.cancel()}>
        {progress.kind === "cancelled" && <span class="quiet">Not written.</span>}
      </ProgressLine>
      {progress.kind === "failed" && <Failure words={progress.words} hint={progress.hint} />}
      {isCurrent && <Folder made={made} />}
    </details>
  );
}

function saved(made: Output<"code"> & { language: Language }): void {
  const folder = `${fileName()}-${made.language}`;
  save(`${folder}.zip`, zip(made.files.map(({ path, text }) => ({ path: `${folder}/${path}`, text }))));
}

function Folder({ made }: { made: Output<"code"> }) {
  const id = useId();
  const file = made.files.find(({ path }) => path === opened.value) ?? made.files.find(({ path }) => !/\.(md|toml|json|txt)$|test/i.test(path)) ?? made.files[0];
  if (!file) return null;
  return (
    <div class="folder">
      {made.words.split("\n").map((line, k) => (
        <p key={k} class="fine">
          {line}
        </p>
      ))}
      {made.test && (
        <p class="fine">
          To test it: <code>{made.test}</code>
        </p>
      )}
      <label class="labelled" for={id}>
        File
      </label>
      <select id={id} class="field" value={file.path} onChange={(event) => (opened.value = event.currentTarget.value)}>
        {made.files.map(({ path, text }) => (
          <option key={path} value={path}>
            {path} ({lines(text)})
          </option>
        ))}
      </select>
      <Code text={shown(file.text)} label={file.path} copied={file.text} />
    </div>
  );
}

/** More would make the page slow and help nobody. */
const MOST = 60_000;

function shown(text: string): string {
  return text.length <= MOST ? text : `${text.slice(0, MOST)}\n… (the file goes on)`;
}

function lines(text: string): string {
  const count = text.split("\n").length - 1;
  return count === 1 ? "1 line" : `${count} lines`;
}
