// The current number of each name that a topic defines, asked for at most once a frame and one at a time.

import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import { Cancelled } from "../engine/client.ts";
import type { Topic, Values } from "../engine/types.ts";
import { engine, q, revision } from "../state.ts";
import { short } from "./number.ts";

export class CurrentValues {
  readonly #topic: Topic;
  readonly #values = signal<Values>({});
  #out = false;
  #again = false;
  #frame = 0;
  #ended = false;

  constructor(topic: Topic) {
    this.#topic = topic;
  }

  /** Follows the joints; answers with what ends it. */
  follow(): () => void {
    const forRevision = revision.peek();
    this.#ended = false;
    const stop = effect(() => {
      void q.value;
      if (revision.value === forRevision) this.#soon();
    });
    return () => {
      this.#ended = true;
      cancelAnimationFrame(this.#frame);
      this.#frame = 0;
      stop();
    };
  }

  /** The number beside a formula, as text; nothing where there is none. */
  of(name: string): ReadonlySignal<string> {
    return computed(() => (name in this.#values.value ? short(this.#values.value[name]) : ""));
  }

  /** The number itself, if it has come. */
  now(name: string): number | undefined {
    return this.#values.peek()[name];
  }

  #soon(): void {
    this.#again = true;
    if (this.#out || this.#frame) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      void this.#ask();
    });
  }

  async #ask(): Promise<void> {
    const { formulas } = engine();
    // A derivation goes first: this would only stand in line behind it, out of date when it comes.
    if (formulas.busy) {
      setTimeout(() => !this.#ended && this.#soon(), 100);
      return;
    }
    this.#again = false;
    this.#out = true;
    try {
      const { values } = await formulas.call("values", { topic: this.#topic, q: q.peek() });
      if (!this.#ended) this.#values.value = values;
    } catch (why) {
      // Numbers are an addition: without them the formulas stand as they are.
      if (why instanceof Cancelled) this.#again = true;
    }
    this.#out = false;
    if (this.#again && !this.#ended) this.#soon();
  }
}
