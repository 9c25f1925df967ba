// One instance of the engine: a request goes in as JSON, its answer comes back.

import type { Input, Op, Output, Refused } from "./types.ts";

/** The engine as it is fetched: at once, and what is needed when something is derived. */
export interface Modules {
  first: WebAssembly.Module;
  second: WebAssembly.Module | null;
}

interface First {
  memory: WebAssembly.Memory;
  /** Makes room for a request of so many bytes, and says where. */
  request(bytes: number): number;
  /** Answers the request; how long the answer is. */
  answer(): number;
  /** Where the answer stands; after a failure, the words of the failure. */
  text(): number;
  length(): number;
}

interface Second {
  answer_more(): number;
}

/** What is answered by the second part. */
const LATER: ReadonlySet<Op> = new Set<Op>([
  "formulas", "values", "singular", "workspace", "path", "check", "report", "code", "figure",
]);

export function isLater(op: Op): boolean {
  return LATER.has(op);
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
  readonly modules: Modules;
  #first!: First;
  #second: Second | null = null;
  /** What was edited last, to be told to a new instance. */
  #edited: Input<"edit"> | null = null;

  constructor(modules: Modules) {
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

  #begin(): void {
    this.#first = new WebAssembly.Instance(this.modules.first, {}).exports as unknown as First;
    this.#second = null;
  }

  #ask(op: Op, input: unknown): unknown {
    const { memory, request, answer } = this.#first;
    const bytes = new TextEncoder().encode(JSON.stringify({ op, input }));
    const at = request(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    return JSON.parse(this.#read(isLater(op) ? this.#later() : answer()));
  }

  /** Answers by the second part, which uses the memory of the first. */
  #later(): number {
    if (!this.modules.second) throw new Error("the second part of the engine is not there");
    const imports = { first: this.#first as unknown as WebAssembly.ModuleImports };
    this.#second ??= new WebAssembly.Instance(this.modules.second, imports).exports as unknown as Second;
    return this.#second.answer_more();
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
