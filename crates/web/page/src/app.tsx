// The frame of the page: the bar above, the scene, the panels beside it, the line below.

import { Component, type ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import { asked } from "./asked.ts";
import { Divider } from "./divider.tsx";
import { CheckPanel } from "./panels/check.tsx";
import { FormulasPanel } from "./panels/formulas.tsx";
import { HandPanel } from "./panels/hand.tsx";
import { JointsPanel } from "./panels/joints.tsx";
import { PathPanel } from "./panels/path.tsx";
import { chooseFile, dialog, openFiles, RobotsDialog, saveFile } from "./panels/robots.tsx";
import { SharePanel } from "./panels/share.tsx";
import { TablePanel } from "./panels/table.tsx";
import { runPlayer } from "./scene/player.ts";
import { SceneView } from "./scene/view.tsx";
import { address } from "./share.ts";
import { phase, side } from "./shell.ts";
import { batch, file, look, message, type Panel, panel, robot, said, selected, stale } from "./state.ts";
import { runSteps } from "./steps/walk.ts";
import { undoByKey } from "./table/undoing.ts";
import { TopBar } from "./top.tsx";
import { ChainBar } from "./tree/chain.tsx";
import { ofDrop } from "./tree/files.ts";
import { formatWithUnit } from "./units.ts";
import { Callout } from "./widgets/callout.tsx";
import { Icon } from "./widgets/icons.tsx";
import { StatusLine } from "./widgets/status.tsx";
import { panelId, tabId, Tabs } from "./widgets/tabs.tsx";

const PANELS: { value: Panel; label: string; view: () => ComponentChildren }[] = [
  { value: "table", label: "Table", view: () => <TablePanel /> },
  { value: "joints", label: "Joints", view: () => <JointsPanel /> },
  { value: "hand", label: "Hand", view: () => <HandPanel /> },
  { value: "formulas", label: "Formulas", view: () => <FormulasPanel /> },
  { value: "path", label: "Path", view: () => <PathPanel /> },
  { value: "check", label: "Check", view: () => <CheckPanel /> },
  { value: "share", label: "Share", view: () => <SharePanel /> },
];

const { embedded } = asked;

export function App() {
  const isReady = phase.value.kind === "ready";
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (phase.value.kind !== "ready" || undoByKey(event)) return;
      if (embedded || !(event.ctrlKey || event.metaKey) || event.altKey || event.shiftKey) return;
      const action = { s: saveFile, o: chooseFile, k: () => (dialog.value = { part: "catalogue" }) }[event.key as "s" | "o" | "k"];
      if (!action) return;
      event.preventDefault();
      action();
    };
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, []);
  // Clocks run without a picture, too.
  useEffect(runPlayer, []);
  useEffect(runSteps, []);
  useEffect(() => {
    document.title = file.value.name ? `${file.value.name} – Denavit` : "Denavit";
  }, [file.value.name]);

  return (
    <div class={embedded ? `page embedded embedded-${embedded}` : "page"}>
      {!embedded && <TopBar />}
      <main class="work" style={side.value === null ? undefined : { "--side": `${side.value}px` }}>
        {embedded !== "panel" && (
          <section class="scene" aria-label="Scene">
            <ScenePart />
          </section>
        )}
        {!embedded && <Divider />}
        {embedded !== "scene" && <Side isReady={isReady} />}
      </main>
      {embedded ? <Guest /> : <StatusLine resting={phase.value.kind === "loading" ? "Loading the engine …" : ""} />}
      {isReady && <RobotsDialog />}
      <DropZone />
    </div>
  );
}

function Side({ isReady }: { isReady: boolean }) {
  const now = PANELS.find((one) => one.value === panel.value);
  const tabbed = embedded ? {} : { role: "tabpanel" as const, id: panelId("side"), "aria-labelledby": tabId("side", panel.value) };
  return (
    <section class="side" aria-label={embedded ? now?.label : "Panels"}>
      {!embedded && (
        <Tabs
          label="Panels"
          id="side"
          tabs={PANELS.map(({ value, label }) => ({ value, label, mark: value === "table" && stale.value ? "has errors" : undefined }))}
          value={panel.value}
          onChange={turnTo}
        />
      )}
      <div class="panel" {...tabbed} tabIndex={0} key={panel.value}>
        {isReady && <Assumed />}
        {isReady && (panel.value === "table" || panel.value === "joints") && <ChainBar />}
        {isReady && <Guarded key={panel.value}>{now?.view()}</Guarded>}
      </div>
    </section>
  );
}

/** In another page: what went wrong, and the way to the whole page with all that is shown here. */
function Guest() {
  const now = message.value;
  const name = file.value.name;
  return (
    <footer class="guest">
      <span role="status" aria-live="polite" class={now?.severity === "error" ? "status error" : "status"}>
        {now ? [now.words, now.hint].filter(Boolean).join(" ") : ""}
      </span>
      <button type="button" class="button plain small" title={`${name}: open the whole page with all that is shown here`} onClick={() => void address().then((url) => open(url, "_blank", "noopener"))}>
        {name} in Denavit
      </button>
    </footer>
  );
}

/** Lengths that the robot gives no values for: every number of the page takes those that are said here. */
function Assumed() {
  const chosen = robot.value?.parameters.filter((parameter) => !parameter.given) ?? [];
  if (chosen.length === 0) return null;
  const words = chosen.map(({ name, value, measure }) => `${name} = ${formatWithUnit(value, measure, look.value)}`);
  return (
    <Callout tone="warning">
      No values are known for some parameters. Picture and numbers take {words.join(", ")}; the formulas hold for all.
    </Callout>
  );
}

/** While a row is explained the arm has neither handles nor ghosts: who goes to the hand or a path needs both. */
function turnTo(next: Panel): void {
  batch(() => {
    panel.value = next;
    if (next === "hand" || next === "path") selected.value = null;
  });
}

function ScenePart() {
  if (phase.value.kind === "failed") {
    return (
      <div class="whole" role="alert">
        <p>{phase.value.words}</p>
      </div>
    );
  }
  if (phase.value.kind === "loading") return null;
  return (
    <>
      <Guarded>
        <SceneView />
      </Guarded>
      {stale.value && (
        <p class="over-scene error" role="status">
          <Icon name="error" size={16} />
          {robot.value ? "The table has an error: this is the last arm without one." : "The arm appears once the table is right."}
        </p>
      )}
    </>
  );
}

/** A part that fails says so in its place, and leaves the others working. */
class Guarded extends Component<{ children: ComponentChildren }, { why: string | null }> {
  state = { why: null };

  static getDerivedStateFromError(why: unknown) {
    return { why: why instanceof Error ? why.message : String(why) };
  }

  componentDidCatch(why: unknown) {
    console.error(why);
  }

  render() {
    if (this.state.why === null) return this.props.children;
    return (
      <div class="whole" role="alert">
        <p>
          This part of the page has failed: {this.state.why}{" "}
          <button type="button" class="button small" onClick={() => this.setState({ why: null })}>
            Try again
          </button>
        </p>
      </div>
    );
  }
}

/** A file dropped anywhere is opened. */
function DropZone() {
  const [isOver, setOver] = useState(false);
  useEffect(() => {
    const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    const over = (event: DragEvent) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      setOver(true);
    };
    const leave = (event: DragEvent) => {
      if (!event.relatedTarget) setOver(false);
    };
    const drop = (event: DragEvent) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      setOver(false);
      if (!event.dataTransfer || phase.value.kind !== "ready") return;
      // What was dropped can be listed only now.
      ofDrop(event.dataTransfer).then(openFiles).catch(said);
    };
    addEventListener("dragover", over);
    addEventListener("dragleave", leave);
    addEventListener("drop", drop);
    return () => {
      removeEventListener("dragover", over);
      removeEventListener("dragleave", leave);
      removeEventListener("drop", drop);
    };
  }, []);
  return isOver ? <div class="drop">Drop to open</div> : null;
}
