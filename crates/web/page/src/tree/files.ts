// Files that somebody chose or dropped: one, several, a folder, a zip. They have their paths from the top, and their bytes
// when these are asked for.

import { isPlain, lazy } from "./lazy.ts";

export interface Lying {
  /** Words between slashes, from the top of what was dropped. */
  path: string;
  /** Bytes. */
  size: number;
  read(): Promise<Uint8Array<ArrayBuffer>>;
}

/** More is no folder of one robot. */
const MOST_FILES = 20_000;
const MOST_DEPTH = 24;
/** Of a zip: packed, and what is taken out of it; bytes. */
const MOST_ZIP = 256 * 2 ** 20;
const MOST_UNPACKED = 320 * 2 ** 20;
/** Texts that a description may include, together. */
const MOST_TEXTS = 64 * 2 ** 20;
const MOST_TEXT = 16 * 2 ** 20;

function ofFile(file: File, path: string): Lying {
  return { path, size: file.size, read: async () => new Uint8Array(await file.arrayBuffer()) };
}

/** Files of an input, with the paths that a chosen folder gives them. */
export function ofInput(files: Iterable<File>): Lying[] {
  return [...files].slice(0, MOST_FILES).map((file) => ofFile(file, file.webkitRelativePath || file.name));
}

/** What was dropped; has to be called while the event is handled. */
export function ofDrop(data: DataTransfer): Promise<Lying[]> {
  const entries = [...data.items].map((item) => (item.kind === "file" ? (item.webkitGetAsEntry?.() ?? null) : null));
  const hasFolder = entries.some((entry) => entry?.isDirectory);
  if (!hasFolder) return Promise.resolve(ofInput(data.files));
  return walk(entries.filter((entry) => entry !== null));
}

async function walk(top: FileSystemEntry[]): Promise<Lying[]> {
  const found: Lying[] = [];
  const open = top.map((entry) => ({ entry, depth: 0 }));
  for (let next = open.pop(); next; next = open.pop()) {
    const { entry, depth } = next;
    // Hidden folders hold the history of others.
    if (entry.name.startsWith(".") || depth > MOST_DEPTH) continue;
    if (isFolder(entry)) open.push(...(await inside(entry)).map((one) => ({ entry: one, depth: depth + 1 })));
    else if (isFileEntry(entry)) {
      const file = await new Promise<File>((resolve, reject) => entry.file(resolve, reject));
      found.push(ofFile(file, entry.fullPath.replace(/^\/+/, "")));
    }
    if (found.length > MOST_FILES) throw new Error(`The folder has more than ${MOST_FILES} files: open that of the robot alone.`);
  }
  return found.sort((a, b) => (a.path < b.path ? -1 : 1));
}

function isFolder(entry: FileSystemEntry): entry is FileSystemDirectoryEntry {
  return entry.isDirectory;
}

function isFileEntry(entry: FileSystemEntry): entry is FileSystemFileEntry {
  return entry.isFile;
}

/** A browser tells the entries of a folder in portions; an empty one is the last. */
async function inside(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0 || all.length > MOST_FILES) return all;
    all.push(...some);
  }
}

/** The same, where a zip is what is in it. */
export async function unpacked(files: Lying[]): Promise<Lying[]> {
  if (files.length !== 1 || !/\.zip$/i.test(files[0].path)) return files;
  const [archive] = files;
  if (archive.size > MOST_ZIP) throw new Error(`${archive.path} is larger than 256 MiB.`);
  const { unzip } = await lazy("unzip");
  const entries = unzip(await archive.read(), { files: MOST_FILES, bytes: MOST_UNPACKED, wanted: isWanted });
  return entries.map(({ path, bytes }) => ({ path, size: bytes.length, read: async () => bytes }));
}

const TEXT = /\.(urdf|xacro|xml|mjcf|ya?ml)$/i;
export const MESH = /\.(stl|obj|dae|gltf|glb)$/i;

function isWanted(path: string): boolean {
  return TEXT.test(path) || MESH.test(path) || /\.bin$/i.test(path);
}

/** The texts that a description may include. */
export async function texts(files: Lying[]): Promise<[string, string][]> {
  const all = files.filter(({ path, size }) => TEXT.test(path) && size <= MOST_TEXT);
  if (all.reduce((sum, { size }) => sum + size, 0) > MOST_TEXTS) throw new Error("The descriptions together are larger than 64 MiB: open the folder of the robot alone.");
  return Promise.all(all.map(async ({ path, read }): Promise<[string, string]> => [path, decoded(await read())]));
}

export function decoded(bytes: Uint8Array): string {
  return new TextDecoder().decode(bytes);
}

/** The name of the root element of a text of XML. */
export function root(text: string): string | undefined {
  return /^\uFEFF?\s*(?:<\?[^>]*\?>\s*|<!--.*?-->\s*)*<([\w.:-]+)/s.exec(text.slice(0, 20_000))?.[1];
}

/** Whether a model of MuJoCo's includes others: it stands beside one that is whole. */
export function includesOthers([path, text]: [string, string]): boolean {
  return /\.(xml|mjcf)$/i.test(path) && root(text) === "mujoco" && text.includes("<include");
}

/**
 * Descriptions among texts, the likeliest first: a URDF before a model of MuJoCo's before what xacro has yet to expand, a model that
 * includes no other one before one that does, the top before what lies below.
 */
export function descriptions(texts: [string, string][]): string[] {
  const models = new Map(texts.filter(([path, text]) => /\.(xml|mjcf)$/i.test(path) && root(text) === "mujoco"));
  const rank = (path: string) => {
    const model = models.get(path);
    if (model !== undefined) return includesOthers([path, model]) ? 2 : 1;
    return /\.urdf$/i.test(path) ? 0 : /\.urdf\.xacro$/i.test(path) ? 3 : 4;
  };
  const depth = (path: string) => path.split("/").length;
  const found = texts.map(([path]) => path).filter((path) => (/\.(urdf|xacro)$/i.test(path) || models.has(path)) && isPlain(path));
  return found.sort((a, b) => rank(a) - rank(b) || depth(a) - depth(b) || (a < b ? -1 : 1));
}
