// An instance of the engine beside the page: answers one request after the other.

import { EngineError, Instance, isLater } from "./instance.ts";
import type { Input, Op } from "./types.ts";

export type ToWorker = { first: WebAssembly.Module; second: string } | { id: number; op: Op; input: Input<Op> };
export type FromWorker = { id: number; milliseconds: number } & ({ answer: unknown } | { error: string; hint?: string });
type Asked = Extract<ToWorker, { id: number }>;

let instance: Instance | undefined;
/** Where the second part of the engine is fetched from when it is first needed. */
let second = "";
/** What is being answered, so that requests keep their order. */
let before: Promise<void> = Promise.resolve();

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ("first" in data) {
    instance = new Instance({ first: data.first, second: null });
    second = data.second;
    return;
  }
  before = before.then(() => answer(data));
};

async function answer({ id, op, input }: Asked): Promise<void> {
  let start = performance.now();
  let reply: { answer: unknown } | { error: string; hint?: string };
  try {
    if (!instance) throw new EngineError({ error: "the engine is not there yet" });
    if (isLater(op)) instance.modules.second ??= await WebAssembly.compileStreaming(fetch(second));
    start = performance.now();
    reply = { answer: instance.call(op, input) };
  } catch (failure) {
    const hint = failure instanceof EngineError ? failure.hint : undefined;
    reply = { error: failure instanceof Error ? failure.message : String(failure), hint };
  }
  self.postMessage({ id, milliseconds: performance.now() - start, ...reply } satisfies FromWorker);
}
