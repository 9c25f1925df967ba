// The arm in words, for whoever does not see the picture.

import type { RobotModel, Scene } from "../engine/types.ts";
import { originOf } from "./geometry.ts";
import { inAngle, inLength } from "./units.ts";

export function describe(model: RobotModel | null, now: Scene | null, q: number[], others: number): string {
  if (!model || !now) return "Scene without a robot.";
  const joints = model.joints.map((joint, k) => `${joint.name} ${joint.kind === "R" ? inAngle(q[k]) : inLength(q[k])}`);
  const hand = now.frames.at(-1);
  const [x, y, z] = hand ? originOf(hand) : [0, 0, 0];
  const count = model.joints.length === 1 ? "one joint" : `${model.joints.length} joints`;
  const also = others > 0 ? ` ${others} other ${others === 1 ? "configuration" : "configurations"} with the same hand.` : "";
  return `${model.robot}, ${count}: ${joints.join(", ")}. Hand at x ${inLength(x)}, y ${inLength(y)}, z ${inLength(z)}.${also}`;
}
