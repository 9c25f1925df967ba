// Numbers as they stand in the scene: short, in the units that the page is set to.

import { look } from "../state.ts";
import { format, type Measure, unitOf } from "../units.ts";

function written(value: number, measure: Measure, places: number): string {
  const text = format(value, measure, look.value, places);
  const short = text.includes(".") ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
  const unit = unitOf(measure, look.value);
  return short + (unit === "°" ? unit : ` ${unit}`);
}

export function inLength(metres: number): string {
  return written(metres, "length", look.value.lengths === "mm" ? 1 : 4);
}

export function inAngle(radians: number): string {
  return written(radians, "angle", look.value.angles === "deg" ? 1 : 3);
}
