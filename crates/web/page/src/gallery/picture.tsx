// An arm as a small drawing: links as lines, joints as short thick ones, what is behind first. No WebGL: there may be a hundred.

import type { Point, Scene } from "../engine/types.ts";
import { add, dot, perpendicular, scale } from "../scene/geometry.ts";
import { directions } from "../scene/orbit.ts";
import { firstLook } from "../scene/first-look.ts";

interface Stroke {
  from: Point;
  to: Point;
  width: number;
  kind: "link" | "R" | "P" | "hand" | "base";
}

function strokesOf({ bars, symbols, gripper, ground, unit }: Scene): Stroke[] {
  const side = perpendicular(ground.up);
  return [
    { from: add(ground.at, side, -1.7 * unit), to: add(ground.at, side, 1.7 * unit), width: 0.5 * unit, kind: "base" },
    ...bars.map(({ from, to, rod }): Stroke => ({ from, to, width: (rod ? 0.5 : 0.8) * unit, kind: "link" })),
    ...symbols.map(({ centre, axis, half, radius, kind }): Stroke => ({ from: add(centre, axis, -half), to: add(centre, axis, half), width: 1.8 * radius, kind })),
    { from: gripper.at, to: add(gripper.at, gripper.along, 1.4 * unit), width: 0.9 * unit, kind: "hand" },
  ];
}

export function ArmPicture({ scene }: { scene: Scene }) {
  const { azimuth, elevation } = firstLook(scene);
  const { right, up, back } = directions(azimuth, elevation);
  const flat = (p: Point): [number, number] => [dot(p, right), -dot(p, up)];
  const strokes = strokesOf(scene);
  const depth = ({ from, to }: Stroke) => dot(scale(add(from, to), 0.5), back);
  strokes.sort((a, b) => depth(a) - depth(b));
  const points = strokes.flatMap(({ from, to }) => [flat(from), flat(to)]);
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const margin = 1.6 * scene.unit;
  const [left, top] = [Math.min(...xs) - margin, Math.min(...ys) - margin];
  const [width, height] = [Math.max(...xs) + margin - left, Math.max(...ys) + margin - top];
  return (
    <svg class="arm-picture" viewBox={[left, top, width, height].map((x) => x.toFixed(5)).join(" ")} aria-hidden="true">
      {strokes.map(({ from, to, width: wide, kind }, k) => {
        const [[x1, y1], [x2, y2]] = [flat(from), flat(to)];
        // Seen from its end a joint is a disc, and a line without length is none.
        const isEnd = Math.hypot(x2 - x1, y2 - y1) < 0.1 * wide;
        if (isEnd) return <circle key={k} class={`part-${kind}`} cx={x1} cy={y1} r={wide / 2} />;
        return <line key={k} class={`part-${kind}`} x1={x1} y1={y1} x2={x2} y2={y2} stroke-width={wide} />;
      })}
    </svg>
  );
}
