// glTF 2.0, as text with its data beside it or in one file (GLB). The axes of the file are those of the link: y is not made z.

import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { type Piece, piecesOf } from "../tree/pieces.ts";

interface Json {
  buffers?: { uri?: string; byteLength: number }[];
  bufferViews?: { buffer: number; byteOffset?: number }[];
  materials?: Record<string, unknown>[];
  [key: string]: unknown;
}

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

/** `beside` gives a file of the same folder. */
export async function read(bytes: Uint8Array<ArrayBuffer>, beside: (name: string) => Promise<Uint8Array>): Promise<Piece[]> {
  const { json, own } = taken(bytes);
  const parts: Uint8Array[] = [];
  const starts: number[] = [];
  let length = 0;
  for (const { uri } of json.buffers ?? []) {
    const data = uri === undefined ? own : uri.startsWith("data:") ? inline(uri) : await beside(decodeURIComponent(uri));
    if (!data) throw new Error("its data are missing");
    starts.push(length);
    parts.push(data);
    length += 4 * Math.ceil(data.length / 4);
  }
  // All data in one place, and no pictures: then the loader fetches nothing.
  for (const view of json.bufferViews ?? []) {
    view.byteOffset = (view.byteOffset ?? 0) + (starts[view.buffer] ?? 0);
    view.buffer = 0;
  }
  json.buffers = length > 0 ? [{ byteLength: length }] : [];
  for (const key of ["images", "textures", "samplers", "animations"]) delete json[key];
  json.materials = json.materials?.map(({ name, pbrMetallicRoughness }) => {
    const { baseColorFactor } = (pbrMetallicRoughness ?? {}) as { baseColorFactor?: number[] };
    return { name, pbrMetallicRoughness: { baseColorFactor } };
  });
  const { scene } = await new GLTFLoader().parseAsync(packed(json, parts, starts, length), "");
  return piecesOf(scene, true);
}

/** The description, and the data in the same file. */
function taken(bytes: Uint8Array<ArrayBuffer>): { json: Json; own: Uint8Array | null } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || view.getUint32(0, true) !== MAGIC) return { json: parsed(bytes), own: null };
  const size = view.getUint32(12, true);
  if (view.getUint32(16, true) !== JSON_CHUNK) throw new Error("it is no GLB");
  const rest = 20 + size;
  const own = rest + 8 <= bytes.length ? bytes.subarray(rest + 8, rest + 8 + view.getUint32(rest, true)) : null;
  return { json: parsed(bytes.subarray(20, rest)), own };
}

function parsed(bytes: Uint8Array): Json {
  const json: unknown = JSON.parse(new TextDecoder().decode(bytes));
  if (typeof json !== "object" || json === null) throw new Error("it is no glTF");
  return json as Json;
}

function inline(uri: string): Uint8Array {
  const [head, data = ""] = uri.split(",", 2);
  if (!head.endsWith(";base64")) throw new Error("its data are not in base64");
  return Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
}

/** One GLB of it. */
function packed(json: Json, parts: Uint8Array[], starts: number[], length: number): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const size = 4 * Math.ceil(text.length / 4);
  const total = 20 + size + (length > 0 ? 8 + length : 0);
  const out = new Uint8Array(total).fill(0x20, 20, 20 + size);
  const view = new DataView(out.buffer);
  [MAGIC, 2, total, size, JSON_CHUNK].forEach((value, k) => view.setUint32(4 * k, value, true));
  out.set(text, 20);
  if (length > 0) {
    view.setUint32(20 + size, length, true);
    view.setUint32(24 + size, BIN_CHUNK, true);
    parts.forEach((part, k) => out.set(part, 28 + size + starts[k]));
  }
  return out.buffer;
}
