// Wavefront OBJ. Its materials stand in other files and are left.

import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { type Piece, piecesOf } from "../tree/pieces.ts";

export function read(bytes: Uint8Array<ArrayBuffer>): Piece[] {
  return piecesOf(new OBJLoader().parse(new TextDecoder().decode(bytes)), false);
}
