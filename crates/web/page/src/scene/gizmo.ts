// Handles at the hand: arrows and squares that move it, rings that turn it. They are drawn as strokes of a fixed size in
// pixels and found by their distance in pixels, so that a finger can take them as well as a mouse.

import { signal } from "@preact/signals";
import type { Matrix, Point } from "../engine/types.ts";
import { game } from "../game/game.ts";
import { playing, pose, reach, scene, selected, target } from "../state.ts";
import { add, axisOf, cross, dot, movedPose, nearestOnLine, norm, onPlane, originOf, perpendicular, type Ray, scale, sub } from "./geometry.ts";
import { measures } from "./measure.ts";
import { planeOf, turnOf } from "./planar.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { colours, type Palette } from "./theme.ts";
import { inAngle, inLength } from "./units.ts";

/** What the handles do, and along whose axes. */
export const handles = signal<{ mode: "off" | "move" | "turn"; axes: "base" | "tool" }>({ mode: "move", axes: "base" });

/** Whether something is being dragged: what takes long waits until it is let go. */
export const dragging = signal(false);

type Part = { kind: "axis" | "plane" | "ring"; k: 0 | 1 | 2 };
const AXES = [0, 1, 2] as const;
const NAMES = ["x", "y", "z"] as const;

/** Pixels. */
const ARROW = 88;
const INNER = 16;
const SQUARE: [number, number] = [24, 40];
const RING = 74;
const PIECES = 48;
/** With a key held, steps are round: metres, radians. */
const ROUND = { length: 0.01, angle: Math.PI / 36 };

export interface Drag {
  move(x: number, y: number, isRound: boolean): void;
  end(): void;
}

interface Place {
  at: Point;
  axes: [Point, Point, Point];
  /** Metres a pixel. */
  pixel: number;
}

export class Gizmo {
  #stage: Stage;
  #strokes = new Strokes(30, true, 256);
  #hovered = signal<Part | null>(null);
  #dragged = signal<Part | null>(null);
  #words = signal("");

  constructor(stage: Stage) {
    this.#stage = stage;
    stage.add(this.#strokes.object);
    stage.onEnd(() => this.#strokes.dispose());
    const redraw = () => this.#draw();
    stage.watch(
      "gizmo",
      () => [pose.value, target.value, handles.value, playing.value, selected.value, game.value, colours.value, this.#hovered.value, this.#dragged.value, this.#words.value],
      redraw,
    );
    stage.onView.add(redraw);
    measures.handles = () => this.#spots();
  }

  /** Where the handles are and along what; nothing while there are none. */
  #place(): Place | null {
    const frame = target.value ?? pose.value;
    if (!frame || handles.value.mode === "off" || playing.value || selected.value !== null || game.value !== null) return null;
    const at = originOf(frame);
    const isTool = handles.value.axes === "tool";
    const axes: Place["axes"] = isTool ? [axisOf(frame, 0), axisOf(frame, 1), axisOf(frame, 2)] : [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    // In a small picture handles are smaller.
    const { orbit } = this.#stage;
    const size = Math.min(1, Math.max(0.62, Math.min(orbit.width, orbit.height) / 600));
    return { at, axes, pixel: size * orbit.pixelAt(at) };
  }

  /** Those that an arm can follow: one in a plane moves in it and turns about its normal. */
  #parts({ axes }: Place): Part[] {
    const now = scene.peek();
    const isAlong = (normal: Point, k: number) => Math.abs(dot(normal, axes[k])) > 0.999;
    const isAcross = (normal: Point, k: number) => Math.abs(dot(normal, axes[k])) < 0.05;
    if (handles.value.mode === "turn") {
      const about = now && turnOf(now);
      const rings = about ? AXES.filter((k) => isAlong(about, k)) : [];
      return (rings.length > 0 ? rings : AXES).map((k) => ({ kind: "ring", k }));
    }
    const normal = now && planeOf(now);
    const isFlat = normal !== null && AXES.some((k) => isAlong(normal, k));
    const [ways, planes] = isFlat ? [AXES.filter((k) => isAcross(normal, k)), AXES.filter((k) => isAlong(normal, k))] : [AXES, AXES];
    return [...ways.map((k): Part => ({ kind: "axis", k })), ...planes.map((k): Part => ({ kind: "plane", k }))];
  }

  /** A part as chains of points. */
  #shape({ kind, k }: Part, { at, axes, pixel }: Place): Point[] {
    if (kind === "axis") return [add(at, axes[k], INNER * pixel), add(at, axes[k], ARROW * pixel)];
    const [u, v] = [axes[(k + 1) % 3], axes[(k + 2) % 3]];
    if (kind === "plane") {
      const corner = (a: number, b: number) => add(add(at, u, a * pixel), v, b * pixel);
      const [low, high] = SQUARE;
      return [corner(low, low), corner(high, low), corner(high, high), corner(low, high), corner(low, low)];
    }
    return Array.from({ length: PIECES + 1 }, (_, i) => {
      const angle = (2 * Math.PI * i) / PIECES;
      return add(add(at, u, RING * pixel * Math.cos(angle)), v, RING * pixel * Math.sin(angle));
    });
  }

  #draw(): void {
    const place = this.#place();
    this.#strokes.begin();
    if (place) for (const part of this.#parts(place)) this.#drawPart(part, place, colours.value);
    this.#strokes.end();
    const isShown = place && this.#dragged.value && this.#words.value;
    this.#stage.labels.set("gizmo", isShown ? [{ text: this.#words.value, at: place.at, toward: scale(this.#stage.orbit.up, -1), colour: colours.value.text, size: 13, plate: true, rank: 50 }] : []);
  }

  #drawPart(part: Part, place: Place, palette: Palette): void {
    const dragged = this.#dragged.value;
    if (dragged && (dragged.kind !== part.kind || dragged.k !== part.k)) return;
    const active = dragged ?? this.#hovered.value;
    const isActive = active?.kind === part.kind && active.k === part.k;
    const { back } = this.#stage.orbit;
    const colour = isActive ? palette.glow : palette[NAMES[part.k]];
    const points = this.#shape(part, place);
    if (part.kind === "axis") {
      // Seen from its end an arrow is of no use.
      const faint = Math.abs(dot(place.axes[part.k], back)) > 0.985 ? 0.25 : 1;
      this.#strokes.line(points[0], points[1], { colour, width: isActive ? 5 : 3.5, head: 17, alpha: faint });
    } else if (part.kind === "plane") {
      const faint = Math.abs(dot(place.axes[part.k], back)) < 0.12 ? 0 : 0.85;
      this.#strokes.chain(points, { colour, width: isActive ? 4 : 2, alpha: faint });
    } else {
      for (let i = 0; i < PIECES; i++) {
        const isFront = dot(sub(points[i], place.at), back) > -0.05 * RING * place.pixel;
        this.#strokes.line(points[i], points[i + 1], { colour, width: isActive ? 5 : 3, alpha: isFront || isActive ? 1 : 0.22 });
      }
    }
  }

  /** The part at a place of the picture. */
  #find(x: number, y: number, slack: number): Part | null {
    const place = this.#place();
    if (!place) return null;
    const { orbit } = this.#stage;
    let best: Part | null = null;
    let least = slack;
    for (const part of this.#parts(place)) {
      const faces = Math.abs(dot(place.axes[part.k], orbit.back));
      if ((part.kind === "axis" && faces > 0.985) || (part.kind === "plane" && faces < 0.12)) continue;
      const points = this.#shape(part, place);
      const spots = points.map((p) => orbit.project(p));
      for (let i = 1; i < spots.length; i++) {
        if (part.kind === "ring" && dot(sub(points[i], place.at), orbit.back) < -0.05 * RING * place.pixel) continue;
        const away = toSegment(x, y, spots[i - 1], spots[i]);
        if (away < least) [least, best] = [away, part];
      }
      if (part.kind === "plane" && inside(x, y, spots)) [least, best] = [0, part];
    }
    return best;
  }

  /** Middles of the handles in the picture, by their names. */
  #spots(): Record<string, [number, number]> {
    const place = this.#place();
    const spots: Record<string, [number, number]> = {};
    if (!place) return spots;
    for (const part of this.#parts(place)) {
      const points = this.#shape(part, place);
      const { back } = this.#stage.orbit;
      // The back of a ring cannot be taken.
      const front = () => points.reduce((one, other) => (dot(other, back) > dot(one, back) ? other : one));
      const p = part.kind === "ring" ? front() : scale(add(points[0], points[part.kind === "axis" ? 1 : 2]), 0.5);
      const { x, y } = this.#stage.orbit.project(p);
      spots[`${part.kind} ${NAMES[part.k]}`] = [x, y];
    }
    return spots;
  }

  hover(x: number, y: number): boolean {
    const found = this.#find(x, y, 8);
    const before = this.#hovered.peek();
    if (found?.kind !== before?.kind || found?.k !== before?.k) this.#hovered.value = found;
    return found !== null;
  }

  leave(): void {
    this.#hovered.value = null;
  }

  grab(x: number, y: number, slack: number): Drag | null {
    const part = this.#find(x, y, slack);
    const place = this.#place();
    const start = target.value ?? pose.value;
    if (!part || !place || !start) return null;
    this.#dragged.value = part;
    const end = () => {
      this.#dragged.value = null;
      this.#hovered.value = null;
      this.#words.value = "";
    };
    if (part.kind === "ring") return { move: this.#turning(part, place, start, x, y), end };
    return { move: this.#moving(part, place, start, x, y), end };
  }

  #moving(part: Part, place: Place, start: Matrix, x: number, y: number): Drag["move"] {
    const { orbit } = this.#stage;
    const axis = place.axes[part.k];
    const at = (ray: Ray): Point | null => (part.kind === "axis" ? scale(axis, nearestOnLine(ray, place.at, axis)) : onPlane(ray, place.at, axis));
    const first = at(orbit.ray(x, y));
    return (nextX, nextY, isRound) => {
      const next = at(orbit.ray(nextX, nextY));
      if (!first || !next) return;
      let by = sub(next, first);
      if (isRound) {
        const steps = place.axes.map((e) => Math.round(dot(by, e) / ROUND.length) * ROUND.length);
        by = place.axes.reduce<Point>((sum, e, k) => add(sum, e, steps[k]), [0, 0, 0]);
      }
      const ways = part.kind === "axis" ? [part.k] : AXES.filter((k) => k !== part.k);
      this.#words.value = ways.map((k) => `Δ${NAMES[k]} ${inLength(dot(by, place.axes[k]))}`).join("  ");
      reach(movedPose(start, axis, 0, by));
    };
  }

  #turning(part: Part, place: Place, start: Matrix, x: number, y: number): Drag["move"] {
    const { orbit } = this.#stage;
    const axis = place.axes[part.k];
    const isFlat = Math.abs(dot(axis, orbit.back)) < 0.2;
    const u = perpendicular(axis);
    const v = cross(axis, u);
    const angleAt = (px: number, py: number): number | null => {
      const p = onPlane(orbit.ray(px, py), place.at, axis);
      if (!p || norm(sub(p, place.at)) < 1e-9) return null;
      const w = sub(p, place.at);
      return Math.atan2(dot(w, v), dot(w, u));
    };
    // A ring seen from its edge turns with the way along it.
    const tangent = cross(axis, orbit.back);
    const centre = orbit.project(place.at);
    const ahead = orbit.project(add(place.at, tangent, RING * place.pixel));
    const way = { x: ahead.x - centre.x, y: ahead.y - centre.y };
    const square = Math.max(1, way.x * way.x + way.y * way.y);
    let [lastX, lastY, last] = [x, y, angleAt(x, y)];
    let total = 0;
    return (nextX, nextY, isRound) => {
      const next = angleAt(nextX, nextY);
      if (isFlat || next === null || last === null) total += ((nextX - lastX) * way.x + (nextY - lastY) * way.y) / square;
      else total += Math.atan2(Math.sin(next - last), Math.cos(next - last));
      [lastX, lastY, last] = [nextX, nextY, next];
      const angle = isRound ? Math.round(total / ROUND.angle) * ROUND.angle : total;
      this.#words.value = `${inAngle(angle)} about ${NAMES[part.k]}`;
      reach(movedPose(start, axis, angle, [0, 0, 0]));
    };
  }
}

interface Spot {
  x: number;
  y: number;
}

function toSegment(x: number, y: number, a: Spot, b: Spot): number {
  const [vx, vy] = [b.x - a.x, b.y - a.y];
  const t = Math.min(1, Math.max(0, ((x - a.x) * vx + (y - a.y) * vy) / Math.max(1e-9, vx * vx + vy * vy)));
  return Math.hypot(x - a.x - t * vx, y - a.y - t * vy);
}

function inside(x: number, y: number, corners: Spot[]): boolean {
  let isIn = false;
  for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
    const [a, b] = [corners[i], corners[j]];
    if (a.y > y !== b.y > y && x < a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y)) isIn = !isIn;
  }
  return isIn;
}
