// A small cube that turns with the view: each of its sides looks from there. One stop for the keyboard; arrows go from
// side to side, and the view follows.

import { useEffect, useRef } from "preact/hooks";
import type { Point } from "../engine/types.ts";
import { scale } from "./geometry.ts";
import { directions, type Face, FACES } from "./orbit.ts";
import type { Stage } from "./stage.ts";

const SIDES = ["front", "right", "back", "left", "top", "bottom"] as const;
/** Half an edge, pixels, as in the style sheet. */
const HALF = 23;

function matrix(x: Point, y: Point, z: Point, at: Point): string {
  return `matrix3d(${[...x, 0, ...y, 0, ...z, 0, ...at, 1].map((n) => n.toFixed(5)).join(",")})`;
}

/** A side of the cube where it stands in the world; down is the page's second direction. */
function placed(face: Face): string {
  const [azimuth, elevation] = FACES[face];
  const { right, up, back } = directions(azimuth, elevation);
  return matrix(right, scale(up, -1), back, scale(back, HALF));
}

export function look(stage: Stage, face: Face): void {
  const [azimuth, elevation] = FACES[face];
  stage.orbit.go({ azimuth, elevation }, stage.ease);
  stage.orbit.isChosen = true;
  stage.viewChanged();
}

export function Cube({ stage }: { stage: Stage }) {
  const cube = useRef<HTMLDivElement>(null);

  useEffect(() => {
    const element = cube.current;
    if (!element) return;
    const faces = [...element.children].filter((child) => child instanceof HTMLElement);
    faces.forEach((face, k) => (face.style.transform = placed(SIDES[k])));
    let before = "";
    const follow = () => {
      const { azimuth, elevation } = stage.orbit.view;
      const { right, up, back } = directions(azimuth, elevation);
      const column = (k: 0 | 1 | 2): Point => [right[k], -up[k], back[k]];
      const next = matrix(column(0), column(1), column(2), [0, 0, 0]);
      if (next !== before) element.style.transform = next;
      before = next;
    };
    follow();
    stage.onView.add(follow);
    return () => void stage.onView.delete(follow);
  }, [stage]);

  const onKeyDown = (event: KeyboardEvent) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    const faces = [...(cube.current?.children ?? [])].filter((child) => child instanceof HTMLElement);
    const at = faces.findIndex((face) => face === document.activeElement);
    if (step === undefined || at < 0) return;
    event.preventDefault();
    const next = (at + step + SIDES.length) % SIDES.length;
    faces.forEach((face, k) => (face.tabIndex = k === next ? 0 : -1));
    faces[next].focus();
    look(stage, SIDES[next]);
  };

  return (
    <div class="scene-cube" role="group" aria-label="Look from a side" onKeyDown={onKeyDown}>
      <div class="scene-cube-body" ref={cube}>
        {SIDES.map((side, k) => (
          <button key={side} type="button" class="scene-cube-side" tabIndex={k === 0 ? 0 : -1} aria-label={`Look from the ${side}`} onClick={() => look(stage, side)}>
            {side}
          </button>
        ))}
      </div>
    </div>
  );
}
