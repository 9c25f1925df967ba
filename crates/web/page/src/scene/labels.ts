// Words in the scene. Each is painted once into a common texture and drawn as a small rectangle that faces the reader, so
// that a picture that is saved has them too. Words that would overlap move aside; the less important give way.

import {
  BufferAttribute,
  CanvasTexture,
  CustomBlending,
  DoubleSide,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LinearFilter,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
} from "three";
import type { Point } from "../engine/types.ts";
import { add } from "./geometry.ts";
import { measures } from "./measure.ts";
import type { Orbit } from "./orbit.ts";
import { pixels } from "./strokes.ts";
import { type Colour, css } from "./theme.ts";

export interface Label {
  /** `x_4`: what follows `_` stands lower and smaller, up to a space. Letters before it are italic. */
  text: string;
  at: Point;
  /** It stands on this side of the point. */
  toward?: Point;
  colour: Colour;
  /** Pixels. */
  size?: number;
  /** On a plate of the background's colour. */
  plate?: boolean;
  /** The higher ones keep their place. */
  rank: number;
}

export interface Slot {
  x: number;
  y: number;
  width: number;
  height: number;
}

const SIDE = 1024;
const GAP = 4;
const ROOM = 96;
/** Painted larger than shown, for dense screens and saved pictures. */
const FINE = 2;

const VERTEX = /* glsl */ `
  attribute vec4 box, part;
  uniform vec2 pixels;
  varying vec2 vAt;
  void main() {
    vec2 at = box.xy + position.xy * box.zw;
    vAt = part.xy + position.xy * part.zw;
    gl_Position = vec4(2.0 * at.x / pixels.x - 1.0, 1.0 - 2.0 * at.y / pixels.y, -1.0, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  uniform sampler2D words;
  varying vec2 vAt;
  void main() { gl_FragColor = texture2D(words, vAt); }`;

/** Words about a point that is in the picture stay in it whole. */
function inside(start: number, point: number, length: number, room: number): number {
  return point < 0 || point > room ? start : Math.min(Math.max(start, 2), room - length - 2);
}

export class Labels {
  readonly object: Mesh;
  #canvas = document.createElement("canvas");
  #pen: CanvasRenderingContext2D;
  #texture: CanvasTexture;
  #slots = new Map<string, Slot>();
  #shelf = { x: 0, y: 0, height: 0 };
  #geometry = new InstancedBufferGeometry();
  #box = new InstancedBufferAttribute(new Float32Array(4 * ROOM), 4);
  #part = new InstancedBufferAttribute(new Float32Array(4 * ROOM), 4);
  #groups = new Map<string, Label[]>();
  /** Which of the places round its point a label took last: it stays there while it can. */
  #taken = new Map<string, number>();
  #background: Colour = [1, 1, 1];
  #font: string;

  constructor(font: string) {
    this.#font = font;
    this.#canvas.width = SIDE;
    this.#canvas.height = SIDE;
    const pen = this.#canvas.getContext("2d", { willReadFrequently: true });
    if (!pen) throw new Error("no canvas");
    this.#pen = pen;
    this.#texture = new CanvasTexture(this.#canvas);
    this.#texture.flipY = false;
    this.#texture.premultiplyAlpha = true;
    this.#texture.generateMipmaps = false;
    this.#texture.minFilter = LinearFilter;
    this.#geometry.setAttribute("position", new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]), 3));
    this.#geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.#geometry.setAttribute("box", this.#box);
    this.#geometry.setAttribute("part", this.#part);
    this.#geometry.instanceCount = 0;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { pixels, words: { value: this.#texture } },
      transparent: true,
      depthTest: false,
      depthWrite: false,
      side: DoubleSide,
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
    });
    this.object = new Mesh(this.#geometry, material);
    this.object.frustumCulled = false;
    this.object.renderOrder = 100;
  }

  /** The labels of one part of the scene, instead of those it had. */
  set(group: string, labels: Label[]): void {
    this.#groups.set(group, labels);
  }

  /** Another background, another halo. */
  theme(background: Colour): void {
    this.#background = background;
    this.#forget();
  }

  #forget(): void {
    this.#slots.clear();
    this.#shelf = { x: 0, y: 0, height: 0 };
    this.#pen.clearRect(0, 0, SIDE, SIDE);
  }

  /** Finds places for all labels as the arm is seen now, beside what covers the picture. */
  layout(orbit: Orbit, covered: Slot[]): void {
    const all = [...this.#groups.values()].flat().sort((a, b) => b.rank - a.rank);
    const placed = [...covered];
    const seen = new Map<string, number>();
    let count = 0;
    for (const label of all) {
      if (count === ROOM) break;
      const slot = this.#slot(label);
      const point = orbit.project(label.at);
      if (!slot || !point.before) continue;
      const [width, height] = [slot.width / FINE, slot.height / FINE];
      // The same words stand at several places: their order tells them apart.
      const times = seen.get(label.text) ?? 0;
      seen.set(label.text, times + 1);
      const name = `${label.text} ${times}`;
      const towards = label.toward ? orbit.project(add(label.at, label.toward)) : null;
      const angle = towards ? Math.atan2(towards.y - point.y, towards.x - point.x) : -Math.PI / 4;
      const place = this.#place(name, point, angle, width, height, placed);
      if (!place) continue;
      placed.push({ ...place, width, height });
      this.#box.setXYZW(count, Math.round(place.x), Math.round(place.y), width, height);
      this.#part.setXYZW(count, slot.x / SIDE, slot.y / SIDE, slot.width / SIDE, slot.height / SIDE);
      count++;
    }
    measures.labels = count;
    measures.places = placed;
    this.#geometry.instanceCount = count;
    this.object.visible = count > 0;
    this.#box.needsUpdate = true;
    this.#part.needsUpdate = true;
  }

  #place(name: string, point: { x: number; y: number }, angle: number, width: number, height: number, placed: Slot[]) {
    const free = (x: number, y: number) =>
      placed.every((p) => x + width <= p.x + 3 || p.x + p.width <= x + 3 || y + height <= p.y + 3 || p.y + p.height <= y + 3);
    const at = (k: number) => {
      // Sideways by more and more, then farther away.
      const turn = angle + ((k % 8) + 1 >> 1) * (k % 2 ? 1 : -1) * (Math.PI / 4);
      const [c, s] = [Math.cos(turn), Math.sin(turn)];
      // So far that the whole of it is on that side of the point.
      const far = 7 + 11 * Math.floor(k / 8) + (Math.abs(c) * width + Math.abs(s) * height) / 2;
      return { x: inside(point.x + c * far - width / 2, point.x, width, pixels.value.x), y: inside(point.y + s * far - height / 2, point.y, height, pixels.value.y) };
    };
    const last = this.#taken.get(name);
    const order = last === undefined ? [] : [last];
    for (let k = 0; k < 24; k++) order.push(k);
    for (const k of order) {
      const { x, y } = at(k);
      if (!free(x, y)) continue;
      this.#taken.set(name, k);
      return { x, y };
    }
    return null;
  }

  #slot(label: Label): Slot | null {
    const size = label.size ?? 14;
    const key = `${label.text}|${css(label.colour)}|${size}|${label.plate ? 1 : 0}`;
    const known = this.#slots.get(key);
    if (known) return known;
    const pen = this.#pen;
    const pieces = this.#pieces(label.text, size * FINE);
    const widths = pieces.map(({ font, text }) => {
      pen.font = font;
      return pen.measureText(text).width;
    });
    const margin = (label.plate ? 6 : 3) * FINE;
    const width = Math.ceil(widths.reduce((a, b) => a + b, 0) + 2 * margin);
    const height = Math.ceil(1.35 * size * FINE + (label.plate ? 3 * FINE : 0));
    const slot = this.#reserve(width, height);
    if (!slot) return null;
    this.#slots.set(key, slot);
    this.#paint(label, slot, pieces, widths, margin, size * FINE);
    this.#texture.needsUpdate = true;
    return slot;
  }

  #paint(label: Label, slot: Slot, pieces: { font: string; text: string; drop: number }[], widths: number[], margin: number, size: number): void {
    const pen = this.#pen;
    pen.textBaseline = "alphabetic";
    pen.lineJoin = "round";
    if (label.plate) {
      pen.globalAlpha = 0.88;
      pen.fillStyle = css(this.#background);
      pen.beginPath();
      pen.roundRect(slot.x, slot.y, slot.width, slot.height, 5 * FINE);
      pen.fill();
      pen.globalAlpha = 1;
    }
    let x = slot.x + margin;
    const line = slot.y + slot.height / 2 + 0.3 * size;
    pieces.forEach(({ font, text, drop }, k) => {
      pen.font = font;
      if (!label.plate) {
        pen.globalAlpha = 0.85;
        pen.strokeStyle = css(this.#background);
        pen.lineWidth = 3 * FINE;
        pen.strokeText(text, x, line + drop);
        pen.globalAlpha = 1;
      }
      pen.fillStyle = css(label.colour);
      pen.fillText(text, x, line + drop);
      x += widths[k];
    });
  }

  #pieces(words: string, size: number): { text: string; font: string; drop: number }[] {
    const plain = `500 ${size}px ${this.#font}`;
    const italic = `italic 500 ${size}px ${this.#font}`;
    const low = `500 ${Math.round(0.74 * size)}px ${this.#font}`;
    return words
      .split(/(\p{L}_\S+)/u)
      .filter((text) => text.length > 0)
      .flatMap((text) => {
        const match = /^(\p{L})_(\S+)$/u.exec(text);
        if (!match) return [{ text, font: plain, drop: 0 }];
        return [
          { text: match[1], font: italic, drop: 0 },
          { text: match[2], font: low, drop: 0.2 * size },
        ];
      });
  }

  /** Room in the texture. When there is none left everything is painted anew. */
  #reserve(width: number, height: number): Slot | null {
    if (width > SIDE) return null;
    const shelf = this.#shelf;
    if (shelf.x + width > SIDE) {
      shelf.y += shelf.height + GAP;
      shelf.x = 0;
      shelf.height = 0;
    }
    if (shelf.y + height > SIDE) {
      this.#forget();
      return this.#reserve(width, height);
    }
    const slot = { x: shelf.x, y: shelf.y, width, height };
    shelf.x += width + GAP;
    shelf.height = Math.max(shelf.height, height);
    return slot;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#texture.dispose();
    (this.object.material as ShaderMaterial).dispose();
  }
}
