// A slider over a range of angles or lengths, with the steps that joints have: arrows 1° or 1 mm, shift ten times,
// alt a tenth.

import type { TargetedKeyboardEvent } from "preact";
import { look } from "../state.ts";
import { formatWithUnit, keyStep, type Measure } from "../units.ts";
import { byKey } from "./keys.ts";

interface SliderProps {
  label: string;
  value: number;
  range: [number, number];
  measure: Measure;
  onChange(value: number): void;
  /** The rail is filled from here; zero if it is in the range. */
  origin?: number;
  /** The arrow keys' step, where it is not the measure's. */
  step?: number;
  text?: string;
  onFocus?(): void;
  onBlur?(): void;
}

export function Slider({ label, value, range, measure, onChange, origin, step, text, onFocus, onBlur }: SliderProps) {
  const [low, high] = range;
  const share = (at: number) => `${(100 * Math.min(1, Math.max(0, (at - low) / (high - low || 1)))).toFixed(2)}%`;
  const from = origin ?? Math.min(high, Math.max(low, 0));
  const clamp = (at: number) => Math.min(high, Math.max(low, at));

  const onKeyDown = (event: TargetedKeyboardEvent<HTMLInputElement>) => {
    const size = step ?? keyStep(measure, event);
    const next = byKey(event, {
      ArrowRight: value + size,
      ArrowUp: value + size,
      ArrowLeft: value - size,
      ArrowDown: value - size,
      PageUp: value + 10 * size,
      PageDown: value - 10 * size,
      Home: low,
      End: high,
    });
    if (next === undefined || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    onChange(clamp(next));
  };

  return (
    <input
      class="slider"
      type="range"
      min={low}
      max={high}
      step="any"
      aria-label={label}
      aria-valuetext={text ?? formatWithUnit(value, measure, look.value)}
      value={value}
      style={{ "--from": share(Math.min(from, value)), "--to": share(Math.max(from, value)) }}
      onInput={(event) => onChange(event.currentTarget.valueAsNumber)}
      onKeyDown={onKeyDown}
      onFocus={onFocus}
      onBlur={onBlur}
    />
  );
}
