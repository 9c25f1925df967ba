// A document about the present robot with one slip in it, to see what a check says.

import type { Block, Formula } from "../engine/types.ts";
import { engine, q, robot } from "../state.ts";

/** Entries of the forward model, one of them with a sign turned; nothing if the robot's model is not printed. */
export async function example(): Promise<string | null> {
  const { blocks } = await engine().formulas.call("formulas", { topic: "forward", q: q.peek() });
  const all = blocks.flatMap(formulasOf).filter((formula) => /^\s*\S+\s*=/.test(formula.text) && formula.text.length < 400);
  const position = all.filter((formula) => /^[tp]_?[\dxyz]*[4xyz]\b/i.test(formula.name ?? formula.text));
  const taken = (position.length > 0 ? position : all).slice(0, 3).map((formula) => formula.text);
  const at = taken.findIndex((text) => withSlip(text) !== null);
  if (at < 0) return null;
  const lines = taken.map((text, k) => (k === at ? withSlip(text)! : text));
  return [`# Position of the hand of ${robot.peek()?.robot ?? "the robot"}`, "", ...lines.flatMap((line) => [line, ""])].join("\n");
}

function formulasOf(block: Block): Formula[] {
  return block.kind === "equations" ? block.formulas : block.kind === "formula" ? [block.formula] : [];
}

/** The last sign between two terms turned. */
export function withSlip(text: string): string | null {
  const at = Math.max(...[" + ", " - ", " − "].map((sign) => text.lastIndexOf(sign)));
  if (at < text.indexOf("=")) return null;
  const turned = text[at + 1] === "+" ? "−" : "+";
  return text.slice(0, at + 1) + turned + text.slice(at + 2);
}
