// The engine outside of a browser: what the page shows is held against what the same wasm answers here.
import { readFileSync } from "node:fs";

const dist = new URL("../dist/", import.meta.url);
const LATER = new Set(["formulas", "values", "singular", "workspace", "path", "check", "report", "code", "figure"]);
const module = new WebAssembly.Module(readFileSync(new URL("denavit.wasm", dist)));
let secondModule;

export class Engine {
  #first = new WebAssembly.Instance(module, {}).exports;
  #second;

  /** As `src/engine/instance.ts`; throws what the engine refuses. */
  call(op, input = {}) {
    const bytes = new TextEncoder().encode(JSON.stringify({ op, input }));
    const at = this.#first.request(bytes.length);
    new Uint8Array(this.#first.memory.buffer, at, bytes.length).set(bytes);
    const length = LATER.has(op) ? this.#later().answer_more() : this.#first.answer();
    const text = new TextDecoder().decode(new Uint8Array(this.#first.memory.buffer, this.#first.text(), length));
    const answer = JSON.parse(text);
    if (typeof answer === "object" && "error" in answer) throw new Error(`${op}: ${answer.error} ${answer.hint ?? ""}`);
    return answer;
  }

  #later() {
    secondModule ??= new WebAssembly.Module(readFileSync(new URL("derive.wasm", dist)));
    return (this.#second ??= new WebAssembly.Instance(secondModule, { first: this.#first }).exports);
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
