// The state of the page as an address's fragment: `#1.` and JSON, deflated, in base64url. What comes from an address is
// somebody else's text: it is read field by field, and what does not fit is refused.

import type { Convention, Frame, Matrix, RobotFile, Row, Waypoint } from "./engine/types.ts";
import type { Look, Panel } from "./state.ts";

const VERSION = "1";
const MOST_FRAGMENT = 200_000;
const MOST_TEXT = 1_000_000;
const MOST_WORDS = 4000;
const MOST_ROWS = 64;

export interface Shared {
  file: RobotFile;
  q?: number[];
  target?: Matrix;
  look?: Partial<Look>;
  panel?: Panel;
  selected?: number;
  camera?: number[];
  points?: Waypoint[];
  /** Where the path starts, if not at the present joints. */
  start?: number[];
}

/** The fragment, with its `#`. */
export async function encode(shared: Shared): Promise<string> {
  // Twelve digits are more than anybody sees and half the length.
  const text = JSON.stringify(shared, (_, value: unknown) => (typeof value === "number" ? Number(value.toPrecision(12)) : value));
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return `#${VERSION}.${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/** Reads a fragment; throws a sentence for whoever opened the address. */
export async function decode(fragment: string): Promise<Shared> {
  const [, version, data] = /^#([^.]{1,8})\.(.*)$/s.exec(fragment) ?? [];
  if (data === undefined) throw new Error("The address carries no robot after its #.");
  if (version !== VERSION) throw new Error(`The address was made by another version of this page (${version}).`);
  if (fragment.length > MOST_FRAGMENT || !/^[\w-]+$/.test(data)) throw new Error("The address is damaged: what follows its # cannot be read.");
  let value: unknown;
  try {
    const bytes = Uint8Array.from(atob(data.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    value = JSON.parse(await inflate(bytes));
  } catch {
    throw new Error("The address is damaged: what follows its # cannot be read.");
  }
  const shared = readShared(value);
  if (!shared) throw new Error("The address is damaged: it carries no robot.");
  return shared;
}

/** Inflates, but never to more than a page's worth: a few bytes can stand for gigabytes. */
async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder("utf-8", { fatal: true });
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return text + decoder.decode();
    text += decoder.decode(value, { stream: true });
    if (text.length > MOST_TEXT) {
      void reader.cancel();
      throw new Error("too long");
    }
  }
}

// Reading, field by field --------------------------------------------------------------------------------------------

type Unknown = Record<string, unknown>;

function isRecord(value: unknown): value is Unknown {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function text(value: unknown): string | undefined {
  return typeof value === "string" && value.length <= MOST_WORDS ? value : undefined;
}

function list<T>(value: unknown, read: (one: unknown) => T | undefined, most = MOST_ROWS): T[] | undefined {
  if (!Array.isArray(value) || value.length > most) return undefined;
  const all = value.map(read);
  return all.every((one) => one !== undefined) ? (all as T[]) : undefined;
}

function number(value: unknown): number | undefined {
  return typeof value === "number" && Number.isFinite(value) && Math.abs(value) < 1e9 ? value : undefined;
}

function oneOf<T extends string>(value: unknown, ...allowed: T[]): T | undefined {
  return allowed.find((one) => one === value);
}

/** The keys of a record that can be read; the others are left out. */
function pick(value: Unknown, keys: readonly string[], read: (one: unknown) => unknown): Unknown {
  const entries = keys.map((key) => [key, Object.hasOwn(value, key) ? read(value[key]) : undefined] as const);
  return Object.fromEntries(entries.filter(([, one]) => one !== undefined));
}

function readRow(value: unknown): Row | undefined {
  if (!isRecord(value)) return undefined;
  const limits = list(value.limits, text, 2);
  return {
    ...pick(value, ["name", "theta", "d", "a", "alpha", "r", "gamma", "b", "velocity", "acceleration"], text),
    ...pick(value, ["mass", "rotor", "viscous", "coulomb"], text),
    ...pick(value, ["com", "inertia", "first_moment", "inertia_at_origin"], (one) => list(one, text)),
    ...(limits?.length === 2 && { limits: limits as [string, string] }),
  };
}

function readFrame(value: unknown): Frame | undefined {
  if (!isRecord(value)) return undefined;
  const three = (one: unknown) => {
    const texts = list(one, text, 3);
    return texts?.length === 3 ? texts : undefined;
  };
  const matrix = list(value.matrix, (row) => list(row, text, 4), 4);
  return { ...pick(value, ["xyz", "rpy"], three), ...(matrix && { matrix }) };
}

function readFile(value: unknown): RobotFile | undefined {
  if (!isRecord(value)) return undefined;
  const name = text(value.name);
  const convention = oneOf<Convention>(value.convention, "standard", "craig", "khalil");
  const joints = list(value.joints, readRow);
  const parameters = list(
    value.parameters,
    (one) => {
      const [symbol, worth] = isRecord(one) ? [text(one.name), text(one.value)] : [];
      return symbol !== undefined && worth !== undefined ? { name: symbol, value: worth } : undefined;
    },
    256,
  );
  const poses = list(value.poses, (one) => {
    const [title, values] = isRecord(one) ? [text(one.name), list(one.values, text)] : [];
    return title !== undefined && values !== undefined ? { name: title, values } : undefined;
  });
  if (name === undefined || !convention || !joints || !parameters || !poses) return undefined;
  const [source, gravity, base, tool] = [text(value.source), list(value.gravity, text, 3), readFrame(value.base), readFrame(value.tool)];
  return {
    name,
    convention,
    parameters,
    joints,
    poses,
    ...(source !== undefined && { source }),
    ...(gravity && { gravity }),
    ...(base && { base }),
    ...(tool && { tool }),
  };
}

/** A pose: rows of four, the last 0 0 0 1, the rest a rotation as near as its digits allow. */
function readPose(value: unknown): Matrix | undefined {
  const rows = list(value, (row) => list(row, number, 4), 4);
  if (rows?.length !== 4 || rows.some((row) => row.length !== 4)) return undefined;
  const turned = rows.slice(0, 3);
  const isRotation = turned.every((row, r) =>
    turned.every((other, s) => Math.abs(row[0] * other[0] + row[1] * other[1] + row[2] * other[2] - (r === s ? 1 : 0)) < 1e-6),
  );
  return isRotation && rows[3].join() === "0,0,0,1" ? rows : undefined;
}

function readLook(value: unknown): Partial<Look> | undefined {
  if (!isRecord(value)) return undefined;
  const flags = ["frames", "labels", "ghosts", "singular", "ellipsoid", "path", "grid", "perspective"] as const;
  return {
    ...pick(value, flags, (one) => (typeof one === "boolean" ? one : undefined)),
    ...pick(value, ["workspace"], (one) => oneOf(one, "none", "section", "cloud")),
    ...pick(value, ["angles"], (one) => oneOf(one, "deg", "rad")),
    ...pick(value, ["lengths"], (one) => oneOf(one, "mm", "m")),
  };
}

function readPoint(value: unknown): Waypoint | undefined {
  if (!isRecord(value)) return undefined;
  if (value.kind === "joint") {
    const values = list(value.q, number);
    return values && { kind: "joint", q: values };
  }
  const goal = readPose(value.pose);
  if (!goal) return undefined;
  if (value.kind === "line") return { kind: "line", pose: goal };
  const via = list(value.via, number, 3);
  return value.kind === "arc" && via?.length === 3 ? { kind: "arc", via: [via[0], via[1], via[2]], pose: goal } : undefined;
}

function readShared(value: unknown): Shared | undefined {
  if (!isRecord(value)) return undefined;
  const robotFile = readFile(value.file);
  if (!robotFile) return undefined;
  const row = number(value.selected);
  return {
    file: robotFile,
    q: list(value.q, number),
    target: readPose(value.target),
    look: readLook(value.look),
    panel: oneOf<Panel>(value.panel, "table", "joints", "hand", "formulas", "path", "check", "share"),
    selected: row !== undefined && Number.isInteger(row) && row >= 0 && row < robotFile.joints.length ? row : undefined,
    camera: list(value.camera, number),
    points: list(value.points, readPoint),
    start: list(value.start, number),
  };
}
