// Columns of numbers in a file in Parquet, lists of them spread out, within bounds.

import { parquetMetadataAsync, parquetReadObjects } from "hyparquet";
import { compressors } from "hyparquet-compressors";
import type { RecordedColumn } from "../engine/types.ts";

/** The most rows and numbers that are read. */
const MOST_ROWS = 1_000_000;
const MOST_NUMBERS = 20_000_000;

/** The columns that hold numbers; `left` names the others. */
export async function columnsOf(bytes: Uint8Array<ArrayBuffer>): Promise<{ columns: RecordedColumn[]; left: string[] }> {
  const file = { byteLength: bytes.length, slice: async (from: number, to?: number) => bytes.buffer.slice(bytes.byteOffset + from, bytes.byteOffset + (to ?? bytes.length)) };
  const metadata = await parquetMetadataAsync(file);
  const rows = Number(metadata.num_rows);
  if (rows > MOST_ROWS) throw new Error(`The file has ${rows} rows; ${MOST_ROWS} are read here at most: \`denavit check\` reads more.`);
  const found = new Map<string, (number | null)[]>();
  const left = new Set<string>();
  const put = (name: string, row: number, value: unknown): void => {
    const number = typeof value === "bigint" || typeof value === "boolean" ? Number(value) : value;
    if (number === null || number === undefined) return;
    if (typeof number !== "number") {
      left.add(name);
      return;
    }
    let column = found.get(name);
    if (!column) {
      if ((found.size + 1) * rows > MOST_NUMBERS) throw new Error("The file has more numbers than are read here: `denavit check` reads more.");
      column = new Array<number | null>(rows).fill(null);
      found.set(name, column);
    }
    column[row] = Number.isFinite(number) ? number : null;
  };
  const read = await parquetReadObjects({ file, metadata, compressors });
  read.forEach((object, row) => {
    for (const [name, value] of Object.entries(object)) {
      if (Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView))) {
        (value as unknown[]).forEach((one, k) => put(`${name}[${k}]`, row, one));
      } else put(name, row, value);
    }
  });
  return { columns: [...found].map(([name, values]) => ({ name, values })), left: [...left].map((name) => name.replace(/\[\d+\]$/, "")).filter((name, k, all) => all.indexOf(name) === k) };
}
