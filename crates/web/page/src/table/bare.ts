// Bare numbers in cells. What is typed without a unit is in the units that the page shows, and gets them; what a file has
// without a unit is in radians and metres, and is shown with them. So a cell says what it means whatever the page shows.

import type { Finding } from "../engine/types.ts";
import { file, robot } from "../state.ts";
import { measureOf } from "../panels/joints.tsx";
import type { Units } from "../units.ts";

export const SI: Units = { angles: "rad", lengths: "m" };

/** Of what a cell is: `joints.2.theta` of an angle, `joints.2.velocity` of an angle a second; nothing of a name. */
function measured(cell: string): { measure: "angle" | "length"; per: string } | null {
  const [part, index, letter, more] = cell.split(".");
  const ofJoint = (joint: number) => {
    const found = robot.value?.joints[joint];
    return found ? (measureOf(found) === "angle" ? "angle" : "length") : null;
  };
  let measure: "angle" | "length" | null = null;
  let per = "";
  if (part === "joints") {
    if (["theta", "alpha", "gamma"].includes(letter)) measure = "angle";
    else if (["d", "a", "r", "b"].includes(letter)) measure = "length";
    else if (["limits", "velocity", "acceleration"].includes(letter)) {
      measure = ofJoint(robot.value?.joints.findIndex(({ row }) => row === Number(index)) ?? -1);
      per = letter === "velocity" ? "/s" : letter === "acceleration" ? "/s^2" : "";
    }
  } else if (part === "base" || part === "tool") measure = index === "xyz" ? "length" : index === "rpy" ? "angle" : null;
  else if (part === "poses" && letter === "values") measure = ofJoint(Number(more));
  else if (part === "parameters" && letter === "value") {
    const name = file.value.parameters[Number(index)]?.name;
    measure = robot.value?.parameters.find((one) => one.name === name)?.measure ?? null;
  }
  return measure && { measure, per };
}

/** A sum as its terms, each with its sign; brackets are kept whole. */
function termsOf(text: string): { sign: string; term: string }[] {
  const terms: { sign: string; term: string }[] = [];
  let [depth, sign, term] = [0, "", ""];
  for (const letter of text) {
    if (letter === "(") depth += 1;
    if (letter === ")") depth -= 1;
    // A sign behind an operator, or in `2e-3`, belongs to the number.
    const isSum = /[-+−]/.test(letter) && depth === 0 && term.trim() !== "" && !/[*/^]\s*$|\d[eE]$/.test(term);
    if (!isSum) {
      term += letter;
      continue;
    }
    terms.push({ sign, term });
    [sign, term] = [letter, ""];
  }
  terms.push({ sign, term });
  return terms;
}

/** `45`, `-1/2`, `2e-3`: numbers and what joins them, and no name or unit. */
const NUMBERS = /^\s*[-+−]?\s*(?:[\d.]+(?:[eE][-+−]?\d+)?|[\s*/^()])+$/;

/** The text of a cell with units behind its bare numbers. */
export function withUnits(cell: string, text: string, units: Units): string {
  const of = measured(cell);
  if (!of) return text;
  const unit = (of.measure === "angle" ? units.angles : units.lengths) + of.per;
  // A comma is the decimal sign of half the world.
  const plain = /^\s*[-+−]?\d*,\d+\s*$/.test(text) ? text.replace(",", ".") : text;
  const terms = termsOf(plain).map(({ sign, term }) => {
    if (!NUMBERS.test(term) || !/[1-9]/.test(term)) return sign + term;
    const [, before, number] = /^(\s*)(.*?)\s*$/.exec(term) ?? ["", "", term];
    const isOne = /^[-+−]?\s*[\d.]+(?:[eE][-+−]?\d+)?$/.test(number);
    return `${sign}${before}${isOne ? number : `(${number})`} ${unit}${/\s$/.test(term) ? " " : ""}`;
  });
  return terms.join("").trimEnd();
}

/** Names that stand for units wherever they stand. */
const UNITS = new Set(["m", "mm", "cm", "in", "deg", "rad", "mrad", "degree", "degrees", "s", "kg"]);

/** The name that a finding says is not declared, where it could be a parameter. */
export function undeclared({ message, hint }: Finding): string | null {
  const [, name] = /^`([^`]+)` is not declared$/.exec(message) ?? [];
  return name !== undefined && hint?.includes("[parameters]") && !UNITS.has(name) ? name : null;
}
