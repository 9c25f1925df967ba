// What a pointer does in the picture: it takes a handle, a joint, a ghost, or else turns the view. Two fingers move and
// zoom; a wheel zooms to where it is.

import { ghost, highlighted, move, scene } from "../state.ts";
import { meet, type Met } from "./body.ts";
import { shown, type Shown, singularAt } from "./ghosts.ts";
import { type Drag, dragging, type Gizmo } from "./gizmo.ts";
import { measures } from "./measure.ts";
import type { Stage } from "./stage.ts";
import { takeJoint } from "./turning.ts";

/** Pixels that a click may slip. */
const SLIP = 5;
const SPEED = 0.0075;

interface Finger {
  x: number;
  y: number;
}

interface Under {
  met: Met | null;
  ghost: Shown | null;
}

export function addPointer(stage: Stage, gizmo: Gizmo): void {
  const { canvas, orbit } = stage;
  const fingers = new Map<number, Finger>();
  let drag: Drag | null = null;
  let began: Finger | null = null;
  let slipped = false;
  let isPan = false;
  let hovering = 0;
  let last: PointerEvent | null = null;

  const place = (event: MouseEvent): Finger => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  const under = ({ x, y }: Finger, slack: number): Under => {
    const now = scene.peek();
    if (!now) return { met: null, ghost: null };
    const ray = orbit.ray(x, y);
    const wide = slack * orbit.pixelAt(orbit.view.target);
    const met = meet(now, now.unit, ray, wide);
    let nearest = met?.along ?? Number.POSITIVE_INFINITY;
    let found: Shown | null = null;
    for (const one of shown.peek()) {
      const there = meet(one.ghost, now.unit, ray, 0);
      if (there && there.along < nearest - 0.5 * now.unit) [nearest, found] = [there.along, one];
    }
    return { met: found ? null : met, ghost: found };
  };

  const point = ({ met, ghost: one }: Under): void => {
    const index = one?.kind === "solution" ? one.index : null;
    if (ghost.peek() !== index) ghost.value = index;
    const singularIndex = one?.kind === "singular" ? one.index : null;
    if (singularAt.peek() !== singularIndex) singularAt.value = singularIndex;
    const joint = met ? (met.joint ?? (met.link ? jointBefore(met.link) : null)) : null;
    const before = highlighted.peek();
    const isSame = joint === null ? before.size === 0 : before.size === 1 && before.has(joint);
    if (!isSame) highlighted.value = joint === null ? new Set() : new Set([joint]);
  };

  const clear = (): void => {
    gizmo.leave();
    point({ met: null, ghost: null });
    canvas.style.cursor = "";
  };

  // Once a frame is often enough.
  const hover = (event: PointerEvent): void => {
    last = event;
    if (hovering) return;
    hovering = requestAnimationFrame(() => {
      hovering = 0;
      if (!last || fingers.size > 0) return;
      const at = place(last);
      if (gizmo.hover(at.x, at.y)) {
        point({ met: null, ghost: null });
        canvas.style.cursor = "grab";
        return;
      }
      const found = under(at, 2);
      point(found);
      canvas.style.cursor = found.ghost ? "pointer" : found.met?.symbol != null ? "grab" : "";
    });
  };

  const letGo = (): void => {
    drag?.end();
    drag = null;
    dragging.value = false;
  };

  const down = (event: PointerEvent): void => {
    const at = place(event);
    fingers.set(event.pointerId, at);
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size > 1) {
      letGo();
      slipped = true;
      return;
    }
    [began, slipped] = [at, false];
    isPan = event.button !== 0 || event.shiftKey;
    if (isPan) return;
    const slack = event.pointerType === "mouse" ? 9 : 20;
    drag = gizmo.grab(at.x, at.y, slack);
    if (drag) return;
    const { met } = under(at, event.pointerType === "mouse" ? 2 : 8);
    const symbol = met?.symbol != null ? scene.peek()?.symbols[met.symbol] : undefined;
    if (symbol) drag = takeJoint(stage, symbol, at.x, at.y);
  };

  const moved = (event: PointerEvent): void => {
    const before = fingers.get(event.pointerId);
    if (!before) return hover(event);
    const at = place(event);
    if (began && Math.hypot(at.x - began.x, at.y - began.y) > SLIP) slipped = true;
    const [dx, dy] = [at.x - before.x, at.y - before.y];
    if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) pinch(before, at, other);
    } else if (drag) {
      if (!slipped) return;
      dragging.value = true;
      drag.move(at.x, at.y, event.ctrlKey || event.metaKey || event.shiftKey);
    } else if (fingers.size === 1 && slipped) {
      if (isPan) orbit.pan(dx, dy);
      else orbit.turn(dx * SPEED, dy * SPEED);
      stage.viewChanged();
    }
    fingers.set(event.pointerId, at);
  };

  const pinch = (before: Finger, at: Finger, other: Finger): void => {
    const [was, is] = [Math.hypot(before.x - other.x, before.y - other.y), Math.hypot(at.x - other.x, at.y - other.y)];
    orbit.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
    if (was > 1 && is > 1) orbit.zoom(was / is, (at.x + other.x) / 2, (at.y + other.y) / 2);
    stage.viewChanged();
  };

  const up = (event: PointerEvent): void => {
    const at = fingers.get(event.pointerId);
    fingers.delete(event.pointerId);
    letGo();
    if (!at || slipped || event.type === "pointercancel") return;
    if (stage.onPick(at.x, at.y)) return clear();
    const { ghost: one } = under(at, 0);
    if (one) move(one.q);
    clear();
  };

  const wheel = (event: WheelEvent): void => {
    event.preventDefault();
    const { x, y } = place(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    orbit.zoom(Math.exp(Math.max(-120, Math.min(120, event.deltaY * lines)) * 0.0016), x, y);
    stage.viewChanged();
  };

  measures.joints = () =>
    (scene.peek()?.symbols ?? []).map(({ centre }) => {
      const { x, y } = orbit.project(centre);
      return [x, y];
    });

  const off = new AbortController();
  const listen = { signal: off.signal };
  canvas.addEventListener("pointerdown", down, listen);
  canvas.addEventListener("pointermove", moved, listen);
  canvas.addEventListener("pointerup", up, listen);
  canvas.addEventListener("pointercancel", up, listen);
  canvas.addEventListener("pointerleave", clear, listen);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault(), listen);
  canvas.addEventListener("wheel", wheel, { ...listen, passive: false });
  stage.onEnd(() => {
    off.abort();
    cancelAnimationFrame(hovering);
  });
}

/** The joint that carries a link: that of the symbol before it. */
function jointBefore(link: number): number | null {
  return scene.peek()?.symbols[link - 1]?.joint ?? null;
}
