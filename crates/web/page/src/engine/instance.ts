// One instance of the engine: a request goes in as JSON, its answer comes back.

import type { Input, Op, Output, Refused } from "./types.ts";

/**
 * The parts of the engine: what is needed at once, what solves poses, what derives, what reads what others wrote, what writes reports
 * and source code, and what checks documents and recordings. Each is loaded behind all before it.
 */
export const PARTS = ["denavit.wasm", "inverse.wasm", "derive.wasm", "read.wasm", "write.wasm", "check.wasm"] as const;
const ENTRIES = ["answer", "answer_inverse", "answer_more", "answer_read", "answer_written", "answer_check"] as const;

interface First extends WebAssembly.ModuleImports {
  memory: WebAssembly.Memory;
  /** Makes room for a request of so many bytes, and says where. */
  request(bytes: number): number;
  /** Where the answer stands; after a failure, the words of the failure. */
  text(): number;
  length(): number;
}

/** The part that answers a request, if it is not the first. */
const LATER: Partial<Record<Op, number>> = {
  solve: 1,
  formulas: 2,
  values: 2,
  singular: 2,
  workspace: 2,
  path: 2,
  fall: 2,
  read: 3,
  tree: 3,
  report: 4,
  code: 4,
  figure: 4,
  check: 5,
  recording: 5,
};

export function partOf(op: Op): number {
  return LATER[op] ?? 0;
}

/** What the engine refuses, in its words. */
export class EngineError extends Error {
  readonly hint?: string;
  constructor(refused: Refused) {
    super(refused.error);
    this.name = "EngineError";
    this.hint = refused.hint;
  }
}

/** Memory grows with every formula; beyond this an instance is replaced. */
const MOST_MEMORY = 400e6;

export class Instance {
  /** What is compiled so far; later parts are added when they are needed. */
  readonly modules: WebAssembly.Module[];
  /** What each part that runs exports. */
  #parts: WebAssembly.ModuleImports[] = [];
  /** What was edited last, to be told to a new instance. */
  #edited: Input<"edit"> | null = null;

  constructor(modules: WebAssembly.Module[]) {
    this.modules = modules;
    this.#begin();
  }

  /** Answers; throws an `EngineError` with the engine's reasons. */
  call<K extends Op>(op: K, input: Input<K>): Output<K> {
    if (op === "edit") {
      this.#edited = input as Input<"edit">;
      if (this.#first.memory.buffer.byteLength > MOST_MEMORY) this.#begin();
    }
    let answer: unknown;
    try {
      answer = this.#ask(op, input);
    } catch (failure) {
      // What an instance holds after a failure cannot be relied on.
      const words = this.#complaint(failure);
      this.#begin();
      if (this.#edited && op !== "edit") this.#ask("edit", this.#edited);
      throw new EngineError({ error: words });
    }
    if (answer && typeof answer === "object" && "error" in answer) throw new EngineError(answer as Refused);
    return answer as Output<K>;
  }

  get #first(): First {
    return this.#parts[0] as First;
  }

  #begin(): void {
    this.#parts = [];
    this.#part(0);
  }

  /** Starts a part, and all before it: they share the memory of the first. */
  #part(k: number): WebAssembly.ModuleImports {
    for (let next = this.#parts.length; next <= k; next += 1) {
      const module = this.modules[next];
      if (!module) throw new Error(`${PARTS[next]} is not there`);
      const imports = Object.fromEntries(this.#parts.map((part, name) => [name, part]));
      this.#parts.push(new WebAssembly.Instance(module, imports).exports as WebAssembly.ModuleImports);
    }
    return this.#parts[k];
  }

  #ask(op: Op, input: unknown): unknown {
    const part = partOf(op);
    const answer = this.#part(part)[ENTRIES[part]] as () => number;
    const bytes = new TextEncoder().encode(JSON.stringify({ op, input }));
    const at = this.#first.request(bytes.length);
    new Uint8Array(this.#first.memory.buffer, at, bytes.length).set(bytes);
    return JSON.parse(this.#read(answer()));
  }

  #read(length: number): string {
    return new TextDecoder().decode(new Uint8Array(this.#first.memory.buffer, this.#first.text(), length));
  }

  #complaint(failure: unknown): string {
    const words = `the engine stopped: ${failure instanceof Error ? failure.message : failure}`;
    try {
      const own = this.#read(this.#first.length());
      return own.startsWith("panicked") ? `${words} (${own})` : words;
    } catch {
      return words;
    }
  }
}
