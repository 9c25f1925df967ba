// From numbers to places on a plot, and round numbers for its axes.

export interface Scale {
  min: number;
  max: number;
  ticks: number[];
  /** Decimals that tell the ticks apart. */
  places: number;
}

/** Angles in degrees are read in these steps. */
const DEGREES = [1, 2, 5, 10, 15, 30, 45, 90, 180, 360];

/** A scale from a round number to a round number, with about so many steps. */
export function scale(low: number, high: number, steps: number, degrees = false): Scale {
  if (!(high > low)) {
    const pad = Math.max(Math.abs(low) * 0.1, degrees ? 1 : 1e-3);
    low -= pad;
    high += pad;
  }
  const step = roundStep((high - low) / steps, degrees);
  const first = Math.floor(low / step + 1e-9);
  const last = Math.ceil(high / step - 1e-9);
  const ticks = Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
  return { min: first * step, max: last * step, ticks, places: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/** A scale that ends where the numbers end, for time. */
export function exactScale(low: number, high: number, steps: number): Scale {
  const { ticks, places } = scale(low, high, steps);
  return { min: low, max: high, ticks: ticks.filter((t) => t >= low - 1e-9 && t <= high + 1e-9), places };
}

function roundStep(rough: number, degrees: boolean): number {
  const fitting = degrees ? DEGREES.find((step) => step >= rough * 0.8) : undefined;
  if (fitting && rough > 0.5) return fitting;
  const power = 10 ** Math.floor(Math.log10(rough));
  const digit = rough / power;
  return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

/** The sample before a time, and how far from it to the next, from 0 to 1. */
export function locate(times: number[], time: number): { index: number; part: number } {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  const length = (times[high] ?? 0) - (times[low] ?? 0);
  return { index: low, part: length > 0 ? Math.min(1, Math.max(0, (time - times[low]!) / length)) : 0 };
}

/** A value between samples. */
export function interpolate(times: number[], values: number[], time: number): number {
  const { index, part } = locate(times, time);
  const from = values[index] ?? 0;
  return from + ((values[index + 1] ?? from) - from) * part;
}
