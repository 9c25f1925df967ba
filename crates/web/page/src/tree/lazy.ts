// Parts of the page that are fetched when they are first needed: what unpacks archives, reads meshes and tables.

import { addressOf } from "../files.ts";

interface Parts {
  parquet: typeof import("../lazy/parquet.ts");
  unzip: typeof import("../lazy/unzip.ts");
  stl: typeof import("../lazy/stl.ts");
  obj: typeof import("../lazy/obj.ts");
  gltf: typeof import("../lazy/gltf.ts");
  collada: typeof import("../lazy/collada.ts");
}

/** A part; `build.mjs` bundles each by itself. */
export function lazy<K extends keyof Parts>(name: K): Promise<Parts[K]> {
  return import(addressOf(`lazy-${name}.js`)) as Promise<Parts[K]>;
}

/** Whether a path leads nowhere but down. */
export function isPlain(path: string): boolean {
  return !path.split(/[\\/]/).includes("..");
}
