// Which curve is which joint, with the values at the cursor.

import { useComputed } from "@preact/signals";
import { useMemo } from "preact/hooks";
import { highlight } from "../formula/marks.ts";
import { time } from "../state.ts";
import { seriesClass } from "./plot.tsx";
import { interpolate } from "./scale.ts";

export interface Entry {
  joint: number;
  name: string;
  values: number[];
  /** A value with its unit, always as wide as the others. */
  write(value: number): string;
}

export function Legend(props: { times: number[]; entries: Entry[]; hidden: ReadonlySet<number>; toggle: (joint: number) => void }) {
  return (
    <ul class="legend" aria-label="Joints in the plots">
      {props.entries.map((entry) => (
        <li key={entry.joint}>
          <button
            type="button"
            aria-pressed={!props.hidden.has(entry.joint)}
            title={props.hidden.has(entry.joint) ? "Show the curve" : "Hide the curve"}
            onClick={() => props.toggle(entry.joint)}
            onPointerEnter={() => highlight([entry.joint])}
            onPointerLeave={() => highlight([])}
            onFocus={() => highlight([entry.joint])}
            onBlur={() => highlight([])}
          >
            <svg width="28" height="10" aria-hidden="true">
              <path class={`curve ${seriesClass(entry.joint)}`} d="M1 5H27" />
            </svg>
            <span class="name">{entry.name}</span>
            <Value times={props.times} entry={entry} />
          </button>
        </li>
      ))}
    </ul>
  );
}

function Value({ times, entry }: { times: number[]; entry: Entry }) {
  const at = useMemo(() => ({ times, entry }), [times, entry]);
  const text = useComputed(() => at.entry.write(interpolate(at.times, at.entry.values, time.value)));
  return <span class="value">{text}</span>;
}
