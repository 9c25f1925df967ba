// Meshes of a description: read with the reader of their kind, which is fetched when it is first needed, within bounds.

import { lazy } from "./lazy.ts";
import type { Lying } from "./files.ts";
import { MOST_TRIANGLES, type Piece } from "./pieces.ts";

const MOST_FILE = 64 * 2 ** 20;
const MOST_ALL = 256 * 2 ** 20;

/** How much was read of one description. */
export class Meshes {
  #files: Map<string, Lying>;
  #read = new Map<string, Promise<Piece[]>>();
  #bytes = 0;
  #triangles = 0;

  constructor(files: Lying[]) {
    this.#files = new Map(files.map((file) => [file.path, file]));
  }

  /** The triangles of a mesh; read once, however often it is asked for. Throws a sentence. */
  pieces(path: string): Promise<Piece[]> {
    const known = this.#read.get(path);
    if (known) return known;
    const asked = this.#pieces(path);
    this.#read.set(path, asked);
    return asked;
  }

  async #pieces(path: string): Promise<Piece[]> {
    const pieces = await this.#parsed(path, await this.#load(path));
    this.#triangles += pieces.reduce((sum, { positions }) => sum + positions.length / 9, 0);
    if (this.#triangles > MOST_TRIANGLES) throw new Error("with it there are more than 5 million triangles");
    return pieces;
  }

  async #load(path: string): Promise<Uint8Array<ArrayBuffer>> {
    const file = this.#files.get(path);
    if (!file) throw new Error("it is not among the files");
    if (file.size > MOST_FILE) throw new Error("it is larger than 64 MiB");
    this.#bytes += file.size;
    if (this.#bytes > MOST_ALL) throw new Error("with it the meshes are larger than 256 MiB");
    return file.read();
  }

  async #parsed(path: string, bytes: Uint8Array<ArrayBuffer>): Promise<Piece[]> {
    const kind = READERS[endingOf(path)];
    if (!kind) throw new Error(`meshes of the kind .${endingOf(path)} are not read`);
    if (kind !== "gltf") return (await lazy(kind)).read(bytes);
    // Data beside it lie in the same folder, and nowhere else.
    const folder = path.slice(0, path.lastIndexOf("/") + 1);
    return (await lazy(kind)).read(bytes, (name) => (/[\\/:]/.test(name) ? Promise.reject(new Error("its data lie elsewhere")) : this.#load(folder + name)));
  }
}

const READERS: Readonly<Record<string, "stl" | "obj" | "collada" | "gltf">> = { stl: "stl", obj: "obj", dae: "collada", gltf: "gltf", glb: "gltf" };

function endingOf(path: string): string {
  return /\.([a-z]+)$/i.exec(path)?.[1]?.toLowerCase() ?? "";
}

/** Fetches what reads the meshes among files, before one is asked for. */
export function prepareReaders(files: Lying[]): void {
  const kinds = new Set(files.map(({ path }) => READERS[endingOf(path)]));
  // One that cannot be fetched is asked for again by the mesh that needs it, which says so.
  for (const kind of kinds) if (kind) lazy(kind).catch(() => {});
}
