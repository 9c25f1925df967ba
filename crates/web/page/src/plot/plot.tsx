// A plot over time: curves, events, and a cursor that is dragged or moved by keys.

import { useComputed, useSignalEffect } from "@preact/signals";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Path } from "../engine/types.ts";
import { highlight } from "../formula/marks.ts";
import { signed } from "../formula/number.ts";
import { highlighted, playing, time } from "../state.ts";
import { exactScale, interpolate, locate, scale } from "./scale.ts";

export interface Series {
  name: string;
  /** The joint that it is about; its number also picks colour and dashes. */
  joint: number | null;
  /** Which colour, where it is about none. */
  colour?: number;
  values: number[];
}

export type PlotEvent = Path["events"][number];

interface Props {
  title: string;
  unit: string;
  degrees?: boolean;
  /** The axis begins at 0. */
  fromZero?: boolean;
  times: number[];
  series: Series[];
  events: PlotEvent[];
}

const HEIGHT = 148;
const MARGIN = { left: 46, right: 10, top: 12, bottom: 20 };

export function Plot(props: Props) {
  const { times, series, events } = props;
  const box = useRef<HTMLDivElement>(null);
  const cursor = useRef<SVGGElement>(null);
  const width = useWidth(box);
  const end = times.at(-1) ?? 0;

  const { x, y, across, up } = useMemo(() => {
    const all = series.flatMap((s) => s.values).filter(Number.isFinite);
    const low = props.fromZero ? 0 : Math.min(...all);
    const up = scale(all.length ? low : 0, all.length ? Math.max(...all, low) : 1, 4, props.degrees);
    const across = exactScale(0, end || 1, Math.max(2, Math.floor(width / 90)));
    const [w, h] = [width - MARGIN.left - MARGIN.right, HEIGHT - MARGIN.top - MARGIN.bottom];
    const x = (t: number) => MARGIN.left + (t / (across.max || 1)) * w;
    const y = (v: number) => MARGIN.top + h - ((v - up.min) / (up.max - up.min)) * h;
    return { x, y, across, up };
  }, [series, times, width, props.fromZero, props.degrees]);

  // Only the cursor moves with time; the curves stay.
  useSignalEffect(() => {
    const group = cursor.current;
    if (!group) return;
    const now = Math.min(time.value, end);
    const at = x(now);
    group.querySelector("line")!.setAttribute("transform", `translate(${at} 0)`);
    group.querySelectorAll("circle").forEach((dot, k) => {
      const value = interpolate(times, series[k]!.values, now);
      dot.setAttribute("transform", `translate(${at} ${y(value)})`);
    });
    box.current?.setAttribute("aria-valuenow", now.toFixed(3));
    box.current?.setAttribute("aria-valuetext", spoken(props, now));
  });

  const scrub = (event: PointerEvent) => {
    const left = box.current!.getBoundingClientRect().left;
    const part = (event.clientX - left - MARGIN.left) / (width - MARGIN.left - MARGIN.right);
    seek(part * end, end);
  };
  const lit = useComputed(() => series.map((s) => s.joint !== null && highlighted.value.has(s.joint)));
  const anyLit = lit.value.some(Boolean);
  return (
    <figure class="plot">
      <figcaption>
        {props.title} <span class="unit">({props.unit})</span>
      </figcaption>
      <div
        ref={box}
        class="plot-box"
        tabIndex={0}
        role="slider"
        aria-label={`Time, on the plot of ${props.title.toLowerCase()}`}
        aria-valuemin={0}
        aria-valuemax={Number(end.toFixed(3))}
        onPointerDown={(event) => {
          if (event.button !== 0) return;
          event.currentTarget.setPointerCapture(event.pointerId);
          playing.value = false;
          scrub(event);
        }}
        onPointerMove={(event) => {
          if (event.currentTarget.hasPointerCapture(event.pointerId)) scrub(event);
        }}
        onKeyDown={(event) => timeKeys(event, times, events)}
      >
        <svg width={width} height={HEIGHT} viewBox={`0 0 ${width} ${HEIGHT}`} aria-hidden="true" focusable="false">
          {up.ticks.map((tick) => (
            <g key={tick} class={Math.abs(tick) < 1e-12 ? "grid zero" : "grid"}>
              <line x1={MARGIN.left} x2={width - MARGIN.right} y1={y(tick)} y2={y(tick)} />
              <text x={MARGIN.left - 6} y={y(tick)} dy="0.32em" text-anchor="end">
                {signed(tick.toFixed(up.places).replace(/^-(?=0(?:\.0*)?$)/, ""))}
              </text>
            </g>
          ))}
          {across.ticks.map((tick, k) => (
            <g key={tick} class="grid">
              <line x1={x(tick)} x2={x(tick)} y1={HEIGHT - MARGIN.bottom} y2={HEIGHT - MARGIN.bottom + 4} />
              <text x={x(tick)} y={HEIGHT - 5} text-anchor={k === 0 ? "start" : x(tick) > width - 30 ? "end" : "middle"}>
                {tick.toFixed(across.places)} s
              </text>
            </g>
          ))}
          {events.map((event, k) => (
            <g key={k} class={`event event-${event.kind}`} transform={`translate(${x(event.t)} 0)`}>
              <line y1={MARGIN.top} y2={HEIGHT - MARGIN.bottom} />
              <EventSign kind={event.kind} y={MARGIN.top - 4} />
              <title>{event.words}</title>
            </g>
          ))}
          {series.map((one, k) => (
            <path
              key={k}
              class={`curve ${seriesClass(one.joint ?? one.colour ?? null)}${anyLit ? (lit.value[k] ? " lit" : " faint") : ""}`}
              d={curve(times, one.values, x, y)}
              onPointerEnter={() => one.joint !== null && highlight([one.joint])}
              onPointerLeave={() => highlight([])}
            />
          ))}
          <g ref={cursor} class="cursor">
            <line y1={MARGIN.top} y2={HEIGHT - MARGIN.bottom} />
            {series.map((one, k) => (
              <circle key={k} r={3} class={seriesClass(one.joint ?? one.colour ?? null)} />
            ))}
          </g>
        </svg>
      </div>
    </figure>
  );
}

/** Colour and dashes of a joint; what is about no joint is plain. */
export function seriesClass(joint: number | null): string {
  return joint === null ? "series" : `series series-${joint % 8}`;
}

/** Another shape for each kind, so that colour alone does not have to tell them apart. */
export function EventSign({ kind, y }: { kind: PlotEvent["kind"]; y: number }) {
  switch (kind) {
    case "singular":
      return <path d={`M0 ${y - 5}l5 5-5 5-5-5Z`} />;
    case "limit":
      return <path d={`M-5 ${y - 4}h10v3h-10Z`} />;
    // Where the path ends before it should, and all that is rarer.
    default:
      return <circle cy={y} r={3.5} />;
  }
}

/** The time goes there, and no further than the path. */
export function seek(to: number, end: number): void {
  playing.value = false;
  time.value = Math.min(end, Math.max(0, to));
}

/** Arrow keys go by a hundredth, page keys by a tenth, with shift from event to event. */
function timeKeys(event: KeyboardEvent, times: number[], events: PlotEvent[]): void {
  const end = times.at(-1) ?? 0;
  const now = time.peek();
  const nextEvent = events.find((e) => e.t > now + 1e-6)?.t ?? end;
  const lastEvent = events.findLast((e) => e.t < now - 1e-6)?.t ?? 0;
  const steps: Record<string, number> = {
    ArrowRight: event.shiftKey ? nextEvent : now + end / 100,
    ArrowUp: now + end / 100,
    ArrowLeft: event.shiftKey ? lastEvent : now - end / 100,
    ArrowDown: now - end / 100,
    PageUp: now + end / 10,
    PageDown: now - end / 10,
    Home: 0,
    End: end,
  };
  const to = steps[event.key];
  if (to === undefined) return;
  event.preventDefault();
  seek(to, end);
}

function spoken({ times, series, unit }: Props, now: number): string {
  const { index } = locate(times, now);
  const values = series.map((s) => `${s.name} ${signed((s.values[index] ?? 0).toFixed(2))}`);
  return `${now.toFixed(2)} s: ${values.join(", ")} ${unit}`;
}

function curve(times: number[], values: number[], x: (t: number) => number, y: (v: number) => number): string {
  let out = "";
  let pen = false;
  values.forEach((value, k) => {
    if (!Number.isFinite(value)) {
      pen = false;
      return;
    }
    out += `${pen ? "L" : "M"}${x(times[k]!).toFixed(1)} ${y(value).toFixed(1)}`;
    pen = true;
  });
  return out;
}

function useWidth(box: { current: HTMLElement | null }): number {
  const [width, setWidth] = useState(320);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => entry && setWidth(Math.max(160, Math.floor(entry.contentRect.width))));
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  return width;
}
