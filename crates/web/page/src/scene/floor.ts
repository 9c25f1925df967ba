// The floor: a grid whose cells are a round length, fading with distance, with that length written at it.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";
import type { Point } from "../engine/types.ts";
import { look, robot, scene } from "../state.ts";
import { floor, floorOf } from "./arm.ts";
import { corners, wholeTrees } from "./looks.ts";
import type { Stage } from "./stage.ts";
import { blend, colours } from "./theme.ts";
import { inLength } from "./units.ts";

const CELLS = 9;
/** Lines are cut so that they can fade. */
const CUTS = 8;

/** 1, 2 or 5 times a power of ten, at most this. */
function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  const digit = most / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

export function addFloor(stage: Stage): void {
  const geometry = new BufferGeometry();
  const vertices = 2 * (2 * CELLS + 1) * CUTS * 2;
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * vertices), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(3 * vertices), 3));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, depthWrite: false }));
  lines.frustumCulled = false;
  lines.renderOrder = -1;
  stage.add(lines);
  stage.onEnd(() => {
    geometry.dispose();
    lines.material.dispose();
  });

  const reach = () => robot.value?.reach ?? 1;
  stage.watch(
    "floor",
    () => ({ palette: colours.value, isShown: look.value.grid && robot.value !== null, reach: reach(), at: floor.value, hasLabels: look.value.labels }),
    ({ palette, isShown, reach, at, hasLabels }) => {
      lines.visible = isShown;
      const cell = roundLength(reach / 2.5);
      const end = CELLS * cell;
      const positions = geometry.getAttribute("position");
      const shades = geometry.getAttribute("color");
      let k = 0;
      const vertex = (x: number, y: number, strong: boolean) => {
        const fade = Math.min(1, Math.hypot(x, y) / end) ** 1.3;
        const [r, g, b] = blend(strong ? palette.gridStrong : palette.grid, palette.background, fade);
        positions.setXYZ(k, x, y, at);
        shades.setXYZ(k++, r, g, b);
      };
      for (let i = -CELLS; i <= CELLS; i++) {
        for (let j = 0; j < CUTS; j++) {
          const [from, to] = [end * ((2 * j) / CUTS - 1), end * ((2 * (j + 1)) / CUTS - 1)];
          vertex(i * cell, from, i === 0);
          vertex(i * cell, to, i === 0);
          vertex(from, i * cell, i === 0);
          vertex(to, i * cell, i === 0);
        }
      }
      positions.needsUpdate = true;
      shades.needsUpdate = true;
      const corner: Point = [2 * cell, -2 * cell, at];
      stage.labels.set("floor", isShown && hasLabels ? [{ text: `▦ ${inLength(cell)}`, at: corner, colour: palette.quiet, size: 11, rank: -5 }] : []);
    },
  );

  // Another robot stands on another floor, one with bodies on theirs; while it moves the floor stays.
  let stands: unknown[] = [];
  stage.watch("ground", () => ({ model: robot.value, now: scene.value, trees: wholeTrees.value }), ({ model, now, trees }) => {
    if (!model || !now || (stands[0] === model && stands[1] === trees)) return;
    stands = [model, trees];
    const lowest = Math.min(...corners().map((point) => point[2]));
    floor.value = Number.isFinite(lowest) ? lowest : floorOf(now, model.reach);
  });
}
