// The engines of the page: one at once, for what takes no time; the others in workers, for what takes longer.

import { addressOf, sourceOf, unpackFiles } from "../files.ts";
import { EngineError, Instance, PARTS } from "./instance.ts";
import type { Input, Op, Output } from "./types.ts";
import type { FromWorker, ToWorker } from "./worker.ts";

export { EngineError };

/** A request that was taken back. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

interface Waiting {
  id: number;
  op: Op;
  resolve(answer: unknown): void;
  reject(why: Error): void;
}

/** An engine in a worker. Requests are answered in order; `cancel` ends the one that runs, with all behind it. */
export class Remote {
  #module: WebAssembly.Module;
  /** Started when something is asked: the first picture does not wait for it. */
  #worker: Worker | null = null;
  #waiting: Waiting[] = [];
  #last = 0;
  #edited: Input<"edit"> | null = null;
  /** How long the last answer to each request took inside the worker, milliseconds. */
  readonly took: Partial<Record<Op, number>> = {};

  constructor(module: WebAssembly.Module) {
    this.#module = module;
  }

  /** True while something is being answered. */
  get busy(): boolean {
    return this.#waiting.length > 0;
  }

  /** The robot that everything asked from now on is about. */
  edit(input: Input<"edit">): void {
    this.#edited = input;
    if (this.#worker) void this.call("edit", input).catch(() => {});
  }

  call<K extends Op>(op: K, input: Input<K>): Promise<Output<K>> {
    this.#begin();
    const id = ++this.#last;
    return new Promise<Output<K>>((resolve, reject) => {
      this.#waiting.push({ id, op, resolve: resolve as (answer: unknown) => void, reject });
      this.#post({ id, op, input });
    });
  }

  /** Starts the worker and what of the engine answers a request, before it is asked. */
  prepare(op: Op): void {
    this.#begin();
    this.#post({ prepare: op });
  }

  /** Ends what runs and what waits, and begins again with the same robot. */
  cancel(): void {
    if (!this.busy) return;
    this.#worker?.terminate();
    this.#worker = null;
    for (const one of this.#waiting.splice(0)) one.reject(new Cancelled());
  }

  /** Starts the worker, and tells it the robot, unless it runs. */
  #begin(): void {
    if (this.#worker) return;
    this.#worker = this.#start();
    if (this.#edited) void this.call("edit", this.#edited).catch(() => {});
  }

  #start(): Worker {
    const address = addressOf("worker.js");
    // A page that is a file may start a script that it holds itself, but no module.
    const worker = new Worker(address, { type: address.startsWith("blob:") ? "classic" : "module" });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      const at = this.#waiting.findIndex((one) => one.id === data.id);
      if (at < 0) return;
      const [one] = this.#waiting.splice(at, 1);
      this.took[one.op] = data.milliseconds;
      if ("error" in data) one.reject(new EngineError(data));
      else one.resolve(data.answer);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      for (const one of this.#waiting.splice(0)) one.reject(new EngineError({ error: event.message }));
    };
    worker.postMessage({ first: this.#module, parts: PARTS.map(sourceOf) } satisfies ToWorker);
    return worker;
  }

  #post(message: ToWorker): void {
    this.#worker?.postMessage(message);
  }
}

export interface Engines {
  /** Answers at once: tables, frames, poses. */
  now: Instance;
  /** Inverse solutions and paths. */
  solver: Remote;
  /** Formulas, the workspace, checks, reports, code. */
  formulas: Remote;
  /** Descriptions of trees, which are no matter of the robot in hand. */
  files: Remote;
}

/** Fetches and compiles the engine, once for all. */
export async function load(): Promise<Engines> {
  await unpackFiles();
  const module = await WebAssembly.compileStreaming(fetch(addressOf(PARTS[0])));
  return { now: new Instance([module]), solver: new Remote(module), formulas: new Remote(module), files: new Remote(module) };
}
