// The picture itself: the renderer, what is drawn when, and how finely. Nothing is drawn unless something changed.

import { ColorManagement, LinearSRGBColorSpace, Scene, WebGLRenderer, type Object3D } from "three";
import { hasPicture, effect, signal } from "../state.ts";
import { Labels, type Slot } from "./labels.ts";
import { measures } from "./measure.ts";
import { Orbit } from "./orbit.ts";
import { pixels } from "./strokes.ts";
import { colours, stillness } from "./theme.ts";

// Colours come from the theme as they should be seen.
ColorManagement.enabled = false;

/** What WebGL calls itself where it is done by the processor. */
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;
/** A frame that takes longer than this, milliseconds, is slow. */
const SLOW = 24;
/** After so many milliseconds without change the picture is drawn once more, finely. */
const REST = 220;

/** Whether there is WebGL, and whether it is done in software. */
export function graphics(): "none" | "software" | "hardware" {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return "none";
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name) ? "software" : "hardware";
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly orbit = new Orbit();
  readonly labels: Labels;
  /** Called when the eye has moved: what keeps its size in pixels. */
  readonly onView = new Set<() => void>();
  /** A place in the picture that was pressed; whether that was meant for somebody. */
  onPick: (x: number, y: number) => boolean = () => false;
  /** Whether more is about to be drawn: the fine picture waits for it. */
  awaits = (): boolean => false;
  #renderer: WebGLRenderer;
  #scene = new Scene();
  #pending = 0;
  #rest = 0;
  #dirty = new Map<string, () => void>();
  #last = 0;
  #slow = 0;
  #finest: number;
  #moving: number;
  #size = { width: 0, height: 0 };
  #ends: (() => void)[] = [];
  /** The browser has taken the picture away, as it does when another program wants the graphics card. */
  readonly isLost = signal(false);

  constructor(canvas: HTMLCanvasElement, software: boolean) {
    this.canvas = canvas;
    measures.software = software;
    this.#renderer = new WebGLRenderer({ canvas, antialias: !software, stencil: true, powerPreference: "high-performance" });
    this.#renderer.outputColorSpace = LinearSRGBColorSpace;
    this.#renderer.info.autoReset = true;
    this.#renderer.sortObjects = true;
    // In software each pixel counts while something moves; what stands still is drawn finely, once.
    const ratio = Math.max(1, devicePixelRatio);
    this.#moving = software ? 1 : Math.min(2, ratio);
    this.#finest = software ? Math.max(2, Math.min(2, ratio)) : Math.min(2, ratio);
    this.labels = new Labels(getComputedStyle(canvas).fontFamily || "sans-serif");
    this.add(this.labels.object);
    this.#ends.push(
      effect(() => {
        const { background } = colours.value;
        this.#clear(background);
        this.labels.theme(background);
        this.invalidate();
      }),
    );
    const lost = (event: Event) => {
      event.preventDefault();
      this.isLost.value = true;
      // What was to be drawn is drawn when it is back.
      cancelAnimationFrame(this.#pending);
      clearTimeout(this.#rest);
      this.#pending = 0;
    };
    const found = () => {
      this.isLost.value = false;
      // A new context begins with its own colour behind all.
      this.#clear(colours.peek().background);
      this.viewChanged();
    };
    canvas.addEventListener("webglcontextlost", lost);
    canvas.addEventListener("webglcontextrestored", found);
    this.#ends.push(() => {
      canvas.removeEventListener("webglcontextlost", lost);
      canvas.removeEventListener("webglcontextrestored", found);
    });
  }

  #clear([r, g, b]: readonly number[]): void {
    this.#renderer.setClearColor((Math.round(255 * r) << 16) | (Math.round(255 * g) << 8) | Math.round(255 * b), 1);
  }

  add(object: Object3D): void {
    // All geometry stands in the base frame already.
    object.traverse((one) => (one.matrixAutoUpdate = false));
    this.#scene.add(object);
  }

  /** Keeps a part of the picture as it should be: reads signals now, draws before the next frame. */
  watch<T>(name: string, read: () => T, draw: (value: T) => void): void {
    this.#ends.push(
      effect(() => {
        const value = read();
        this.#dirty.set(name, () => draw(value));
        this.invalidate();
      }),
    );
  }

  /** Something is done when the stage ends. */
  onEnd(end: () => void): void {
    this.#ends.push(end);
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.#size = { width, height };
    this.orbit.width = width;
    this.orbit.height = height;
    pixels.value.set(width, height);
    this.#apply(this.#moving);
    this.viewChanged();
    // A canvas is empty after its size has changed: not for a frame.
    this.#frame(performance.now());
  }

  #apply(ratio: number): void {
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(this.#size.width, this.#size.height, false);
    measures.ratio = ratio;
  }

  /** The eye has moved. */
  viewChanged(): void {
    this.#dirty.set("view", () => {
      for (const one of this.onView) one();
    });
    this.invalidate();
  }

  /** How long a change of view lasts. */
  get ease(): number {
    return stillness.matches ? 0 : 280;
  }

  invalidate(): void {
    measures.isStill = false;
    if (this.#pending || this.isLost.peek()) return;
    this.#pending = requestAnimationFrame((now) => {
      this.#pending = 0;
      this.#frame(now);
    });
  }

  #frame(now: number): void {
    if (this.isLost.peek() || this.#size.width === 0) return;
    const begun = performance.now();
    const isOnTheWay = this.orbit.step(now);
    this.#adapt(now);
    if (measures.ratio !== this.#moving) this.#apply(this.#moving);
    this.#draw();
    measures.renderMs = performance.now() - begun;
    clearTimeout(this.#rest);
    if (isOnTheWay) this.viewChanged();
    else this.#restSoon();
  }

  #restSoon(): void {
    this.#rest = window.setTimeout(() => (this.awaits() ? this.#restSoon() : this.#settle()), REST);
  }

  #draw(): void {
    this.orbit.apply();
    const dirty = [...this.#dirty.values()];
    this.#dirty.clear();
    for (const draw of dirty) draw();
    this.labels.layout(this.orbit, this.#covered());
    this.#renderer.render(this.#scene, this.orbit.camera);
    measures.frames += 1;
    if (measures.frames === 1) setTimeout(hasPicture);
    measures.calls = this.#renderer.info.render.calls;
    measures.triangles = this.#renderer.info.render.triangles;
  }

  /** Where notes, the cube and the tool bar stand over the picture. */
  #covered(): Slot[] {
    const own = this.canvas.getBoundingClientRect();
    const over = this.canvas.parentElement?.querySelectorAll(".scene-cube, .scene-row, .scene-chip, .scene-tools") ?? [];
    return [...over].map((one) => {
      const { left, top, width, height } = one.getBoundingClientRect();
      return { x: left - own.left, y: top - own.top, width, height };
    });
  }

  /** Fewer pixels while frames are slow. */
  #adapt(now: number): void {
    const interval = now - this.#last;
    this.#last = now;
    measures.intervalMs = interval < 200 ? interval : 0;
    if (interval > 200 || this.#moving <= 1) return;
    this.#slow = interval > SLOW ? this.#slow + 1 : Math.max(0, this.#slow - 1);
    if (this.#slow < 12) return;
    this.#slow = 0;
    this.#moving = 1;
  }

  /** The picture stands still: once more, finely. */
  #settle(): void {
    measures.intervalMs = 0;
    if (this.isLost.peek() || this.#pending) return;
    if (this.#finest !== this.#moving) {
      this.#apply(this.#finest);
      this.#draw();
    }
    measures.isStill = true;
  }

  /** The picture as it is, at twice its size. */
  async picture(): Promise<Blob> {
    const before = measures.ratio;
    this.#apply(2);
    this.#draw();
    // The pixels are there until this task ends.
    const blob = new Promise<Blob>((resolve, reject) => {
      this.canvas.toBlob((made) => (made ? resolve(made) : reject(new Error("the picture could not be saved"))), "image/png");
    });
    this.#apply(before);
    this.#draw();
    return blob;
  }

  end(): void {
    cancelAnimationFrame(this.#pending);
    clearTimeout(this.#rest);
    for (const end of this.#ends) end();
    this.labels.dispose();
    this.#renderer.dispose();
  }
}
