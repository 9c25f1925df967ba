// Where a robot comes from: the catalogue, a file, a table pasted from a document. And where it goes: a file.

import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Convention, Finding, Input, Listed, Output } from "../engine/types.ts";
import { batch, effect, engine, file, note, panel, replace, said, signal, stale } from "../state.ts";
import { isRecording, openRecording } from "../recorded/recorded.ts";
import { flush } from "../table/cells.ts";
import { CONVENTIONS } from "../table/convention.tsx";
import { TreePart } from "../tree/dialog.tsx";
import { type Lying, ofInput } from "../tree/files.ts";
import { alone, asked, isTree, openTree, read as readTree } from "../tree/open.ts";
import { stand } from "../beside/beside.ts";
import { ArmPicture } from "../gallery/picture.tsx";
import { pictures, unwant, want } from "../gallery/pictures.ts";
import { Button, Segments } from "../widgets/button.tsx";
import { Findings } from "../widgets/callout.tsx";
import { download } from "../widgets/copy.tsx";
import { Dialog } from "../widgets/dialog.tsx";
import { Icon } from "../widgets/icons.tsx";
import { byKey } from "../widgets/keys.ts";
import { sentence } from "../widgets/words.tsx";
import { panelId, tabId, Tabs } from "../widgets/tabs.tsx";

type Part = "catalogue" | "text" | "tree";

/** The dialog, if it is open, with what it begins with. */
export const dialog = signal<{ part: Part; text?: string; name?: string; findings?: Finding[] } | null>(null);

type ForeignKind = Input<"read">["kind"];
type Kind = Input<"open">["kind"] | ForeignKind;

/** A file larger than this is no robot description, bytes. */
const MOST_BYTES = 2_000_000;
/** A tree is written by programs, and larger, bytes. */
const MOST_TREE_BYTES = 16 * 2 ** 20;

/** What became of a text: whether it is the robot now, and what was found. */
interface Became {
  opened: boolean;
  findings: Finding[];
}

/** A robot of the catalogue or a robot file. */
function openOwn(text: string, kind: Input<"open">["kind"]): Became {
  return became(engine().now.call("open", { text, kind }));
}

/** A text of whatever kind as a robot. */
async function open(text: string, kind: Kind, options: Omit<Input<"read">, "text" | "kind"> = {}): Promise<Became> {
  if (kind === "toml" || kind === "robot") return openOwn(text, kind);
  return became(await engine().files.call("read", { text, kind, ...options }));
}

function became(answer: Output<"open">): Became {
  // A robot file without a table, or one that can be read in several ways, is not shown in the place of the robot.
  const isTable = answer.file && answer.file.joints.length > 0 && CONVENTIONS.some((one) => one.value === answer.file?.convention);
  if (!answer.file || !isTable) return { opened: false, findings: answer.findings };
  replace(answer.file);
  return { opened: true, findings: answer.findings };
}

/** A robot of the catalogue, by name. */
export function openListed(name: string): void {
  try {
    const { opened, findings } = openOwn(name, "robot");
    if (!opened) said(new Error(findings[0]?.message ?? `There is no robot “${name}”.`));
  } catch (why) {
    said(why);
  }
}

// What has to be asked about a description of a tree is asked in the dialog.
effect(() => {
  if (asked.value && dialog.peek()?.part !== "tree") dialog.value = { part: "tree" };
});

/** A description of a tree that stands in one text. */
function openTreeText(text: string, name: string): void {
  void readTree(alone(name, text), { main: name, given: "", asWritten: false }).then(treeIsTaken).catch(said);
}

function treeIsTaken(taken: boolean): void {
  if (taken) dialog.value = null;
}

/** A text with its file's name. Where it cannot be read the dialog opens with the text and what is wrong. */
export async function openText(text: string, name: string): Promise<void> {
  if (/\.(urdf|xacro|mjcf)$/i.test(name) || isTree(text)) return openTreeText(text, name);
  try {
    const { opened, findings } = await open(text, kindOf(name));
    if (opened) {
      batch(() => {
        dialog.value = null;
        if (stale.value) panel.value = "table";
      });
      const remarks = findings.filter((finding) => finding.severity !== "error").map((finding) => sentence(finding.message));
      note([`Opened ${name}.`, stale.value ? "Its table has errors, which are said under the cells." : "", ...remarks].filter(Boolean).join(" "));
    } else dialog.value = { part: "text", text, name, findings };
  } catch (why) {
    said(why);
  }
}

function kindOf(name: string): Kind {
  const ending = /\.([a-z]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  const kinds: Record<string, Kind> = { toml: "toml", md: "markdown", markdown: "markdown", csv: "csv", tsv: "csv", tex: "latex" };
  return Object.hasOwn(kinds, ending) ? kinds[ending] : "any";
}

/** Files that were chosen or dropped: a robot file, a table, a tree with what belongs to it, or a recording. */
export async function openFiles(files: Lying[]): Promise<void> {
  try {
    const [only] = files;
    if (!only) throw new Error("There is no file in it.");
    if (files.length > 1 || /\.zip$/i.test(only.path)) return treeIsTaken(await openTree(files));
    if (await isRecording(only)) {
      dialog.value = null;
      return await openRecording(only);
    }
    const isTreeFile = /\.(urdf|xacro|xml|mjcf)$/i.test(only.path);
    if (only.size > (isTreeFile ? MOST_TREE_BYTES : MOST_BYTES)) {
      throw new Error(`${only.path} is larger than ${isTreeFile ? "16 MiB" : "2 MB"}: it is not a robot description.`);
    }
    await openText(new TextDecoder().decode(await only.read()), only.path);
  } catch (why) {
    said(why);
  }
}

/** Asks for a file. */
export function chooseFile(): void {
  ask((input) => {
    input.accept = ".toml,.md,.markdown,.csv,.tsv,.tex,.txt,.urdf,.xacro,.xml,.mjcf,.zip,.jsonl,.ndjson,.npy,.npz,.parquet";
  });
}

/** Asks for a folder. */
export function chooseFolder(): void {
  ask((input) => {
    input.webkitdirectory = true;
  });
}

function ask(about: (input: HTMLInputElement) => void): void {
  const input = document.createElement("input");
  input.type = "file";
  about(input);
  input.onchange = () => {
    if (input.files && input.files.length > 0) void openFiles(ofInput(input.files));
  };
  input.click();
}

/** Saves the robot file, as it is now, with errors if it has some. */
export function saveFile(): void {
  flush();
  try {
    const { text } = engine().now.call("write", { file: file.value });
    download(`${slug(file.value.name)}.toml`, text, "application/toml");
    note("The robot file is saved.");
  } catch (why) {
    said(why);
  }
}

export function slug(name: string): string {
  const words = name.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase().match(/[a-z0-9]+/g);
  return words?.join("-").slice(0, 60) || "robot";
}

/** What was asked is forgotten with the dialog. */
function close(): void {
  batch(() => {
    dialog.value = null;
    asked.value = null;
  });
}

export function RobotsDialog() {
  const shown = dialog.value;
  if (!shown) return null;
  return (
    <Dialog title="Choose a robot" onClose={close}>
      <div class="robots">
        <Tabs
          label="Where from"
          id="robots"
          value={shown.part}
          onChange={(part) => (dialog.value = { ...shown, part })}
          tabs={[
            { value: "catalogue" as const, label: "Catalogue" },
            { value: "text" as const, label: "Paste or open" },
            { value: "tree" as const, label: "URDF, xacro" },
          ]}
        />
        <div class="body" role="tabpanel" id={panelId("robots")} aria-labelledby={tabId("robots", shown.part)}>
          {shown.part === "catalogue" && <Catalogue />}
          {shown.part === "text" && <FromText text={shown.text ?? ""} name={shown.name ?? ""} findings={shown.findings ?? []} />}
          {shown.part === "tree" && <TreePart chooseFile={chooseFile} chooseFolder={chooseFolder} done={close} />}
        </div>
      </div>
    </Dialog>
  );
}

let listed: Listed[] | null = null;
/** How the catalogue is shown, as it was left. */
const shownAs = signal<"list" | "pictures">("list");

function Catalogue() {
  const [words, setWords] = useState("");
  const [active, setActive] = useState(0);
  const search = useRef<HTMLInputElement>(null);
  listed ??= engine().now.call("catalogue", {}).robots;
  const found = useMemo(() => filter(listed ?? [], words), [words]);
  useLayoutEffect(() => search.current?.focus(), []);

  const take = (name: string) => {
    dialog.value = null;
    openListed(name);
  };
  const step = (to: number) => {
    setActive(to);
    document.getElementById(`listed-${to}`)?.scrollIntoView({ block: "nearest" });
  };
  const at = Math.min(active, found.length - 1);
  /** How many stand side by side. */
  const across = () => {
    const tops = [...document.querySelectorAll<HTMLElement>("#listed > .robot")].map((one) => one.offsetTop);
    return Math.max(1, tops.filter((top) => top === tops[0]).length);
  };
  return (
    <div class="catalogue">
      <div class="search">
        <Icon name="search" />
        <input
          ref={search}
          class="field"
          type="text"
          role="combobox"
          aria-label="Search the catalogue: name, maker, joints such as RRPR"
          aria-expanded="true"
          aria-controls="listed"
          aria-activedescendant={found.length > 0 ? `listed-${at}` : undefined}
          aria-autocomplete="list"
          autofocus
          autocomplete="off"
          placeholder="Name, maker, or joints such as RRPR"
          value={words}
          onInput={(event) => {
            setWords(event.currentTarget.value);
            setActive(0);
          }}
          onKeyDown={(event) => {
            const last = found.length - 1;
            const to = byKey(event, {
              ArrowDown: Math.min(at + across(), last),
              ArrowUp: Math.max(at - across(), 0),
              ...(shownAs.value === "pictures" && words === "" ? { ArrowRight: Math.min(at + 1, last), ArrowLeft: Math.max(at - 1, 0) } : {}),
              PageDown: Math.min(at + 8, last),
              PageUp: Math.max(at - 8, 0),
            });
            if (to !== undefined && last >= 0) {
              event.preventDefault();
              step(to);
            } else if (event.key === "Enter" && found[at]) {
              event.preventDefault();
              take(found[at].name);
            }
          }}
        />
        <span class="fine number" role="status">
          {found.length} of {listed.length}
        </span>
        <Segments
          label="Shown as"
          options={[
            { value: "list" as const, label: "List" },
            { value: "pictures" as const, label: "Pictures" },
          ]}
          value={shownAs.value}
          onChange={(next) => (shownAs.value = next)}
        />
      </div>
      <div class={shownAs.value === "list" ? "listed" : "listed pictured"} id="listed" role="listbox" aria-label="Robots">
        {found.map((robot, index) => (
          <div
            key={robot.name}
            id={`listed-${index}`}
            role="option"
            aria-selected={index === at}
            class={index === at ? "robot active" : "robot"}
            title={robot.source ?? undefined}
            onClick={() => take(robot.name)}
            onPointerMove={() => setActive(index)}
          >
            {shownAs.value === "pictures" && <Pictured name={robot.name} />}
            <span class="robot-title">{robot.title}</span>
            <span class="robot-joints">{robot.joints}</span>
            <span class="robot-convention">{robot.convention}</span>
          </div>
        ))}
      </div>
      {found[at] && (
        <div class="row-of-buttons end">
          <Button label="Stand it beside the arm" small hint={`${found[at].title} in the same picture, to be compared`} onClick={() => besideIt(found[at].name)} />
          <Button label={`Open ${found[at].title}`} kind="main" small onClick={() => take(found[at].name)} />
        </div>
      )}
      {found.length === 0 && <p class="quiet">No robot of the catalogue is called so. Its table can be pasted, or typed from an empty one.</p>}
    </div>
  );
}

function besideIt(name: string): void {
  try {
    stand(name);
    dialog.value = null;
  } catch (why) {
    said(why);
  }
}

/** The picture of a robot, once it has come into view and its turn. */
function Pictured({ name }: { name: string }) {
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    const element = place.current;
    if (!element) return;
    const watcher = new IntersectionObserver(([entry]) => (entry.isIntersecting ? want(name) : unwant(name)), { rootMargin: "200px" });
    watcher.observe(element);
    return () => {
      watcher.disconnect();
      unwant(name);
    };
  }, [name]);
  const scene = pictures.value.get(name);
  return (
    <span class="picture-place" ref={place}>
      {scene && <ArmPicture scene={scene} />}
    </span>
  );
}

/** Every word has to occur somewhere; accents and hyphens do not matter. */
function filter(robots: Listed[], words: string): Listed[] {
  const wanted = plain(words).split(" ").filter(Boolean);
  return robots.filter((robot) => {
    const text = plain(`${robot.name} ${robot.title} ${robot.joints} ${robot.convention}`);
    return wanted.every((word) => text.includes(word));
  });
}

function plain(text: string): string {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase().replace(/[^a-z0-9]+/g, " ");
}

const KINDS: { value: Kind; label: string }[] = [
  { value: "any", label: "Find out" },
  { value: "markdown", label: "Markdown table" },
  { value: "csv", label: "CSV" },
  { value: "latex", label: "LaTeX" },
  { value: "toml", label: "Robot file (TOML)" },
];

const EXAMPLE = `| j | α | d | θ | r |
|---|---|---|---|---|
| 1 | 0 | 0 | θ1 | 0 |
| 2 | 90° | 0 | θ2 | 0 |
| 3 | 0 | D3 | θ3 | 0 |`;

/** What the engine's hint calls the choice of a table; the page has a field for it. */
const OPTION = "choose one with --table:";

function FromText({ text: first, name, findings: firstFindings }: { text: string; name: string; findings: Finding[] }) {
  const [text, setText] = useState(first);
  const [kind, setKind] = useState<Kind>(name ? kindOf(name) : "any");
  const [convention, setConvention] = useState<Convention | "">("");
  const [angles, setAngles] = useState<"" | "deg" | "rad">("");
  const [lengths, setLengths] = useState<"" | "mm" | "m">("");
  const [table, setTable] = useState(1);
  const [findings, setFindings] = useState(firstFindings);
  const choice = useRef<HTMLSelectElement>(null);
  const asksConvention = convention === "" && findings.some((finding) => /convention/i.test(`${finding.message} ${finding.hint ?? ""}`));

  // The engine says which tables there are where it needs to be told.
  const tables = findings.map((finding) => finding.hint ?? "").find((hint) => hint.includes(OPTION));
  const [asksTable, setAsksTable] = useState(false);
  useEffect(() => {
    if (tables) setAsksTable(true);
  }, [tables]);

  const read = async () => {
    if (kind === "any" && isTree(text)) return openTreeText(text, name || "pasted.urdf");
    try {
      const answer = await open(text, kind, {
        convention: convention || undefined,
        degrees: angles === "" ? undefined : angles === "deg",
        millimetres: lengths === "" ? undefined : lengths === "mm",
        table: asksTable ? table : undefined,
      });
      setFindings(answer.findings.map((finding) => ({ ...finding, hint: finding.hint?.replace(OPTION, "choose one below:") ?? null })));
      if (answer.findings.some((finding) => finding.hint?.includes(OPTION))) setAsksTable(true);
      if (answer.opened) {
        batch(() => {
          dialog.value = null;
          panel.value = "table";
        });
        note(answer.findings.length > 0 ? answer.findings.map((finding) => sentence(finding.message)).join(" ") : "The table is read.");
      } else if (convention === "" && answer.findings.some((finding) => /convention/i.test(finding.message))) choice.current?.focus();
    } catch (why) {
      setFindings([{ severity: "error", message: why instanceof Error ? why.message : String(why), hint: null }]);
    }
  };

  return (
    <form
      class="from-text"
      onSubmit={(event) => {
        event.preventDefault();
        void read();
      }}
    >
      <div class="row-of-buttons">
        <Button label="Open a file" icon="open" onClick={chooseFile} />
        <span class="fine">or drop one anywhere on this page: a robot file, Markdown, CSV, LaTeX, URDF or xacro.</span>
      </div>
      <label class="labelled">
        {name || "A table, as it stands in a document"}
        <textarea
          class="field"
          rows={9}
          spellcheck={false}
          value={text}
          placeholder={EXAMPLE}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      </label>
      <div class="choices">
        {asksTable && (
          <label class="labelled">
            Which table
            <input class="field" type="number" min={1} value={table} onInput={(event) => setTable(Math.max(1, Math.round(event.currentTarget.valueAsNumber) || 1))} />
          </label>
        )}
        <label class="labelled">
          Written as
          <select class="field" value={kind} onChange={(event) => setKind(event.currentTarget.value as Kind)}>
            {KINDS.map((one) => (
              <option key={one.value} value={one.value}>
                {one.label}
              </option>
            ))}
          </select>
        </label>
        <label class={asksConvention ? "labelled asked" : "labelled"}>
          Convention
          <select
            ref={choice}
            class="field"
            value={convention}
            aria-invalid={asksConvention ? "true" : undefined}
            onChange={(event) => setConvention(event.currentTarget.value as Convention | "")}
          >
            <option value="">As the text says</option>
            {CONVENTIONS.map((one) => (
              <option key={one.value} value={one.value}>
                {one.label}
              </option>
            ))}
          </select>
        </label>
        <label class="labelled">
          Angles without a unit
          <select class="field" value={angles} onChange={(event) => setAngles(event.currentTarget.value as "" | "deg" | "rad")}>
            <option value="">As the text says</option>
            <option value="deg">Degrees</option>
            <option value="rad">Radians</option>
          </select>
        </label>
        <label class="labelled">
          Lengths without a unit
          <select class="field" value={lengths} onChange={(event) => setLengths(event.currentTarget.value as "" | "mm" | "m")}>
            <option value="">As the text says</option>
            <option value="mm">Millimetres</option>
            <option value="m">Metres</option>
          </select>
        </label>
      </div>
      <Findings findings={findings} />
      <div class="row-of-buttons end">
        <Button label="Begin with an empty table" kind="plain" onClick={empty} />
        <Button label="Read the table" kind="main" disabled={text.trim() === ""} onClick={read} />
      </div>
    </form>
  );
}

function empty(): void {
  batch(() => {
    replace({
      name: "New robot",
      convention: "standard",
      parameters: [{ name: "L1", value: "400 mm" }],
      joints: [{ theta: "q1", a: "L1" }],
      poses: [],
    });
    dialog.value = null;
    panel.value = "table";
  });
}
