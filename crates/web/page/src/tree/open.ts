// A robot out of a description of a tree (URDF, xacro, MJCF): which file, which chain, and what is known of the tree afterwards.

import type { Convention, Output, RobotFile } from "../engine/types.ts";
import { batch, computed, engine, file, note, replace, said, signal } from "../state.ts";
import { capital } from "../widgets/words.tsx";
import { prepareReaders } from "./meshes.ts";
import { descriptions, includesOthers, type Lying, MESH, root, texts, unpacked } from "./files.ts";

/** Files in which a description stands, and what lies around it. */
export interface Source {
  files: Lying[];
  texts: [string, string][];
  packages: [string, string][];
}

/** What a person chooses. */
export interface Choice {
  /** The path of the description. */
  main: string;
  base?: string;
  tip?: string;
  convention?: Convention;
  /** `name:=value` between blanks. */
  given: string;
  asWritten: boolean;
}

/** A description that was read. */
export interface Opened {
  source: Source;
  choice: Choice;
  answer: Output<"tree">;
}

/** A description in which something has to be chosen or put right; the dialog shows it. */
export const asked = signal<Opened | null>(null);

/** Trees that chains were taken of, by the table of the chain: undoing brings a tree back with its table. */
const trees = signal<ReadonlyMap<string, Opened>>(new Map());
const MOST_TREES = 12;

const LETTERS = ["theta", "d", "a", "alpha", "r", "gamma", "b"] as const;

/** What of a table decides where the arm is. */
function keyOf({ convention, parameters, joints, base, tool }: RobotFile): string {
  return JSON.stringify([convention, parameters, joints.map((row) => LETTERS.map((letter) => row[letter] ?? "")), base, tool]);
}

/** The tree that the table is a chain of; nothing where the table was changed. */
export const tree = computed<Opened | null>(() => trees.value.get(keyOf(file.value)) ?? null);

/** The same chain in another table. */
export function carry(to: RobotFile): void {
  const opened = tree.peek();
  if (opened) keep(to, opened);
}

function keep(table: RobotFile, opened: Opened): void {
  const all = [...trees.peek()].filter(([key]) => key !== keyOf(table));
  trees.value = new Map([...all, [keyOf(table), opened] as const].slice(-MOST_TREES));
}

/** Whether a text is a description of a tree: its root says so. */
export function isTree(text: string): boolean {
  return ["robot", "mujoco"].includes(root(text) ?? "");
}

/** A description alone. */
export function alone(name: string, text: string): Source {
  const bytes = new TextEncoder().encode(text);
  return { files: [{ path: name, size: bytes.length, read: async () => bytes }], texts: [[name, text]], packages: [] };
}

/** Files, a folder or a zip with a description; whether there is one to be asked about. */
export async function openTree(dropped: Lying[]): Promise<boolean> {
  engine().files.prepare("tree");
  const files = await unpacked(dropped);
  const source: Source = { files, texts: await texts(files), packages: [] };
  const found = descriptions(source.texts);
  if (found.length === 0) throw new Error("There is no description of a robot in it: no file ends in .urdf or .xacro, and none is a model of MuJoCo's.");
  const parts = new Set(source.texts.filter(includesOthers).map(([path]) => path));
  const whole = found.filter((path) => !parts.has(path));
  return read(source, { main: found[0], given: "", asWritten: false }, isClear(whole.length > 0 ? whole : found));
}

/** A description as `denavit view` serves it (`Bundle` of `crates/wire`). */
export interface Bundle {
  arguments: [string, string][];
  as_written: boolean;
  base: string | null;
  convention: Convention | null;
  /** Paths of meshes, the addresses that they are served at, their sizes in bytes. */
  meshes: [string, string, number][];
  name: string;
  packages: [string, string][];
  texts: [string, string][];
  tip: string | null;
}

/** The description that the page was served with. */
export function openServed(bundle: Bundle): Promise<boolean> {
  const fetched = async (address: string) => {
    const answer = await fetch(new URL(address, document.baseURI));
    if (!answer.ok) throw new Error(`it could not be fetched (${answer.status})`);
    return new Uint8Array(await answer.arrayBuffer());
  };
  const files = bundle.meshes.map(([path, address, size]): Lying => ({ path, size, read: () => fetched(address) }));
  const given = bundle.arguments.map(([name, value]) => `${name}:=${value}`).join(" ");
  return read(
    { files, texts: bundle.texts, packages: bundle.packages },
    { main: bundle.name, base: bundle.base ?? undefined, tip: bundle.tip ?? undefined, convention: bundle.convention ?? undefined, given, asWritten: bundle.as_written },
  );
}

/** Whether it is clear which of several descriptions is meant: one is the only one that is whole. */
function isClear(found: string[]): boolean {
  const plain = found.filter((path) => /\.(urdf|xml|mjcf)$/i.test(path));
  const whole = found.filter((path) => /\.urdf\.xacro$/i.test(path));
  return found.length === 1 || plain.length === 1 || (plain.length === 0 && whole.length === 1);
}

let runs = 0;

function ask(opened: Opened): void {
  asked.value = opened;
}

/** Reads a description and takes its chain as the robot; else it is left to be asked about. Whether the robot was taken. */
export async function read(source: Source, choice: Choice, isCertain = true, otherwise = ask): Promise<boolean> {
  const run = ++runs;
  const text = source.texts.find(([path]) => path === choice.main)?.[1];
  if (text === undefined) throw new Error(`${choice.main} is larger than 16 MiB: it is not a robot description.`);
  const asking = engine().files.call("tree", {
    name: choice.main,
    text,
    around: { texts: source.texts, packages: source.packages, others: source.files.map(({ path }) => path).filter((path) => MESH.test(path)) },
    arguments: argumentsOf(choice.given),
    base: choice.base,
    tip: choice.tip,
    convention: choice.convention,
    as_written: choice.asWritten,
  });
  prepareReaders(source.files);
  const answer = await asking;
  if (run !== runs) return false;
  const opened: Opened = { source, choice, answer };
  if (!answer.file || !isCertain) {
    otherwise(opened);
    return false;
  }
  take(opened);
  return true;
}

function argumentsOf(given: string): [string, string][] {
  const pairs = given.split(/\s+/).filter(Boolean).map((word) => word.split(/:?=(.*)/s));
  return pairs.map(([name, value]) => [name, value ?? ""]);
}

/** The chain as the robot in hand. */
function take(opened: Opened): void {
  const { answer, choice } = opened;
  const table = answer.file;
  if (!table) return;
  batch(() => {
    keep(table, opened);
    asked.value = null;
    replace(table);
  });
  note(`Opened ${nameOf(choice.main)}: ${answer.tree?.words.replaceAll("`", "") ?? ""}.`);
}

/** The last word of a path. */
export function nameOf(path: string): string {
  return path.split("/").at(-1) ?? path;
}

/** Another chain of the tree in hand. */
export async function choose(part: Partial<Choice>): Promise<void> {
  const opened = tree.peek();
  if (!opened) return;
  const refuse = ({ answer }: Opened) => {
    const worst = answer.findings.find((finding) => finding.severity === "error");
    said(new Error(capital(worst?.message ?? "there is no such chain")));
  };
  try {
    await read(opened.source, { ...opened.choice, ...part }, true, refuse);
  } catch (why) {
    said(why);
  }
}
