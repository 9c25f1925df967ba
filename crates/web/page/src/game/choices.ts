// What a question about a frame offers: right answers, and those that are mistaken for them.

import type { Point } from "../engine/types.ts";
import { add, between, cross, norm, scale, unit } from "../scene/geometry.ts";
import { type Arm, axisIndex, judgeOrigin, judgeX, judgeZ, type Placed, someOrigin, someX, type Verdict } from "./rules.ts";

export interface Choice {
  value: Point;
  verdict: Verdict;
}

const MOST = 6;

/** The same each time, and no right answer always first. */
function mixed(choices: Choice[], seed: number): Choice[] {
  return choices.map((choice, k) => ({ choice, key: Math.sin(12.9898 * (k + 1) + 78.233 * (seed + 1)) * 43758.5453 % 1 })).sort((a, b) => a.key - b.key).map(({ choice }) => choice);
}

/** Those that differ, each judged: as many as there is room for, right ones among them. */
function offered(values: Point[], isSame: (a: Point, b: Point) => boolean, judge: (value: Point) => Verdict, seed: number): Choice[] {
  const all: Choice[] = [];
  for (const value of values) if (all.every((one) => !isSame(one.value, value))) all.push({ value, verdict: judge(value) });
  const right = all.filter(({ verdict }) => verdict.right).slice(0, 2);
  const wrong = all.filter(({ verdict }) => !verdict.right).slice(0, MOST - right.length);
  return mixed([...right, ...wrong], seed);
}

const sameDirection = (a: Point, b: Point): boolean => between(a, b) < 1e-3;
const both = (v: Point): Point[] => [v, scale(v, -1)];

export function origins(arm: Arm, frame: number, before: Placed): Choice[] {
  const judge = (p: Point) => judgeOrigin(arm, frame, before, p);
  const index = axisIndex(arm, frame);
  const own = arm.frames.map(({ origin }) => origin);
  const near = [someOrigin(arm, frame, before), own[frame], own[frame - 1], own[frame + 1] ?? own[frame], before.origin];
  // Along the axis, away from the place where it is right.
  const step = Math.max(...own.map((p) => between(p, own[0]))) / 4 || 0.1;
  const along = index === null ? [] : [-1, 1].map((sign) => add(own[frame], arm.axes[index].along, sign * step));
  const aside = index === null ? [] : [add(own[frame], arm.frames[frame].x, step)];
  return offered([...near, ...along, ...aside, ...own], (a, b) => between(a, b) < 20 * arm.least, judge, frame);
}

export function zs(arm: Arm, frame: number, before: Placed, origin: Point): Choice[] {
  const judge = (z: Point) => judgeZ(arm, frame, before, origin, z);
  const index = axisIndex(arm, frame);
  const axes = arm.axes.map(({ along }) => along);
  const own = arm.frames[frame];
  const right = index === null ? [own.z, before.z] : [axes[index]];
  const others = [...(index === null ? [] : [axes[index - 1] ?? own.x, axes[index + 1] ?? own.x]), own.x, cross(own.z, own.x), ...axes];
  return offered([...right, ...others].flatMap(both), sameDirection, judge, frame + 40);
}

export function xs(arm: Arm, frame: number, before: Placed, placed: Pick<Placed, "origin" | "z">): Choice[] {
  const judge = (x: Point) => judgeX(arm, frame, before, placed, x);
  const right = someX(arm, frame, before, placed);
  const side = cross(placed.z, right);
  const slanted = unit(add(right, side));
  const others = [side, placed.z, before.x, slanted].filter((v) => norm(v) > 0.5);
  return offered([right, ...others].flatMap(both), sameDirection, judge, frame + 80);
}
