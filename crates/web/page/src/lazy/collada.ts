// Collada: its unit counts, and a file whose y is up is turned so that its z is.

import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { type Piece, piecesOf } from "../tree/pieces.ts";

export function read(bytes: Uint8Array<ArrayBuffer>): Piece[] {
  // Pictures are not drawn: nothing is fetched for them.
  const text = new TextDecoder().decode(bytes).replace(/<library_images[\s\S]*?<\/library_images>/g, "");
  // The loader tells of what is done here, and what it misses.
  const { warn, debug, error } = console;
  console.warn = console.debug = console.error = () => {};
  try {
    const { scene } = new ColladaLoader().parse(text, "") ?? {};
    if (!scene) throw new Error("it is no Collada");
    // The loader makes y the axis that is up; in a robot z is.
    scene.rotateOnWorldAxis(scene.up.clone().set(1, 0, 0), Math.PI / 2);
    return piecesOf(scene, true);
  } finally {
    Object.assign(console, { warn, debug, error });
  }
}
