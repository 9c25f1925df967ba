// An arm from its symbols and bars: cylinders and boxes for joints, rods for links, a hand of two fingers. The arm itself
// and its ghosts are built by the same few lines.

import type { Ghost, Joint, Point, Scene } from "../engine/types.ts";
import { add, cross, dot, perpendicular, type Ray, rayToSegment, scale, sub, unit } from "./geometry.ts";
import type { Solids, Tint } from "./solids.ts";
import type { Colour } from "./theme.ts";

export interface Paint {
  joint: (kind: Joint["kind"], joint: number | null) => Tint;
  pin: (joint: number | null) => Tint;
  bar: (link: number, rod: boolean) => Tint;
  palm: Tint;
}

/** One colour for all of it, as for a ghost. */
export function plain(colour: Colour, density: number): Paint {
  const tint: Tint = [colour, density];
  const same = () => tint;
  return { joint: same, pin: same, bar: same, palm: tint };
}

/** The radius of a link's rods, thinner towards the hand. */
function thickness(unitLength: number, link: number): number {
  return unitLength * (0.46 - 0.14 * Math.min(1, link / 6));
}

export function build(solids: Solids, arm: Ghost, unitLength: number, paint: Paint, detail: boolean): void {
  const links = arm.symbols.length;
  for (const { joint, kind, centre, axis, radius, half } of arm.symbols) {
    const tint = paint.joint(kind, joint);
    if (kind === "R") {
      solids.cylinder("joint", add(centre, axis, -half), add(centre, axis, half), radius, tint);
      // A pin shows about which axis it turns.
      if (detail) {
        const out = half + 0.1 * radius;
        solids.cylinder("rod", add(centre, axis, -out), add(centre, axis, out), 0.5 * radius, paint.pin(joint));
      }
    } else {
      const x = perpendicular(axis);
      const wide = 0.82 * radius;
      solids.box(centre, scale(x, wide), scale(cross(axis, x), wide), scale(axis, half), tint);
    }
  }
  arm.bars.forEach((bar, k) => {
    const radius = thickness(unitLength, bar.link) * (bar.rod ? 0.62 : 1);
    solids.cylinder("rod", bar.from, bar.to, radius, paint.bar(bar.link, bar.rod));
    const next = arm.bars[k + 1];
    if (next && next.link === bar.link) solids.ball(bar.to, radius * 1.001, paint.bar(bar.link, false));
  });
  hand(solids, arm.gripper, unitLength, paint.palm, paint.bar(links, false));
}

function hand(solids: Solids, { at, along, across }: Scene["gripper"], u: number, palm: Tint, finger: Tint): void {
  const flat = cross(along, across);
  const block = (d: number, s: number, half: [number, number, number], tint: Tint) => {
    const centre = add(add(at, along, d * u), across, s * u);
    solids.box(centre, scale(along, half[0] * u), scale(across, half[1] * u), scale(flat, half[2] * u), tint);
  };
  block(0.17, 0, [0.17, 0.8, 0.32], palm);
  block(0.9, 0.62, [0.56, 0.16, 0.26], finger);
  block(0.9, -0.62, [0.56, 0.16, 0.26], finger);
}

/** What a line of sight meets first of an arm. */
export interface Met {
  joint: number | null;
  link: number | null;
  /** The index of the symbol, where it is one. */
  symbol: number | null;
  along: number;
}

/** `slack`: how far beside a part still counts, metres: fingers are thick. */
export function meet(arm: Ghost, unitLength: number, ray: Ray, slack: number): Met | null {
  let best: Met | null = null;
  const consider = (from: Point, to: Point, radius: number, what: Omit<Met, "along">) => {
    const { distance, along } = rayToSegment(ray, from, to);
    if (distance > radius + slack) return;
    // What is hit squarely comes before what is only near.
    const depth = along - radius + 4 * Math.max(0, distance - radius);
    if (!best || depth < best.along) best = { ...what, along: depth };
  };
  arm.symbols.forEach(({ joint, centre, axis, radius, half }, symbol) => {
    const inner = Math.max(0, half - 0.5 * radius);
    consider(add(centre, axis, -inner), add(centre, axis, inner), radius, { joint, link: null, symbol });
  });
  for (const bar of arm.bars) {
    const radius = thickness(unitLength, bar.link);
    consider(bar.from, bar.to, radius, { joint: null, link: bar.link, symbol: null });
  }
  const { at, along } = arm.gripper;
  consider(at, add(at, along, 1.4 * unitLength), 0.7 * unitLength, { joint: null, link: arm.symbols.length, symbol: null });
  return best;
}

/** A ball that holds the arm. */
export function bounds(arm: Ghost, extra: Point[]): { centre: Point; radius: number } {
  const points = [...extra, arm.gripper.at, add(arm.gripper.at, arm.gripper.along, 0.05)];
  for (const bar of arm.bars) points.push(bar.from, bar.to);
  for (const { centre, axis, half } of arm.symbols) points.push(add(centre, axis, half), add(centre, axis, -half));
  const low: Point = [...points[0]];
  const high: Point = [...points[0]];
  for (const p of points) {
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  }
  const centre = scale(add(low, high), 0.5);
  const radius = Math.max(...points.map((p) => Math.sqrt(dot(sub(p, centre), sub(p, centre)))));
  return { centre, radius };
}

/** A disc under the first joint. */
export function plate(solids: Solids, ground: Scene["ground"], unitLength: number, tint: Tint): void {
  const up = unit(ground.up);
  solids.cylinder("joint", add(ground.at, up, -0.35 * unitLength), ground.at, 1.9 * unitLength, tint);
}
