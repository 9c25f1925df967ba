// The other ways to hold the hand where it is: translucent arms, the one that is pointed at denser. Members of a family
// where the arm can move with its hand still; the nearest configuration where the hand cannot come; singular ones.

import { signal } from "@preact/signals";
import type { Answer, Ghost, Scene, Singularity } from "../engine/types.ts";
import { answerNow, engine, ghost, look, note, playing, q, revision, said, scene, selected, show, singular, target } from "../state.ts";
import { build, plain } from "./body.ts";
import { mixed } from "./geometry.ts";
import { dragging } from "./gizmo.ts";
import type { Label } from "./labels.ts";
import { measures } from "./measure.ts";
import { Solids } from "./solids.ts";
import type { Stage } from "./stage.ts";
import { type Colour, colours, type Palette } from "./theme.ts";
import { wait } from "./waiting.ts";

/** More than so many are a cloud that nobody reads. */
const MOST = 16;
/** Members of the family in which the arm is; each is asked of the engine. */
const SWEEP = 9;

export interface Shown {
  ghost: Ghost;
  q: number[];
  kind: "solution" | "family" | "obstacle" | "singular";
  /** In the answer's solutions, or in the list of singular configurations. */
  index: number;
  colour: (palette: Palette) => Colour;
  density: number;
  label?: string;
}

/** What is drawn now; the pointer looks here. */
export const shown = signal<Shown[]>([]);
/** The singular configuration under the pointer. */
export const singularAt = signal<number | null>(null);

function solutions(answer: Answer, pointed: number | null): Shown[] {
  const made: Shown[] = [];
  answer.solutions.forEach((solution, index) => {
    // Where the arm itself is, no ghost.
    if (index === answer.index || made.length >= MOST) return;
    const isPointed = index === pointed;
    made.push({
      ghost: answer.scenes[index],
      q: solution.q,
      kind: "solution",
      index,
      colour: (p) => (isPointed ? p.ghostStrong : solution.within_limits ? p.ghost : p.beyond),
      density: isPointed ? 0.62 : solution.within_limits ? 0.3 : 0.17,
      label: isPointed ? solution.branch : undefined,
    });
  });
  return made;
}

/** How far a family's curve stays from where the arm is, in the joint that is farthest. */
function away(curve: number[][], here: number[]): number {
  return Math.min(...curve.map((member) => Math.max(...member.map((x, k) => Math.abs(Math.sin((x - here[k]) / 2))))));
}

/** A sweep along the family in which the arm is, and one member of each other: the same for the same answer. */
function members(answer: Answer, here: number[]): Shown[] {
  const curves = answer.families.map(({ curve = [] }, k) => ({ curve, closed: answer.motions[k].closed })).filter(({ curve }) => curve.length > 1);
  const distances = curves.map(({ curve }) => away(curve, here));
  const nearest = distances.indexOf(Math.min(...distances));
  const made: Shown[] = [];
  curves.forEach(({ curve, closed }, index) => {
    const count = index === nearest ? SWEEP : 1;
    for (let k = 0; k < count && made.length < MOST; k++) {
      const at = (k * (curve.length - 1)) / (closed ? count : Math.max(1, count - 1));
      const before = Math.min(curve.length - 2, Math.floor(at));
      const member = mixed(curve[before], curve[before + 1], at - before);
      made.push({ ghost: engine().now.call("ghost", { q: member }), q: member, kind: "family", index: k, colour: (p) => p.ghost, density: 0.17 });
    }
  });
  return made;
}

function obstacle(answer: Answer): Shown[] {
  if (!answer.obstacle || !answer.stop || !target.value) return [];
  return [{ ghost: answer.stop.scene, q: answer.obstacle.nearest, kind: "obstacle", index: 0, colour: (p) => p.obstacle, density: 0.34, label: "nearest" }];
}

function singulars(list: Singularity[], pointed: number | null): Shown[] {
  return list.flatMap((one, index): Shown[] => {
    if (!one.scene || !one.q) return [];
    const isPointed = index === pointed;
    return [{
      ghost: one.scene,
      q: one.q,
      kind: "singular",
      index,
      colour: (p) => p.singular,
      density: isPointed ? 0.65 : 0.28,
      label: one.factor.text,
    }];
  });
}

/** Members of families are asked of the engine once an answer. */
let familiesOf: { answer: Answer; made: Shown[] } | null = null;

function wanted(): Shown[] {
  const list: Shown[] = [];
  const answer = answerNow.value;
  if (look.value.singular && singular.value) list.push(...singulars(singular.value, singularAt.value));
  else if (look.value.ghosts && answer && !playing.value && selected.value === null) {
    if (familiesOf?.answer !== answer && !dragging.value) familiesOf = { answer, made: members(answer, q.peek()) };
    list.push(...obstacle(answer), ...solutions(answer, ghost.value), ...(familiesOf?.answer === answer ? familiesOf.made : []));
  } else if (answer && !playing.value) {
    // What is pointed at in a list is shown even so.
    list.push(...solutions(answer, ghost.value).filter((one) => one.index === ghost.value));
  }
  return list;
}

function labelsOf(list: Shown[], palette: Palette): Label[] {
  return list.flatMap((one): Label[] => {
    if (!one.label) return [];
    const at = one.kind === "solution" ? middleOf(one.ghost) : one.ghost.gripper.at;
    const rank = one.kind === "singular" ? 3 : 15;
    return [{ text: one.label, at, colour: one.colour(palette), size: 12, plate: true, rank }];
  });
}

/** Ghosts share their hands: words stand at the middle of the arm. */
function middleOf({ symbols, gripper }: Ghost): Scene["gripper"]["at"] {
  return symbols[Math.floor(symbols.length / 2)]?.centre ?? gripper.at;
}

/** What is not there yet: ghosts share parts with the arm and with one another, and glass upon glass would be dense. */
function onlyNew(body: Ghost, there: Set<string>): Ghost {
  const isNew = (name: string): boolean => !there.has(name) && there.add(name) !== undefined;
  const [symbols, bars] = partsOf(body);
  return { ...body, symbols: body.symbols.filter((_, k) => isNew(symbols[k])), bars: body.bars.filter((_, k) => isNew(bars[k])) };
}

/** Parts by name: two with the same name are drawn alike. */
function partsOf({ symbols, bars }: Ghost): [symbols: string[], bars: string[]] {
  const place = (p: readonly number[]) => p.map((x) => Math.round(x * 1e4)).join();
  // A joint looks the same along its axis and against it.
  const line = (p: readonly number[]) => place(p.map((x) => Math.abs(x)));
  return [
    symbols.map(({ centre, axis }) => `${place(centre)};${line(axis)}`),
    bars.map(({ from, to, rod }) => `${place(from)};${place(to)};${rod}`),
  ];
}

export function addGhosts(stage: Stage): void {
  const solids = new Solids(["ghost"], 5, undefined, 128);
  const strong = new Solids(["ghost"], 7);
  for (const one of [solids, strong]) {
    stage.add(one.object);
    stage.onEnd(() => one.dispose());
  }
  stage.watch(
    "ghosts",
    () => {
      const list = wanted();
      shown.value = list;
      return { list, palette: colours.value, arm: scene.value };
    },
    ({ list, palette, arm }) => {
      solids.begin();
      strong.begin();
      const size = arm?.unit ?? 0.05;
      const there = new Set(arm ? partsOf(arm).flat() : []);
      for (const { ghost: body, colour, density } of list) {
        const isStrong = density > 0.5;
        const parts = isStrong ? body : onlyNew(body, there);
        build(isStrong ? strong : solids, parts, size, plain(colour(palette), density), false);
      }
      solids.end();
      strong.end();
      measures.ghosts = list.length;
      stage.labels.set("ghosts", labelsOf(list, palette));
    },
  );

  // Another robot has other singular configurations.
  let asked = -1;
  stage.watch(
    "singular",
    () => ({ isWanted: look.value.singular, now: revision.value }),
    ({ isWanted, now }) => {
      if (asked !== now && asked >= 0) singular.value = null;
      if (!isWanted || asked === now) return;
      asked = now;
      // What was cancelled is wanted no longer, and can be asked for again.
      void askSingular(now).then((isThere) => {
        if (isThere || revision.peek() !== now) return;
        asked = -1;
        show({ singular: false });
      });
    },
  );
}

async function askSingular(now: number): Promise<boolean> {
  const { begin, finish } = wait("singular configurations", () => engine().formulas.cancel());
  try {
    begin();
    const { singularities: list, complete } = await engine().formulas.call("singular", {});
    if (revision.peek() !== now) return true;
    singular.value = list;
    if (list.length === 0) note(complete ? "This arm has no singular configuration that a formula tells." : "There may be singular configurations that no formula tells.");
    return true;
  } catch (why) {
    said(why);
    return false;
  } finally {
    finish();
  }
}
