// The engine outside of a browser: what the page shows is held against what the same wasm answers here.
import { readFileSync } from "node:fs";

const dist = new URL("../dist/", import.meta.url);
const ENTRIES = ["answer", "answer_inverse", "answer_more", "answer_read", "answer_written", "answer_check"];
const LATER = { solve: 1, formulas: 2, values: 2, singular: 2, workspace: 2, path: 2, fall: 2, read: 3, tree: 3, report: 4, code: 4, figure: 4, check: 5, recording: 5 };
const modules = ["denavit", "inverse", "derive", "read", "write", "check"].map((name) => new WebAssembly.Module(readFileSync(new URL(`${name}.wasm`, dist))));

export class Engine {
  #parts = [];

  /** As `src/engine/instance.ts`; throws what the engine refuses. */
  call(op, input = {}) {
    const part = LATER[op] ?? 0;
    while (this.#parts.length <= part) {
      const imports = Object.fromEntries(this.#parts.map((exports, k) => [k, exports]));
      this.#parts.push(new WebAssembly.Instance(modules[this.#parts.length], imports).exports);
    }
    const [first] = this.#parts;
    const bytes = new TextEncoder().encode(JSON.stringify({ op, input }));
    const at = first.request(bytes.length);
    new Uint8Array(first.memory.buffer, at, bytes.length).set(bytes);
    const length = this.#parts[part][ENTRIES[part]]();
    const text = new TextDecoder().decode(new Uint8Array(first.memory.buffer, first.text(), length));
    const answer = JSON.parse(text);
    if (typeof answer === "object" && "error" in answer) throw new Error(`${op}: ${answer.error} ${answer.hint ?? ""}`);
    return answer;
  }
}

/** An engine that has read a robot of the catalogue, and what it says of it. */
export function robotOf(name) {
  const engine = new Engine();
  const { file } = engine.call("open", { text: name, kind: "robot" });
  const { robot } = engine.call("edit", { file });
  return { engine, file, robot };
}

/** An engine that has read the table of a shared page. */
export function robotIn(file) {
  const engine = new Engine();
  const { robot } = engine.call("edit", { file });
  return { engine, file, robot };
}

/** The pose of the tool by the engine's frames. */
export function handAt(engine, q) {
  return engine.call("scene", { q }).frames.at(-1);
}

/** The largest difference of two poses, metres and direction cosines. */
export function apart(one, other) {
  return Math.max(...one.flatMap((row, r) => row.map((x, c) => Math.abs(x - other[r][c]))));
}
