// Other arms beside that of the page, to be compared with it: each has an engine of its own. One with joints of the same kinds moves with the
// same values; another stands as it begins.

import { computed, signal } from "@preact/signals";
import { Instance } from "../engine/instance.ts";
import type { Point, RobotModel, Scene } from "../engine/types.ts";
import { engine, note, q, robot } from "../state.ts";
import { add } from "../scene/geometry.ts";

/** More do not fit into a picture. */
const MOST = 3;

export interface Beside {
  model: RobotModel;
  engine: Instance;
}

export const others = signal<Beside[]>([]);

/** A robot of the catalogue, by its name. */
export function stand(name: string): void {
  if (others.peek().length === MOST) {
    note(`There is room for ${MOST} arms beside this one: take one away first.`);
    return;
  }
  const own = new Instance(engine().now.modules);
  const { file } = own.call("open", { text: name, kind: "robot" });
  const model = file && own.call("edit", { file }).robot;
  if (!model) throw new Error(`“${name}” cannot be drawn.`);
  others.value = [...others.peek(), { model, engine: own }];
}

export function takeAway(one: Beside): void {
  others.value = others.peek().filter((other) => other !== one);
}

const kindsOf = (model: RobotModel): string => model.joints.map(({ kind }) => kind).join("");

/** Whether an arm moves with the joints of the page's. */
export function movesAlong({ model }: Beside): boolean {
  return robot.value !== null && kindsOf(robot.value) === kindsOf(model);
}

export interface Standing {
  beside: Beside;
  /** As it stands beside the other: all of it displaced. */
  scene: Scene;
  at: Point;
}

/** Where they stand: one behind the other along y, as far apart as both reach. */
export const standing = computed<Standing[]>(() => {
  let y = 0;
  let before = robot.value?.reach ?? 0;
  return others.value.map((beside) => {
    y += 0.6 * (before + beside.model.reach);
    before = beside.model.reach;
    const by: Point = [0, y, 0];
    const scene = beside.engine.call("scene", { q: movesAlong(beside) ? q.value : beside.model.q });
    return { beside, scene: displaced(scene, by), at: by };
  });
});

function displaced(scene: Scene, by: Point): Scene {
  const { symbols, bars, gripper, ground } = scene;
  return {
    ...scene,
    symbols: symbols.map((symbol) => ({ ...symbol, centre: add(symbol.centre, by) })),
    bars: bars.map((bar) => ({ ...bar, from: add(bar.from, by), to: add(bar.to, by) })),
    gripper: { ...gripper, at: add(gripper.at, by) },
    ground: { ...ground, at: add(ground.at, by) },
    frames: scene.frames.map((frame) => frame.map((row, r) => (r < 3 ? [row[0], row[1], row[2], row[3] + by[r]] : row))),
  };
}
