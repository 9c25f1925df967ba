// What is shown in the scene, and how: a strip of switches.

import { type Look, look, path, show } from "../state.ts";
import { look as lookFrom } from "./cube.tsx";
import { handles } from "./gizmo.ts";
import { bodiesWanted, hasBodies } from "./looks.ts";
import type { Stage } from "./stage.ts";
import { fit } from "./view-fit.ts";

const DRAWINGS = {
  frames: "M5.5 12.5V3M3.5 5l2-2 2 2M5.5 12.5H15M13 10.5l2 2-2 2M5.5 12.5 2.5 15.5",
  labels: "M4 5.5V4h10v1.5M9 4v10M7 14h4",
  bodies: "M5 15.5h8M6.5 15.5v-3.2L4.6 8.4a2.6 2.6 0 0 1 3.6-3.6L11 6.2M9.5 12.3v3.2M8.6 9.6l2.9-2 2.9 1.5a1.6 1.6 0 0 0 .3-3.1L11.5 4",
  ghosts: "M3 15v-5l4-4 3 2M8 15v-4.5l4-4.5 3.5 1.5M2 15h8",
  workspace: "M2.5 13.5a6.5 6.5 0 0 1 13 0zM6.5 13.5a2.5 2.5 0 0 1 5 0",
  singular: "M9 3l6.5 11.5h-13zM9 7.5v3.5M9 12.7v.1",
  ellipsoid: "M2.7 12.6C1.4 10.4 3.7 6.9 7.9 4.7S16 3.5 15.3 5.8 11.3 11.7 7.1 13.9 3.4 13.8 2.7 12.6zM3 12.8 15 5.3",
  path: "M3 14c1-8 5.5-1 7-5s1-5 5-5M3 14h.01M15 4h.01",
  grid: "M3 6.5h12M3 11.5h12M6.5 3v12M11.5 3v12",
  perspective: "M6.5 4h5l3.5 10H3zM4.8 9h8.4M9 4v10",
  fit: "M3 6V3h3M12 3h3v3M15 12v3h-3M6 15H3v-3M7 9h4M9 7v4",
  corner: "M9 2.5l6 3.2v6.6l-6 3.2-6-3.2V5.7zM3 5.7l6 3.3 6-3.3M9 9v6.5",
  move: "M9 2.5v13M2.5 9h13M7 4.5l2-2 2 2M7 13.5l2 2 2-2M4.5 7l-2 2 2 2M13.5 7l2 2-2 2",
  turn: "M14.6 6.2A6.3 6.3 0 1 0 15.3 10M15 2.7v3.6h-3.6",
} as const;

interface ToolProps {
  drawing: keyof typeof DRAWINGS;
  label: string;
  pressed?: boolean;
  onClick: () => void;
}

function Tool({ drawing, label, pressed, onClick }: ToolProps) {
  return (
    <button type="button" class="scene-tool" aria-label={label} title={label} aria-pressed={pressed} onClick={onClick}>
      <svg width="18" height="18" viewBox="0 0 18 18" fill="none" stroke="currentColor" stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">
        <path d={DRAWINGS[drawing]} />
      </svg>
    </button>
  );
}

function Switch({ of, label }: { of: "frames" | "labels" | "ghosts" | "singular" | "ellipsoid" | "path" | "grid" | "perspective"; label: string }) {
  const pressed = look.value[of];
  return <Tool drawing={of} label={label} pressed={pressed} onClick={() => show({ [of]: !pressed })} />;
}

const NEXT: Record<Look["workspace"], Look["workspace"]> = { none: "section", section: "cloud", cloud: "none" };
const WORKSPACE: Record<Look["workspace"], string> = { none: "Workspace", section: "Workspace: section", cloud: "Workspace: cloud" };

function Handles() {
  const { mode, axes } = handles.value;
  const set = (next: "move" | "turn") => () => (handles.value = { axes, mode: mode === next ? "off" : next });
  return (
    <div class="scene-tools" role="group" aria-label="Handles of the hand">
      <Tool drawing="move" label="Handles that move the hand" pressed={mode === "move"} onClick={set("move")} />
      <Tool drawing="turn" label="Handles that turn the hand" pressed={mode === "turn"} onClick={set("turn")} />
      {mode !== "off" && (
        <button
          type="button"
          class="scene-tool scene-tool-words"
          aria-label={`Handles along the axes of the ${axes}; press for the ${axes === "base" ? "tool" : "base"}`}
          title={`Along the axes of the ${axes}`}
          onClick={() => (handles.value = { mode, axes: axes === "base" ? "tool" : "base" })}
        >
          {axes}
        </button>
      )}
    </div>
  );
}

export function Toolbar({ stage }: { stage: Stage }) {
  const space = look.value.workspace;
  return (
    <div class="scene-toolbar" role="toolbar" aria-label="Scene">
      <Handles />
      <div class="scene-tools" role="group" aria-label="Shown">
        {hasBodies.value && <Tool drawing="bodies" label="Bodies of the robot" pressed={bodiesWanted.value} onClick={() => (bodiesWanted.value = !bodiesWanted.value)} />}
        <Switch of="frames" label="Frames" />
        <Switch of="labels" label="Labels" />
        <Switch of="ghosts" label="Other solutions" />
        <Tool drawing="workspace" label={WORKSPACE[space]} pressed={space !== "none"} onClick={() => show({ workspace: NEXT[space] })} />
        <Switch of="singular" label="Singular configurations" />
        <Switch of="ellipsoid" label="Velocity ellipsoid" />
        {path.value && <Switch of="path" label="Path" />}
        <Switch of="grid" label="Floor" />
      </div>
      <div class="scene-tools" role="group" aria-label="View">
        <Switch of="perspective" label="Perspective" />
        <Tool drawing="corner" label="Look from a corner" onClick={() => lookFrom(stage, "corner")} />
        <Tool drawing="fit" label="Fit the arm into view (F)" onClick={() => fit(stage, true)} />
      </div>
    </div>
  );
}
