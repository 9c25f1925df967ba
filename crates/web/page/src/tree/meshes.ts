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
    const ending = /\.([a-z]+)$/i.exec(path)?.[1]?.toLowerCase();
    const folder = path.slice(0, path.lastIndexOf("/") + 1);
    switch (ending) {
      case "stl":
        return (await lazy("stl")).read(bytes);
      case "obj":
        return (await lazy("obj")).read(bytes);
      case "dae":
        return (await lazy("collada")).read(bytes);
      case "gltf":
      case "glb":
        // Data beside it lie in the same folder, and nowhere else.
        return (await lazy("gltf")).read(bytes, (name) => (/[\\/:]/.test(name) ? Promise.reject(new Error("its data lie elsewhere")) : this.#load(folder + name)));
      default:
        throw new Error(`meshes of the kind .${ending ?? ""} are not read`);
    }
  }
}
