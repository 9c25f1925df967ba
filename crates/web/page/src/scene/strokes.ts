// Lines as wide as they should look, in pixels, with arrowheads and dashes, smooth without multisampling. Where something
// stands before a line it shows through faintly, so that axes inside joints are seen.

import {
  BufferAttribute,
  DoubleSide,
  GreaterDepth,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LessEqualDepth,
  Mesh,
  ShaderMaterial,
  Vector2,
} from "three";
import type { Point } from "../engine/types.ts";
import { add, turned } from "./geometry.ts";
import type { Colour } from "./theme.ts";

/** The size of the picture in pixels of the page, shared by all strokes. */
export const pixels = { value: new Vector2(1, 1) };

const VERTEX = /* glsl */ `
  attribute vec3 from, to;
  attribute vec4 tint, style;
  uniform vec2 pixels;
  varying vec4 vTint;
  varying vec3 vAcross;   // pixels from the middle, half the width, pixels along
  varying float vDash;
  void main() {
    mat4 m = projectionMatrix * viewMatrix;
    vec4 a = m * vec4(from, 1.0), b = m * vec4(to, 1.0);
    // What is behind the eye is cut off.
    const float near = 1e-3;
    if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
    if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
    vec3 p = a.xyz / a.w, q = b.xyz / b.w;
    vec2 s = 0.5 * pixels * p.xy, e = 0.5 * pixels * q.xy;
    float reach = length(e - s);
    vec2 way = reach > 1e-4 ? (e - s) / reach : vec2(1.0, 0.0);
    float width = 0.5 * style.x;
    float head = style.z;
    if (head > 0.0) {
      // A head: a triangle whose tip is at the end, shorter where the line is short.
      head = min(head, 0.8 * reach + 2.0);
      s = e - way * head;
      p.z = mix(q.z, p.z, reach > 1e-4 ? min(1.0, head / reach) : 0.0);
      width = position.x > 0.5 ? 0.0 : 0.38 * head;
    }
    float half_ = width + 1.0;
    vec2 at = mix(s, e, position.x) + half_ * position.y * vec2(-way.y, way.x);
    if (head <= 0.0) at += (position.x - 0.5) * way;
    vAcross = vec3(half_ * position.y, width, position.x * reach);
    vDash = style.y;
    vTint = tint;
    #ifdef HIDDEN
      vTint.a *= style.w;
    #endif
    gl_Position = vec4(2.0 * at / pixels, mix(p.z, q.z, position.x), 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  varying vec4 vTint;
  varying vec3 vAcross;
  varying float vDash;
  void main() {
    float cover = clamp(vAcross.y + 0.5 - abs(vAcross.x), 0.0, 1.0);
    if (vDash > 0.0) {
      float t = mod(vAcross.z, 2.0 * vDash);
      cover *= clamp(min(t, 1.2 * vDash - t) + 0.5, 0.0, 1.0);
    }
    if (cover * vTint.a < 0.01) discard;
    gl_FragColor = vec4(vTint.rgb, vTint.a * cover);
  }`;

export interface Stroke {
  colour: Colour;
  /** Pixels. */
  width?: number;
  /** The length of a dash and of a gap, pixels. */
  dash?: number;
  /** The length of a head at the end, pixels. */
  head?: number;
  /** A head at the beginning as well. */
  both?: boolean;
  alpha?: number;
  /** How much of it is seen through what stands before it. */
  through?: number;
}

const CORNERS = new BufferAttribute(new Float32Array([0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0]), 3);
const FACES = new BufferAttribute(new Uint16Array([0, 2, 1, 1, 2, 3]), 1);
const SIZES = { from: 3, to: 3, tint: 4, style: 4 } as const;

export class Strokes {
  readonly object = new Group();
  #geometry = new InstancedBufferGeometry();
  #rows!: Record<keyof typeof SIZES, InstancedBufferAttribute>;
  #room = 0;
  #count = 0;
  #materials: ShaderMaterial[];

  constructor(order: number, onTop = false, room = 64) {
    this.#geometry.setAttribute("position", CORNERS);
    this.#geometry.setIndex(FACES);
    this.#grow(room);
    const make = (hidden: boolean) =>
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: { pixels },
        defines: hidden ? { HIDDEN: "" } : {},
        transparent: true,
        depthWrite: false,
        depthTest: !onTop,
        depthFunc: hidden ? GreaterDepth : LessEqualDepth,
        side: DoubleSide,
      });
    this.#materials = onTop ? [make(false)] : [make(true), make(false)];
    this.#materials.forEach((made, k) => {
      const mesh = new Mesh(this.#geometry, made);
      mesh.frustumCulled = false;
      mesh.renderOrder = order + 0.1 * k;
      this.object.add(mesh);
    });
    this.end();
  }

  #grow(room: number): void {
    const before = this.#rows;
    if (before) this.#geometry.dispose();
    const make = (name: keyof typeof SIZES) => {
      const attribute = new InstancedBufferAttribute(new Float32Array(SIZES[name] * room), SIZES[name]);
      if (before) attribute.array.set(before[name].array);
      this.#geometry.setAttribute(name, attribute);
      return attribute;
    };
    this.#rows = { from: make("from"), to: make("to"), tint: make("tint"), style: make("style") };
    this.#room = room;
  }

  begin(): void {
    this.#count = 0;
  }

  end(): void {
    this.#geometry.instanceCount = this.#count;
    this.object.visible = this.#count > 0;
    for (const [name, attribute] of Object.entries(this.#rows)) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, SIZES[name as keyof typeof SIZES] * this.#count);
      attribute.needsUpdate = true;
    }
  }

  #push(from: Point, to: Point, stroke: Stroke, head: number): void {
    if (this.#count === this.#room) this.#grow(2 * this.#room);
    const k = this.#count++;
    const { colour } = stroke;
    this.#rows.from.setXYZ(k, from[0], from[1], from[2]);
    this.#rows.to.setXYZ(k, to[0], to[1], to[2]);
    this.#rows.tint.setXYZW(k, colour[0], colour[1], colour[2], stroke.alpha ?? 1);
    this.#rows.style.setXYZW(k, stroke.width ?? 2, head > 0 ? 0 : (stroke.dash ?? 0), head, stroke.through ?? 0.3);
  }

  line(from: Point, to: Point, stroke: Stroke): void {
    this.#push(from, to, stroke, 0);
    if (stroke.head) {
      this.#push(from, to, stroke, stroke.head);
      if (stroke.both) this.#push(to, from, stroke, stroke.head);
    }
  }

  chain(points: Point[], stroke: Stroke): void {
    for (let i = 1; i < points.length; i++) this.#push(points[i - 1], points[i], stroke, 0);
  }

  /** From `centre + start`, turned about the axis; the head at the end. */
  arc(centre: Point, axis: Point, start: Point, angle: number, stroke: Stroke): void {
    const pieces = Math.max(2, Math.ceil(Math.abs(angle) / 0.13));
    const points = Array.from({ length: pieces + 1 }, (_, i) => add(centre, turned(start, axis, (angle * i) / pieces)));
    this.chain(points, stroke);
    if (!stroke.head) return;
    // The head follows the tangent: it points from a little way back.
    const back = Math.min(Math.abs(angle), 0.45) * Math.sign(angle);
    this.#push(add(centre, turned(start, axis, angle - back)), points[pieces], stroke, stroke.head);
  }

  dispose(): void {
    this.#geometry.dispose();
    for (const made of this.#materials) made.dispose();
  }
}
