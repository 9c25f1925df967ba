// Prints how large the files of a folder are, raw and as a server sends them: `node sizes.mjs FOLDER`.
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

const [folder] = process.argv.slice(2);
const entries = readdirSync(folder, { recursive: true, withFileTypes: true });
const paths = entries.filter((e) => e.isFile()).map((e) => join(e.parentPath, e.name));
const rows = paths.sort().map((path) => {
  const bytes = readFileSync(path);
  const params = { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length };
  const name = path.slice(join(folder, "/").length);
  const gzip = gzipSync(bytes, { level: 9 }).length;
  return { name, raw: bytes.length, gzip, brotli: brotliCompressSync(bytes, { params }).length };
});
console.log(JSON.stringify(rows));
