// What tests read: counters of what really happened, nothing else.

export interface Measures {
  /** Frames rendered since the page was opened. */
  frames: number;
  /** Whether the picture stands still, drawn as finely as it ever is. */
  isStill: boolean;
  /** What the last frame took in this thread, milliseconds, from preparing to the last call of WebGL. */
  renderMs: number;
  /** Milliseconds from the frame before to the last one, while the picture was moving; 0 after it stood still. */
  intervalMs: number;
  /** Draw calls and triangles of the last frame. */
  calls: number;
  triangles: number;
  /** Pixels of the picture for each pixel of the page. */
  ratio: number;
  /** Whether WebGL is done in software. */
  software: boolean;
  /** How many ghosts, labels stand in the picture. */
  ghosts: number;
  labels: number;
  /** Where they stand, and what covers the picture, pixels of the canvas. */
  places: { x: number; y: number; width: number; height: number }[];
  /** How many pieces of bodies are there to be drawn; how often all of a tree's were. */
  bodies: number;
  trees: number;
  /** The lowest and the highest corner of the bodies, in the base. */
  box: () => number[][];
  /** Where handles of the gizmo are, pixels of the canvas: a test drags them. */
  handles: () => Record<string, [number, number]>;
  /** Where the middles of the joints are, pixels of the canvas, in the order of the engine's symbols. */
  joints: () => [number, number][];
  /** Where the answers of the game are, pixels of the canvas. */
  answers: () => [number, number][];
}

declare global {
  interface Window {
    denavit?: Measures;
  }
}

export const measures: Measures = {
  frames: 0,
  isStill: false,
  renderMs: 0,
  intervalMs: 0,
  calls: 0,
  triangles: 0,
  ratio: 1,
  software: false,
  ghosts: 0,
  labels: 0,
  places: [],
  bodies: 0,
  trees: 0,
  box: () => [],
  handles: () => ({}),
  joints: () => [],
  answers: () => [],
};

window.denavit = measures;
