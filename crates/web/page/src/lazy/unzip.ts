// What is in a zip, within bounds.

import { unzipSync } from "fflate";

interface Bounds {
  files: number;
  /** Unpacked, together. */
  bytes: number;
  wanted(path: string): boolean;
}

/** The files that are wanted. Sizes are those that the archive states: one that states too little is cut off there. */
export function unzip(archive: Uint8Array, bounds: Bounds): { path: string; bytes: Uint8Array<ArrayBuffer> }[] {
  let [count, sum] = [0, 0];
  const found = unzipSync(archive, {
    filter: ({ name, originalSize }) => {
      if (name.endsWith("/") || /(^|\/)(\.|__MACOSX\/)/.test(name) || !bounds.wanted(name)) return false;
      count += 1;
      sum += originalSize;
      if (count > bounds.files) throw new Error(`The archive has more than ${bounds.files} files.`);
      if (sum > bounds.bytes) throw new Error(`The archive holds more than ${Math.round(bounds.bytes / 2 ** 20)} MiB.`);
      return true;
    },
  });
  return Object.entries(found).map(([path, bytes]) => ({ path, bytes: new Uint8Array(bytes) }));
}
