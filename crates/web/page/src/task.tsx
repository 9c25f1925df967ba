// Something that takes a while, with progress and a way to end it.

import { type Signal, signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import { Cancelled, EngineError } from "./engine/client.ts";
import { Button } from "./widgets/button.tsx";
import { Callout } from "./widgets/callout.tsx";

export type Progress<T> =
  | { kind: "idle" }
  /** `slow` once it has taken so long that somebody would wonder. */
  | { kind: "running"; since: number; slow: boolean }
  | { kind: "done"; answer: T; milliseconds: number }
  | { kind: "failed"; words: string; hint?: string }
  | { kind: "cancelled" };

/** Before this nothing is shown, so that quick answers do not flicker, milliseconds. */
const PATIENCE = 150;

export class Task<T> {
  readonly progress: Signal<Progress<T>> = signal({ kind: "idle" });
  #run = 0;

  get running(): boolean {
    return this.progress.value.kind === "running";
  }

  /** Runs; an answer that comes after another start is dropped. */
  async start(ask: () => Promise<T>): Promise<T | null> {
    const run = ++this.#run;
    const since = performance.now();
    this.progress.value = { kind: "running", since, slow: false };
    const timer = setTimeout(() => {
      if (run === this.#run) this.progress.value = { kind: "running", since, slow: true };
    }, PATIENCE);
    try {
      const answer = await ask();
      if (run !== this.#run) return null;
      this.progress.value = { kind: "done", answer, milliseconds: performance.now() - since };
      return answer;
    } catch (why) {
      if (run === this.#run) this.progress.value = ended(why);
      return null;
    } finally {
      clearTimeout(timer);
    }
  }

  /** Forgets what ran and what came of it. */
  reset(): void {
    this.#run += 1;
    this.progress.value = { kind: "idle" };
  }
}

function ended<T>(why: unknown): Progress<T> {
  if (why instanceof Cancelled) return { kind: "cancelled" };
  const hint = why instanceof EngineError ? why.hint : undefined;
  return { kind: "failed", words: why instanceof Error ? why.message : String(why), hint };
}

/** What is running, for how long, and a button that ends it; takes the height of a line whether it says something or not. */
export function ProgressLine<T>(props: { task: Task<T>; words: string; cancel: () => void; children?: ComponentChildren }) {
  const progress = props.task.progress.value;
  const slow = progress.kind === "running" && progress.slow;
  return (
    <div class="progress-line" role="status">
      {slow ? (
        <>
          <progress aria-label={props.words} />
          <span>
            {props.words} <Elapsed since={progress.since} />
          </span>
          <Button label="Cancel" small onClick={props.cancel} />
        </>
      ) : (
        props.children
      )}
    </div>
  );
}

/** Seconds since then, counted on. Not spoken: a screen reader would count along. */
function Elapsed({ since }: { since: number }) {
  const [now, tick] = useState(performance.now());
  useEffect(() => {
    const timer = setInterval(() => tick(performance.now()), 500);
    return () => clearInterval(timer);
  }, [since]);
  const seconds = Math.floor((now - since) / 1000);
  return (
    <span class="elapsed" aria-hidden="true">
      {seconds > 0 ? `${seconds} s` : ""}
    </span>
  );
}

/** The engine's reasons where it refuses. */
export function Failure({ words, hint }: { words: string; hint?: string }) {
  return (
    <Callout tone="error" alert>
      <span>
        {words} {hint && <span class="quiet">{hint}</span>}
      </span>
    </Callout>
  );
}
