// What the page knows, as signals. Panels and the scene read them and call the functions below; nothing else is shared.

import { batch, computed, effect, type Signal, signal } from "@preact/signals";
import { Cancelled, EngineError, type Engines } from "./engine/client.ts";
import type { Answer, Finding, Matrix, Path, RobotFile, RobotModel, Scene, Singularity, Topic, Workspace } from "./engine/types.ts";

let engines: Engines;

/** The engines; `start` has to be called first. */
export function engine(): Engines {
  return engines;
}

// The robot ---------------------------------------------------------------------------------------------------------

/** The table as it is being edited. Never changed in place: `change` puts another one there. */
export const file = signal<RobotFile>({ name: "", convention: "standard", parameters: [], joints: [], poses: [] });
/** What is to be said of the table, cell by cell. */
export const findings = signal<Finding[]>([]);
/** The last table without errors. */
export const robot = signal<RobotModel | null>(null);
/** Whether the table has errors, so that scene and formulas show the one before. */
export const stale = computed(() => findings.value.some((f) => f.severity === "error"));
/** Counts robots: what was derived for another revision is out of date. */
export const revision = signal(0);

/** What undoing goes back to. */
interface State {
  file: RobotFile;
  q: number[];
  target: Matrix | null;
  /** Of `undone`, in its order. */
  others: unknown[];
}

/** What belongs to other parts of the page and is undone with the rest. */
const undone: Signal<unknown>[] = [];

/** From now on undoing brings back what this signal had. */
export function undoes<T>(one: Signal<T>): Signal<T> {
  undone.push(one as Signal<unknown>);
  return one;
}

const past = signal<State[]>([]);
const future = signal<State[]>([]);
export const canUndo = computed(() => past.value.length > 0);
export const canRedo = computed(() => future.value.length > 0);
const MOST_UNDO = 200;

/** What was changed last, so that the letters of one word and the steps of one motion are undone together. */
let changing: string | undefined;
let changed = 0;
/** A motion that goes on after this, milliseconds, is another one. */
const PAUSE = 1500;

function here(): State {
  return { file: file.peek(), q: q.peek(), target: target.peek(), others: undone.map((one) => one.peek()) };
}

/** Before a change of what `undoes`, or one below; changes of the same thing (`of`) one after another are undone together. */
export function record(of?: string): void {
  if (file.peek().joints.length > 0 && (of === undefined || of !== changing)) past.value = [...past.peek(), here()].slice(-MOST_UNDO);
  changing = of;
  future.value = [];
}

/** Another table, by hand: it can be undone. Changes of the same thing (`of`) one after another are undone together. */
export function change(next: RobotFile, of?: string): void {
  record(of);
  put(next);
}

/** Another robot: joints go to its own first configuration. */
export function replace(next: RobotFile): void {
  record();
  put(next, "first");
}

/** What is there now is where the page begins: nothing before it can be gone back to. */
export function forget(): void {
  past.value = [];
  future.value = [];
}

export function undo(): void {
  const last = past.value.at(-1);
  if (!last) return;
  const now = here();
  past.value = past.value.slice(0, -1);
  future.value = [...future.value, now];
  back(last);
}

export function redo(): void {
  const next = future.value.at(-1);
  if (!next) return;
  const now = here();
  future.value = future.value.slice(0, -1);
  past.value = [...past.value, now];
  back(next);
}

function back(to: State): void {
  changing = undefined;
  if (to.file !== file.value) put(to.file, to);
  else {
    batch(() => {
      q.value = to.q;
      target.value = to.target;
    });
    solveSoon();
  }
  // Another robot has let them go.
  batch(() => undone.forEach((one, k) => (one.value = to.others[k])));
}

/** Before a motion of joints or hand: its steps are undone together. */
function moving(): void {
  const now = performance.now();
  if (now - changed > PAUSE) changing = undefined;
  changed = now;
  record("motion");
}

function put(next: RobotFile, at?: State | "first"): void {
  const answer = engines.now.call("edit", { file: next });
  batch(() => {
    file.value = next;
    findings.value = answer.findings;
    const model = answer.robot;
    if (!model) return;
    const kinds = (of: RobotModel | null) => of?.joints.map((joint) => joint.kind).join();
    const same = kinds(robot.value) === kinds(model);
    robot.value = model;
    revision.value += 1;
    if (typeof at === "object" && at.q.length === model.joints.length) {
      q.value = at.q;
      target.value = at.target;
    } else if (at === "first" || !same) {
      q.value = model.q;
      target.value = null;
    }
    ghost.value = null;
    highlighted.value = new Set();
    path.value = null;
    answerNow.value = null;
    selected.value = selected.value !== null && selected.value < model.rows ? selected.value : null;
  });
  if (!answer.robot) return;
  // What was being derived belongs to the robot before.
  for (const remote of [engines.solver, engines.formulas]) {
    remote.cancel();
    remote.edit({ file: next });
  }
  solveSoon();
}

// The configuration -------------------------------------------------------------------------------------------------

/** The joint variables, radians and metres. */
export const q = signal<number[]>([]);
/** The arm in this configuration. */
export const scene = computed<Scene | null>(() => {
  const model = robot.value;
  if (!model || q.value.length !== model.joints.length) return null;
  return engines.now.call("scene", { q: q.value });
});
/** The pose of the tool. */
export const pose = computed<Matrix | null>(() => scene.value?.frames.at(-1) ?? null);

/** Moves joints; a value beyond the limits is taken as it is, and shown as such. */
export function move(next: number[]): void {
  moving();
  q.value = next;
  target.value = null;
  solveSoon();
}

// The hand ----------------------------------------------------------------------------------------------------------

/** Where the hand is wanted; nothing where it follows from the joints. */
export const target = signal<Matrix | null>(null);
/** All inverse solutions of the target, or of the pose of the tool. */
export const answerNow = signal<Answer | null>(null);
/** Whether the solver has not answered yet (the first time for a robot it derives its formulas). */
export const solving = signal(false);
/** How long the last solution took in the solver, milliseconds. */
export const solvedIn = signal<number | null>(null);

let wanted = false;
/** When something was asked for last, and whether all solutions of this arm take long. */
let asked = 0;
let slow = false;
/** Longer than this, milliseconds, is too long for every step of a drag: one solution has to do until the hand rests. */
const SLOW = 25;
const REST = 200;
let resting: ReturnType<typeof setTimeout> | undefined;

/** The hand goes there: the arm follows with the solution nearest to where it is. */
export function reach(to: Matrix): void {
  moving();
  target.value = to;
  solveSoon();
}

/** Whether the arm was drawn once: its solutions come after that. */
let pictured = false;

/** The arm is on the screen. */
export function hasPicture(): void {
  if (pictured) return;
  pictured = true;
  if (robot.value) solveSoon();
}

/** Asks for all solutions; while one request is out only the newest is kept. */
function solveSoon(): void {
  if (!pictured) return;
  const now = performance.now();
  const isMoving = now - asked < REST;
  asked = now;
  clearTimeout(resting);
  if (solving.value) {
    wanted = true;
    return;
  }
  void solve(isMoving);
}

async function solve(isMoving: boolean): Promise<void> {
  solving.value = true;
  let quick = false;
  do {
    wanted = false;
    const now = { target: target.value, q: q.value, revision: revision.value };
    quick = slow && isMoving;
    try {
      const answer = await engines.solver.call("solve", {
        pose: now.target ?? undefined,
        q: now.target ? undefined : now.q,
        near: now.q,
        quick,
      });
      if (now.revision !== revision.value) continue;
      const took = engines.solver.took.solve ?? 0;
      // The first answer for a robot includes the derivation.
      if (!quick) slow = answerNow.peek() !== null && took > SLOW;
      batch(() => {
        if (!quick || answer.obstacle) answerNow.value = answer;
        solvedIn.value = took;
        // The arm follows the hand, not the other way round.
        if (now.target && target.value === now.target && answer.nearest) q.value = answer.nearest.q;
      });
    } catch (why) {
      if (!(why instanceof Cancelled)) said(why);
      else wanted = true;
    }
    isMoving = wanted;
  } while (wanted);
  solving.value = false;
  if (quick) resting = setTimeout(() => solving.value || void solve(false), REST);
}

// What is looked at -------------------------------------------------------------------------------------------------

/** The row of the table (from 0) whose four parameters are drawn. */
export const selected = signal<number | null>(null);
/** Joints (from 0) that something under the pointer or the focus is about: a symbol, a slider, a part of the scene. */
export const highlighted = signal<ReadonlySet<number>>(new Set());

export interface Look {
  frames: boolean;
  labels: boolean;
  ghosts: boolean;
  workspace: "none" | "section" | "cloud";
  singular: boolean;
  ellipsoid: boolean;
  path: boolean;
  grid: boolean;
  perspective: boolean;
  theme: "system" | "light" | "dark";
  /** How angles and lengths are shown and typed. */
  angles: "deg" | "rad";
  lengths: "mm" | "m";
}

export const look = signal<Look>({
  frames: true,
  labels: true,
  ghosts: false,
  workspace: "none",
  singular: false,
  ellipsoid: false,
  path: true,
  grid: true,
  perspective: true,
  theme: "system",
  angles: "deg",
  lengths: "mm",
});

export function show(part: Partial<Look>): void {
  look.value = { ...look.value, ...part };
}

/** A ghost under the pointer, by its index in the answer's solutions. */
export const ghost = signal<number | null>(null);
/** The panel that is open. */
export type Panel = "table" | "joints" | "hand" | "formulas" | "path" | "check" | "share";
export const panel = signal<Panel>("joints");
export const topic = signal<Topic>("forward");
export const workspace = signal<Workspace | null>(null);
export const singular = signal<Singularity[] | null>(null);

// The path ----------------------------------------------------------------------------------------------------------

export const path = signal<Path | null>(null);
/** Seconds from its start. */
export const time = signal(0);
export const playing = signal(false);
/** Counts motions that were opened: they are to be seen whole. */
export const motions = signal(0);

// What went wrong ---------------------------------------------------------------------------------------------------

/** Sentences for the status line, spoken politely. */
export const message = signal<{ words: string; hint?: string; severity: "error" | "note" } | null>(null);

/** Shows a failure to whoever uses the page; a cancelled request is none. */
export function said(why: unknown): void {
  if (why instanceof Cancelled) return;
  const hint = why instanceof EngineError ? why.hint : undefined;
  message.value = { words: why instanceof Error ? why.message : String(why), hint, severity: "error" };
}

/** A note in the status line. */
export function note(words: string): void {
  message.value = { words, severity: "note" };
}

/** Begins with engines; `replace` then brings the first robot. */
export function start(with_: Engines): void {
  engines = with_;
}

export { batch, computed, effect, signal };
