// The scene on the page: the canvas with everything in it, and what stands around the canvas.

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { Button } from "../widgets/button.tsx";
import { addBeside } from "../beside/picture.ts";
import { addMeaning } from "../formula/meaning-picture.ts";
import { addGame } from "../game/picture.ts";
import { addEllipsoid } from "../mobility/picture.ts";
import { answerNow, effect, look, motions, q, robot, scene, selected } from "../state.ts";
import { addArm } from "./arm.ts";
import { isAskedFor, present } from "./camera.ts";
import { Cube } from "./cube.tsx";
import { addFloor } from "./floor.ts";
import { addFrames } from "./frames.ts";
import { addGhosts } from "./ghosts.ts";
import { Gizmo } from "./gizmo.ts";
import { addLooks, wholeTrees } from "./looks.ts";
import { Notes } from "./notes.tsx";
import { addPath } from "./path.ts";
import { addPointer } from "./pointer.ts";
import { addRow } from "./row.ts";
import { graphics, Stage } from "./stage.ts";
import { addSkeleton } from "./skeleton.ts";
import { Toolbar } from "./toolbar.tsx";
import { firstLook } from "./first-look.ts";
import { fit } from "./view-fit.ts";
import { describe } from "./words.ts";
import { addWorkspace } from "./workspace.ts";

/** Words follow when the arm has come to rest. */
const REST = 400;

function build(canvas: HTMLCanvasElement, isSoftware: boolean): Stage {
  const stage = new Stage(canvas, isSoftware);
  // What is to be seen at first has to fit into this.
  [stage.orbit.width, stage.orbit.height] = [Math.max(1, canvas.clientWidth), Math.max(1, canvas.clientHeight)];
  addFloor(stage);
  addArm(stage);
  addFrames(stage);
  addLooks(stage);
  addSkeleton(stage);
  addRow(stage);
  addGame(stage);
  addGhosts(stage);
  addBeside(stage);
  addMeaning(stage);
  addEllipsoid(stage);
  addWorkspace(stage);
  addPath(stage);
  addPointer(stage, new Gizmo(stage));
  stage.watch("perspective", () => look.value.perspective, (isPerspective) => {
    stage.orbit.perspective = isPerspective;
    stage.viewChanged();
  });
  // Another robot is looked at as a whole.
  let name: string | null = null;
  let first = true;
  stage.onEnd(
    effect(() => {
      const model = robot.value;
      if (!model || !scene.value || name === model.robot) return;
      name = model.robot;
      if (!(first && isAskedFor())) {
        stage.orbit.go(firstLook(scene.value), 0);
        fit(stage, false);
      }
      first = false;
    }),
  );
  stage.onEnd(
    effect(() => {
      if (wholeTrees.value > 0) fit(stage, false);
    }),
  );
  let seen = motions.peek();
  stage.onEnd(
    effect(() => {
      if (motions.value === seen) return;
      seen = motions.value;
      if (!stage.orbit.isChosen) fit(stage, true);
    }),
  );
  // The card of a row takes a part of the picture: a view that nobody has chosen makes room for it.
  let hadCard = selected.peek() !== null;
  stage.onEnd(
    effect(() => {
      const hasCard = selected.value !== null;
      if (hasCard === hadCard) return;
      hadCard = hasCard;
      if (!stage.orbit.isChosen) fit(stage, true);
    }),
  );
  return stage;
}

function onKey(stage: Stage, event: KeyboardEvent): void {
  const { orbit } = stage;
  const step = event.shiftKey ? 0.35 : 0.09;
  const acts: Record<string, () => void> = {
    ArrowLeft: () => orbit.turn(step, 0),
    ArrowRight: () => orbit.turn(-step, 0),
    ArrowUp: () => orbit.turn(0, step),
    ArrowDown: () => orbit.turn(0, -step),
    "+": () => orbit.zoom(0.88),
    "=": () => orbit.zoom(0.88),
    "-": () => orbit.zoom(1.14),
    f: () => fit(stage, true),
    F: () => fit(stage, true),
  };
  const act = acts[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
  stage.viewChanged();
}

/** A picture that does not come back by itself is made anew. */
export function SceneView() {
  const [time, again] = useState(0);
  return <Picture key={time} again={() => again(time + 1)} />;
}

function Picture({ again }: { again: () => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useSignal<Stage | null>(null);
  const words = useSignal("Scene");
  const missing = useSignal(false);
  const label = useComputed(() => words.value);

  useEffect(() => {
    const kind = graphics();
    if (!canvas.current || kind === "none") {
      missing.value = true;
      return;
    }
    const element = canvas.current;
    let made: Stage;
    try {
      made = build(element, kind === "software");
    } catch {
      missing.value = true;
      return;
    }
    const box = new ResizeObserver(() => made.resize(element.clientWidth, element.clientHeight));
    box.observe(element);
    made.resize(element.clientWidth, element.clientHeight);
    present(made);
    stage.value = made;
    return () => {
      box.disconnect();
      present(null);
      stage.value = null;
      made.end();
    };
  }, []);

  useEffect(() => {
    let timer = 0;
    const end = effect(() => {
      const parts = [robot.value, scene.value, q.value, (answerNow.value?.solutions.length ?? 1) - 1, look.value] as const;
      clearTimeout(timer);
      timer = window.setTimeout(() => (words.value = describe(parts[0], parts[1], parts[2], parts[3])), REST);
    });
    return () => {
      clearTimeout(timer);
      end();
    };
  }, []);

  if (missing.value) {
    return <p class="scene-missing">This browser shows no WebGL, so there is no picture of the arm. Everything else works.</p>;
  }
  return (
    <div class="scene-view">
      <canvas
        ref={canvas}
        class="scene-canvas"
        tabIndex={0}
        role="application"
        aria-roledescription="3D view"
        aria-label={label}
        aria-keyshortcuts="ArrowLeft ArrowRight ArrowUp ArrowDown + - F"
        onKeyDown={(event) => stage.value && onKey(stage.value, event)}
      />
      {stage.value && <Cube stage={stage.value} />}
      <Notes />
      {stage.value?.isLost.value && (
        <p class="over-scene" role="alert">
          The browser has taken the picture away; it mostly comes back by itself.
          <Button label="Draw it again" small onClick={again} />
        </p>
      )}
      {stage.value && <Toolbar stage={stage.value} />}
    </div>
  );
}
