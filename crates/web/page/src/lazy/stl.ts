// STL, binary or text. It has no unit: its numbers are metres before the scale of the description.

import { Mesh } from "three";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import { type Piece, piecesOf } from "../tree/pieces.ts";

export function read(bytes: Uint8Array<ArrayBuffer>): Piece[] {
  return piecesOf(new Mesh(new STLLoader().parse(bytes.buffer)), false);
}
