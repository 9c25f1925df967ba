// The clock of the path: while it plays, seconds pass and the joints follow. No inverse problem is solved on the way.

import type { Path } from "../engine/types.ts";
import { batch, effect, move, path, playing, q, target, time } from "../state.ts";
import { mixed } from "./geometry.ts";

/** The joints at a time. */
export function at(path_: Path, seconds: number): number[] {
  const { t: times } = path_;
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const half = (low + high) >> 1;
    if (times[half] <= seconds) low = half;
    else high = half;
  }
  const span = times[high] - times[low];
  const t = span > 0 ? Math.min(1, Math.max(0, (seconds - times[low]) / span)) : 0;
  return mixed(path_.q[low], path_.q[high], t);
}

/** Runs the clock until what it returns is called. It needs no picture: without WebGL a path plays as well. */
export function runPlayer(): () => void {
  let frame = 0;
  let last = 0;
  const tick = (now: number): void => {
    const along = path.peek();
    if (!playing.peek() || !along) return;
    const next = time.peek() + (last ? Math.min(0.25, (now - last) / 1000) : 0);
    last = now;
    batch(() => {
      time.value = Math.min(along.duration, next);
      if (next >= along.duration) playing.value = false;
    });
    if (playing.peek()) frame = requestAnimationFrame(tick);
  };

  // Scrubbing and playing are the same: the joints are where the path is at that time.
  let shownAt = time.peek();
  const follow = effect(() => {
    const seconds = time.value;
    const along = path.peek();
    if (seconds === shownAt) return;
    shownAt = seconds;
    if (!along || along.t.length === 0) return;
    batch(() => {
      target.value = null;
      q.value = at(along, seconds);
    });
  });

  let wasPlaying = false;
  const change = effect(() => {
    const isPlaying = playing.value;
    if (isPlaying === wasPlaying) return;
    wasPlaying = isPlaying;
    cancelAnimationFrame(frame);
    if (!isPlaying) {
      // Now there is time for the other solutions.
      move(q.peek());
      return;
    }
    const along = path.peek();
    if (!along) playing.value = false;
    // From its end it begins again.
    else if (time.peek() >= along.duration - 1e-9) time.value = 0;
    last = 0;
    frame = requestAnimationFrame(tick);
  });

  return () => {
    cancelAnimationFrame(frame);
    follow();
    change();
  };
}
