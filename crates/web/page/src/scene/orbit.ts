// From where the arm is seen: angles about a point, a distance, and how they become the matrices of a camera. Looking
// straight down is nothing special here, since the horizon comes from the azimuth.

import { Camera } from "three";
import type { Point } from "../engine/types.ts";
import { add, dot, type Ray, scale, sub, unit } from "./geometry.ts";

export interface View {
  azimuth: number;
  elevation: number;
  distance: number;
  target: Point;
}

/** Half of the angle of view across the smaller side. */
const HALF_ANGLE = 0.27;
const RIGHT_ANGLE = Math.PI / 2;

/** Azimuth and elevation of the named views: x points forward and y to the left (REP 103). */
export const FACES = {
  front: [0, 0],
  right: [-RIGHT_ANGLE, 0],
  back: [Math.PI, 0],
  left: [RIGHT_ANGLE, 0],
  top: [-RIGHT_ANGLE, RIGHT_ANGLE],
  bottom: [-RIGHT_ANGLE, -RIGHT_ANGLE],
  corner: [-0.95, 0.36],
} as const satisfies Record<string, readonly [azimuth: number, elevation: number]>;
export type Face = keyof typeof FACES;

/** To the right and up in the picture, and from it to the eye. */
export function directions(azimuth: number, elevation: number): { right: Point; up: Point; back: Point } {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], back: [ce * ca, ce * sa, se] };
}

export class Orbit {
  readonly camera = new Camera();
  view: View = { azimuth: FACES.corner[0], elevation: FACES.corner[1], distance: 4, target: [0, 0, 0.4] };
  perspective = true;
  /** Whether somebody has chosen this view: what fits itself leaves it alone then. */
  isChosen = false;
  width = 1;
  height = 1;
  #right: Point = [1, 0, 0];
  #up: Point = [0, 0, 1];
  #back: Point = [0, -1, 0];
  #eye: Point = [0, 0, 0];
  #goal: { from: View; to: View; begun: number; lasts: number } | null = null;

  constructor() {
    this.camera.matrixAutoUpdate = false;
  }

  /** Half the height of what is seen at the target. */
  get #half(): number {
    return this.view.distance * Math.tan(HALF_ANGLE) * Math.max(1, this.height / this.width);
  }

  /** Metres that one pixel covers at a point. */
  pixelAt(at: Point): number {
    const depth = this.perspective ? Math.max(1e-6, dot(sub(this.#eye, at), this.#back)) / this.view.distance : 1;
    return (2 * this.#half * depth) / this.height;
  }

  get right(): Point {
    return this.#right;
  }
  get up(): Point {
    return this.#up;
  }
  /** From the picture to the eye. */
  get back(): Point {
    return this.#back;
  }

  /** Brings the camera to where the view says. */
  apply(): void {
    const { azimuth, elevation, distance, target } = this.view;
    const { right, up, back } = directions(azimuth, elevation);
    const eye = add(target, back, distance);
    [this.#right, this.#up, this.#back, this.#eye] = [right, up, back, eye];
    const { camera } = this;
      camera.matrix.set(
      right[0], up[0], back[0], eye[0],
      right[1], up[1], back[1], eye[1],
      right[2], up[2], back[2], eye[2],
      0, 0, 0, 1,
    );
    camera.matrixWorld.copy(camera.matrix);
    camera.matrixWorldInverse.copy(camera.matrix).invert();
    const half = this.#half;
    const wide = (half * this.width) / this.height;
    const [near, far] = [distance / 40, distance * 30];
    if (this.perspective) {
      const k = near / distance;
      camera.projectionMatrix.makePerspective(-wide * k, wide * k, half * k, -half * k, near, far);
    } else {
      camera.projectionMatrix.makeOrthographic(-wide, wide, half, -half, -far, far);
    }
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  }

  /** A point in the picture, pixels from its upper left corner, and whether it is before the eye. */
  project(p: Point): { x: number; y: number; before: boolean } {
    const v = sub(p, this.view.target);
    const depth = this.view.distance - dot(v, this.#back);
    const k = (this.height / 2 / this.#half) * (this.perspective ? this.view.distance / Math.max(1e-6, depth) : 1);
    return {
      x: this.width / 2 + k * dot(v, this.#right),
      y: this.height / 2 - k * dot(v, this.#up),
      before: !this.perspective || depth > this.view.distance / 40,
    };
  }

  /** The line of sight through a point of the picture. */
  ray(x: number, y: number): Ray {
    const k = (2 * this.#half) / this.height;
    const offset = add(scale(this.#right, k * (x - this.width / 2)), this.#up, k * (this.height / 2 - y));
    const at = add(this.view.target, offset);
    if (this.perspective) return { from: this.#eye, along: unit(sub(at, this.#eye)) };
    return { from: add(at, this.#back, 10 * this.view.distance), along: scale(this.#back, -1) };
  }

  turn(dx: number, dy: number): void {
    this.isChosen = true;
    this.#goal = null;
    const { azimuth, elevation } = this.view;
    const limited = Math.min(RIGHT_ANGLE, Math.max(-RIGHT_ANGLE, elevation + dy));
    this.view = { ...this.view, azimuth: azimuth - dx, elevation: limited };
  }

  /** By pixels. */
  pan(dx: number, dy: number): void {
    this.isChosen = true;
    this.#goal = null;
    const k = (2 * this.#half) / this.height;
    this.view = { ...this.view, target: add(add(this.view.target, this.#right, -dx * k), this.#up, dy * k) };
  }

  /** Nearer or farther; the point of the target's plane under (x, y) stays where it is. */
  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    this.isChosen = true;
    this.#goal = null;
    const distance = Math.min(500, Math.max(0.02, this.view.distance * factor));
    const k = ((2 * this.#half) / this.height) * (1 - distance / this.view.distance);
    const shift = add(scale(this.#right, k * (x - this.width / 2)), this.#up, k * (this.height / 2 - y));
    this.view = { ...this.view, distance, target: add(this.view.target, shift) };
  }

  /** Goes to where points fill the picture within its edges (pixels), seen from the same side. */
  frame(points: Point[], edges: { top: number; right: number; bottom: number; left: number }, lasts: number): void {
    const to = this.#goal?.to ?? this.view;
    const { right, up, back } = directions(to.azimuth, to.elevation);
    const seen = points.map((p) => ({ x: dot(p, right), y: dot(p, up), z: dot(p, back) }));
    const depths = seen.map(({ z }) => z);
    const middle = (Math.min(...depths) + Math.max(...depths)) / 2;
    // What is seen at the distance 1: half the height, half the width.
    const half = Math.tan(HALF_ANGLE) * Math.max(1, this.height / this.width);
    const wide = (half * this.width) / this.height;
    // A point is seen if −low (D − z) ≤ x − x₀ ≤ high (D − z): the distance D and the place x₀ where that is so for all.
    const range = (key: "x" | "y", low: number, high: number) => {
      const most = Math.max(...seen.map((p) => p[key] + (this.perspective ? high * (p.z - middle) : 0)));
      const least = Math.min(...seen.map((p) => p[key] - (this.perspective ? low * (p.z - middle) : 0)));
      return { distance: (most - least) / (low + high), at: (distance: number) => (most - high * distance + least + low * distance) / 2 };
    };
    const across = range("x", wide * (1 - (2 * edges.left) / this.width), wide * (1 - (2 * edges.right) / this.width));
    const upward = range("y", half * (1 - (2 * edges.bottom) / this.height), half * (1 - (2 * edges.top) / this.height));
    const distance = Math.max(1e-3, across.distance, upward.distance);
    const target = add(add(scale(right, across.at(distance)), up, upward.at(distance)), back, middle);
    this.isChosen = false;
    this.go({ azimuth: to.azimuth, elevation: to.elevation, distance, target }, lasts);
  }

  /** Goes to a view, in a moment or at once. */
  go(to: Partial<View>, lasts: number): void {
    const from = this.view;
    const whole = { ...from, ...to };
    const turns = Math.round((from.azimuth - whole.azimuth) / (2 * Math.PI));
    whole.azimuth += 2 * Math.PI * turns;
    if (lasts <= 0) {
      this.#goal = null;
      this.view = whole;
    } else {
      this.#goal = { from, to: whole, begun: performance.now(), lasts };
    }
  }

  /** A step on the way; whether there is more of it. */
  step(now: number): boolean {
    if (!this.#goal) return false;
    const { from, to, begun, lasts } = this.#goal;
    const t = Math.min(1, Math.max(0, (now - begun) / lasts));
    const s = t * t * (3 - 2 * t);
    const mix = (a: number, b: number) => a + s * (b - a);
    this.view = {
      azimuth: mix(from.azimuth, to.azimuth),
      elevation: mix(from.elevation, to.elevation),
      distance: from.distance * (to.distance / from.distance) ** s,
      target: add(scale(from.target, 1 - s), to.target, s),
    };
    if (t >= 1) this.#goal = null;
    return t < 1;
  }
}
