// An instance of the engine beside the page: answers one request after the other.

import { EngineError, Instance, partOf } from "./instance.ts";
import type { Input, Op } from "./types.ts";

export type ToWorker = { first: WebAssembly.Module; parts: (string | Blob)[] } | { prepare: Op } | { id: number; op: Op; input: Input<Op> };
export type FromWorker = { id: number; milliseconds: number } & ({ answer: unknown } | { error: string; hint?: string });
type Asked = Extract<ToWorker, { id: number }>;

let instance: Instance | undefined;
/** Where parts of the engine come from when they are first needed. */
let parts: (string | Blob)[] = [];
/** What is being answered, so that requests keep their order. */
let before: Promise<void> = Promise.resolve();

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ("first" in data) {
    instance = new Instance([data.first]);
    parts = data.parts;
    return;
  }
  // A part that cannot be fetched is asked for again by the request that needs it, which says so.
  before = before.then(() => ("prepare" in data ? prepared(data.prepare).catch(() => {}) : answer(data)));
};

/** Fetches and compiles what of the engine answers a request. */
async function prepared(op: Op): Promise<void> {
  if (!instance) return;
  for (let next = instance.modules.length; next <= partOf(op); next += 1) {
    const source = parts[next];
    instance.modules.push(await (typeof source === "string" ? WebAssembly.compileStreaming(fetch(source)) : WebAssembly.compile(await source.arrayBuffer())));
  }
}

async function answer({ id, op, input }: Asked): Promise<void> {
  let start = performance.now();
  let reply: { answer: unknown } | { error: string; hint?: string };
  try {
    if (!instance) throw new EngineError({ error: "the engine is not there yet" });
    await prepared(op);
    start = performance.now();
    reply = { answer: instance.call(op, input) };
  } catch (failure) {
    const hint = failure instanceof EngineError ? failure.hint : undefined;
    reply = { error: failure instanceof Error ? failure.message : String(failure), hint };
  }
  self.postMessage({ id, milliseconds: performance.now() - start, ...reply } satisfies FromWorker);
}
