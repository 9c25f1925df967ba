// The arm as it stands now, on its plate, with its shadow: what is highlighted glows; beside a row that is being
// explained, the arm steps back; near a singular configuration the pins of its joints turn orange.

import { signal } from "@preact/signals";
import type { Scene } from "../engine/types.ts";
import { answerNow, ghost, highlighted, q, robot, scene, selected } from "../state.ts";
import { build, type Paint, plate } from "./body.ts";
import { add } from "./geometry.ts";
import { inBodies } from "./looks.ts";
import type { Label } from "./labels.ts";
import { symbolsOnTable } from "./skeleton.ts";
import { Solids, type Tint } from "./solids.ts";
import type { Stage } from "./stage.ts";
import { blend, type Colour, colours, type Palette } from "./theme.ts";
import { inAngle, inLength } from "./units.ts";

/** The smallest singular value. */
export function smallest({ measures }: Scene): number {
  return measures.singular_values.at(-1) ?? 0;
}

/** Whether that is 0 but for rounding. */
export function isExact(now: Scene | null): boolean {
  return now !== null && smallest(now) < 1e-9;
}

/** Below this share of the best manipulability, or of the arm's length a radian, a configuration is called nearly singular. */
const NEAR = 0.02;

/** How near to a singular configuration an arm is: 0 where it is not, 1 where it is there. */
export function nearness(now: Scene, reach: number): number {
  const share = smallest(now) / Math.max(1e-9, Math.min(1, reach));
  return Math.min(1, Math.max(0, 1 - share / NEAR));
}

/** The height of the floor; the arm's base tells it. */
export const floor = signal(0);

/** Under the plate, or, where the arm hangs, stands sideways or reaches farther down, below it. */
export function floorOf({ ground, unit, bars }: Scene, reach: number): number {
  const plateBottom = ground.at[2] - 0.35 * unit;
  const lowest = Math.min(...bars.flatMap((bar) => [bar.from[2], bar.to[2]]));
  if (ground.up[2] > 0.7) return lowest > plateBottom - 0.5 * unit ? plateBottom : lowest - 3 * unit;
  return Math.min(lowest - 2 * unit, ground.at[2] - 0.6 * reach);
}

function paintOf(now: Scene, palette: Palette): Paint {
  const lit = highlighted.value;
  // The ghost that is pointed at may be where the arm is already.
  const isHere = ghost.value !== null && ghost.value === answerNow.value?.index;
  const near = nearness(now, robot.value?.reach ?? 1);
  const back = selected.value === null ? 0 : 0.62;
  const tint = (colour: Colour): Tint => [blend(colour, palette.background, back), isHere ? 0.4 : 0];
  const joints = { R: tint(palette.revolute), P: tint(palette.prismatic) };
  const [glow, pin, link, rod, palm] = [[palette.glow, 0.8] as const, tint(blend(palette.pin, palette.near, near)), tint(palette.link), tint(palette.rod), tint(palette.hand)];
  const isLit = (joint: number | null) => joint !== null && lit.has(joint);
  return {
    joint: (kind, joint) => (isLit(joint) ? glow : joints[kind]),
    pin: (joint) => (isLit(joint) ? glow : pin),
    bar: (_, isRod) => (isRod ? rod : link),
    palm,
  };
}

/** What carries a plate that stands above the floor. */
function pedestal(solids: Solids, { ground, unit }: Scene, floorAt: number, tint: Tint): void {
  const [x, y, z] = ground.at;
  const top = z - 0.35 * unit;
  if (ground.up[2] < 0.7 || top - floorAt < 0.2 * unit) return;
  solids.cylinder("rod", [x, y, floorAt], [x, y, top], 1.1 * unit, tint);
  solids.cylinder("joint", [x, y, floorAt], [x, y, floorAt + 0.3 * unit], 2.1 * unit, tint);
}

/** Plate and pedestal. */
function stand(solids: Solids, now: Scene, floorAt: number, colour: Colour): void {
  plate(solids, now.ground, now.unit, [colour, 0]);
  pedestal(solids, now, floorAt, [colour, 0]);
}

/** A joint that is pointed at says its name and value. */
function namesOf({ symbols }: Scene, palette: Palette): Label[] {
  const model = robot.peek();
  return symbols.flatMap(({ joint, centre, radius, half }): Label[] => {
    if (joint === null || !model || !highlighted.peek().has(joint)) return [];
    const { name, kind } = model.joints[joint];
    const value = q.peek()[joint];
    const text = `${name} = ${kind === "R" ? inAngle(value) : inLength(value)}`;
    return [{ text, at: add(centre, [0, 0, 1], Math.max(radius, half)), toward: [0, 0, 1], colour: palette.text, size: 13, plate: true, rank: 40 }];
  });
}

/** Inside of its bodies the arm is thin: its joints, where the table has them, and the skeleton between them. */
const THIN = 0.3;

function thin(now: Scene): Scene {
  const symbols = symbolsOnTable(now).map((symbol) => ({ ...symbol, radius: 1.5 * THIN * symbol.radius, half: 1.5 * THIN * symbol.half }));
  return { ...now, symbols, bars: [], unit: THIN * now.unit };
}

export function addArm(stage: Stage): void {
  const solids = new Solids(["matte", "shadow"], 2);
  stage.add(solids.object);
  stage.onEnd(() => solids.dispose());
  stage.watch(
    "arm",
    () => {
      const now = scene.value;
      const palette = colours.value;
      return now && { now, palette, paint: paintOf(now, palette), floorAt: floor.value, isBack: selected.value !== null, isInside: inBodies.value };
    },
    (value) => {
      solids.begin();
      if (value) {
        const { palette, paint, floorAt, isBack, isInside } = value;
        const now = isInside ? thin(value.now) : value.now;
        solids.shade(floorAt + 0.001, palette.shadow, isInside ? 0 : isBack ? 0.08 : 0.15);
        build(solids, now, now.unit, paint, true);
        // Bodies have a foot of their own.
        if (!isInside) stand(solids, now, floorAt, isBack ? blend(palette.base, palette.background, 0.62) : palette.base);
      }
      stage.labels.set("joints", value ? namesOf(value.now, value.palette) : []);
      solids.end();
    },
  );
}
