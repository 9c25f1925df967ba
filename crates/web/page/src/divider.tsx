// Between scene and panels: dragged, or moved by the arrow keys.

import type { TargetedKeyboardEvent, TargetedPointerEvent } from "preact";
import { useRef } from "preact/hooks";
import { side } from "./shell.ts";
import { byKey } from "./widgets/keys.ts";

const NARROWEST = 320;
/** What the scene keeps. */
const SCENE = 300;

export function Divider() {
  const divider = useRef<HTMLDivElement>(null);
  const widest = () => Math.max(NARROWEST, (divider.current?.parentElement?.clientWidth ?? 1280) - SCENE);
  const present = () => divider.current?.nextElementSibling?.clientWidth ?? 460;
  const set = (width: number) => (side.value = Math.round(Math.min(widest(), Math.max(NARROWEST, width))));

  const onKeyDown = (event: TargetedKeyboardEvent<HTMLDivElement>) => {
    const size = event.shiftKey ? 64 : 16;
    const to = byKey(event, { ArrowLeft: present() + size, ArrowRight: present() - size, Home: widest(), End: NARROWEST });
    if (to === undefined) return;
    event.preventDefault();
    set(to);
  };
  const onPointerDown = (event: TargetedPointerEvent<HTMLDivElement>) => {
    event.preventDefault();
    event.currentTarget.setPointerCapture(event.pointerId);
  };
  const onPointerMove = (event: TargetedPointerEvent<HTMLDivElement>) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const right = event.currentTarget.parentElement?.getBoundingClientRect().right ?? 0;
    set(right - event.clientX - event.currentTarget.offsetWidth / 2);
  };
  return (
    <div
      ref={divider}
      class="divider"
      role="separator"
      aria-orientation="vertical"
      aria-label="Width of the panels"
      aria-valuemin={NARROWEST}
      aria-valuemax={1200}
      aria-valuenow={side.value ?? 460}
      tabIndex={0}
      title="Drag, or use the arrow keys; double-click for the first width"
      onKeyDown={onKeyDown}
      onPointerDown={onPointerDown}
      onPointerMove={onPointerMove}
      onDblClick={() => (side.value = null)}
    />
  );
}
