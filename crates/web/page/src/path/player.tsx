// Playing a path: the scene advances `time` while `playing`; here are the buttons, and what happens at the end.

import { effect, signal } from "@preact/signals";
import { useComputed } from "@preact/signals";
import { seek } from "../plot/plot.tsx";
import { path, playing, time } from "../state.ts";
import { Icon } from "../widgets/icons.tsx";

/** Begins again at the end. */
export const loop = signal(false);

export function togglePlay(): void {
  const planned = path.peek();
  if (!planned) return;
  if (!playing.peek() && time.peek() >= planned.duration - 1e-9) time.value = 0;
  playing.value = !playing.peek();
}

// The scene stops at the end; with `loop` it is sent back.
let wasPlaying = false;
effect(() => {
  const planned = path.value;
  const atEnd = planned !== null && time.value >= planned.duration - 1e-9;
  const now = playing.value;
  if (wasPlaying && atEnd && loop.peek() && planned.duration > 0) {
    queueMicrotask(() => {
      time.value = 0;
      playing.value = true;
    });
  }
  wasPlaying = now;
});

export function Player({ end }: { end: number }) {
  const words = useComputed(() => `${Math.min(time.value, end).toFixed(2)} s`);
  return (
    <div class="player">
      <button type="button" class="button icon" aria-label={playing.value ? "Pause" : "Play"} title={playing.value ? "Pause" : "Play"} onClick={togglePlay}>
        <svg width="18" height="18" viewBox="0 0 18 18" fill="currentColor" aria-hidden="true">
          <path d={playing.value ? "M4.5 3.5h3v11h-3zM10.5 3.5h3v11h-3z" : "M5 3l10 6-10 6Z"} />
        </svg>
      </button>
      <input
        class="slider"
        type="range"
        min={0}
        max={end}
        step="any"
        aria-label="Time on the path"
        aria-valuetext={words}
        value={time}
        style={{ "--from": "0%", "--to": useComputed(() => `${((100 * Math.min(time.value, end)) / (end || 1)).toFixed(2)}%`).value }}
        onInput={(event) => seek(event.currentTarget.valueAsNumber, end)}
        onKeyDown={(event) => {
          const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
          if (step === undefined) return;
          event.preventDefault();
          seek(time.peek() + (step * end) / 100, end);
        }}
      />
      <output class="clock">
        {words} <span class="quiet">/ {end.toFixed(2)} s</span>
      </output>
      <button type="button" class="button icon" aria-pressed={loop.value} aria-label="Repeat" title="Repeat" onClick={() => (loop.value = !loop.value)}>
        <Icon name="reset" />
      </button>
    </div>
  );
}
