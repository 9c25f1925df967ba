// Where the hand comes to: a section filled with the manipulability of its cells and edged by its boundary, or the cells
// turned about the first axis as a cloud.

import { BufferAttribute, BufferGeometry, DoubleSide, EqualStencilFunc, InvertStencilOp, Mesh, Points, ShaderMaterial } from "three";
import type { Point, Workspace } from "../engine/types.ts";
import { engine, look, revision, said, show, workspace } from "../state.ts";
import { add, sub, turned, unit } from "./geometry.ts";
import type { Stage } from "./stage.ts";
import { Strokes } from "./strokes.ts";
import { colours, isDark, onScale } from "./theme.ts";
import { fit } from "./view-fit.ts";
import { wait } from "./waiting.ts";

/** More points are slow in software and say no more. */
const MOST_POINTS = 14000;
/** Of the stencil: whether a pixel is within the boundary. */
const WITHIN = 0x80;
/** The golden angle: turned by it again and again, nothing lines up. */
const GOLDEN = Math.PI * (3 - Math.sqrt(5));

const VERTEX = /* glsl */ `
  attribute vec3 color;
  uniform float size;
  varying vec3 vColour;
  void main() {
    vColour = color;
    gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
    gl_PointSize = size;
  }`;
const FRAGMENT = /* glsl */ `
  uniform float alpha;
  varying vec3 vColour;
  void main() { gl_FragColor = vec4(vColour, alpha); }`;

function material(size: number): ShaderMaterial {
  const uniforms = { size: { value: size }, alpha: { value: 0.5 } };
  return new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, transparent: true, depthWrite: false, side: DoubleSide });
}

/** Fans over the boundary that turn a bit of the stencil over and over: it is set within, whatever the shape. */
function mask(): ShaderMaterial {
  const made = material(1);
  made.colorWrite = false;
  made.depthTest = false;
  made.stencilWrite = true;
  made.stencilWriteMask = WITHIN;
  made.stencilZPass = InvertStencilOp;
  made.stencilZFail = InvertStencilOp;
  return made;
}

function withinMask(made: ShaderMaterial): void {
  made.stencilWrite = true;
  made.stencilWriteMask = 0;
  made.stencilFunc = EqualStencilFunc;
  made.stencilRef = WITHIN;
  made.stencilFuncMask = WITHIN;
}

function fans(geometry: BufferGeometry, space: Workspace): void {
  const positions: number[] = [];
  const faces: number[] = [];
  for (const polygon of space.boundary) {
    const first = positions.length / 3;
    polygon.forEach((p, k) => {
      positions.push(...inSpace(space, p));
      if (k > 1) faces.push(first, first + k - 1, first + k);
    });
  }
  put(geometry, positions, positions);
  geometry.setIndex(faces);
}

/** A point of the section in space. */
function inSpace({ origin, first, second }: Workspace, [u, v]: readonly [number, number]): Point {
  return add(add(origin, first, u), second, v);
}

/** A square a cell. */
function fill(geometry: BufferGeometry, space: Workspace): void {
  const positions: number[] = [];
  const shades: number[] = [];
  const faces: number[] = [];
  const [du, dv] = [space.size[0] / 2, space.size[1] / 2];
  for (const { at, value } of space.cells) {
    const k = positions.length / 3;
    for (const [a, b] of [[-du, -dv], [du, -dv], [du, dv], [-du, dv]]) positions.push(...inSpace(space, [at[0] + a, at[1] + b]));
    for (let i = 0; i < 4; i++) shades.push(...onScale(value));
    faces.push(k, k + 1, k + 2, k, k + 2, k + 3);
  }
  put(geometry, positions, shades);
  geometry.setIndex(faces);
}

/** The cells turned about the axis; where it does not turn, the cells themselves. Wider rings have more points. */
function strew(geometry: BufferGeometry, space: Workspace): void {
  const positions: number[] = [];
  const shades: number[] = [];
  const axis = space.revolves ? space.axis : null;
  const along = axis ? unit(axis.along) : null;
  const radius = (p: Point) => {
    if (!axis || !along) return 1;
    const w = sub(p, axis.at);
    return Math.hypot(...sub(w, add([0, 0, 0], along, w[0] * along[0] + w[1] * along[1] + w[2] * along[2])));
  };
  const places = space.cells.map(({ at, value }) => ({ p: inSpace(space, at), value }));
  const whole = places.reduce((sum, { p }) => sum + radius(p), 0);
  let spent = 0;
  let count = 0;
  for (const { p, value } of places) {
    spent += radius(p) / whole;
    for (; count < spent * (axis ? MOST_POINTS : places.length); count++) {
      const q = axis && along ? add(axis.at, turned(sub(p, axis.at), along, count * GOLDEN)) : p;
      positions.push(...q);
      shades.push(...onScale(value));
    }
  }
  put(geometry, positions, shades);
}

function put(geometry: BufferGeometry, positions: number[], shades: number[]): void {
  geometry.dispose();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(shades), 3));
}

export function addWorkspace(stage: Stage): void {
  const cells = new Mesh(new BufferGeometry(), material(1));
  const cloud = new Points(new BufferGeometry(), material(4));
  const within = new Mesh(new BufferGeometry(), mask());
  const edge = new Strokes(9, false, 256);
  withinMask(cells.material);
  for (const one of [within, cells, cloud]) {
    one.frustumCulled = false;
    one.renderOrder = one === within ? 3.9 : 4;
    stage.add(one);
    stage.onEnd(() => {
      one.geometry.dispose();
      one.material.dispose();
    });
  }
  stage.add(edge.object);
  stage.onEnd(() => edge.dispose());
  for (const one of [within, cells, cloud]) one.visible = false;

  stage.watch(
    "workspace",
    () => ({ space: workspace.value, as: look.value.workspace, palette: colours.value, isDark: isDark.value }),
    ({ space, as, palette, isDark: dark }) => {
      cells.visible = as === "section" && space !== null;
      within.visible = cells.visible;
      cloud.visible = as === "cloud" && space !== null;
      cells.material.uniforms.alpha.value = dark ? 0.42 : 0.38;
      cloud.material.uniforms.alpha.value = dark ? 0.5 : 0.42;
      edge.begin();
      if (space && as !== "none") {
        if (as === "section") {
          fill(cells.geometry, space);
          fans(within.geometry, space);
        } else strew(cloud.geometry, space);
        for (const polygon of space.boundary) {
          const points = polygon.map((p) => inSpace(space, p));
          if (points.length > 2) points.push(points[0]);
          edge.chain(points, { colour: palette.quiet, width: 1.75, alpha: as === "section" ? 1 : 0.7, through: 0.35 });
        }
      }
      edge.end();
    },
  );

  // What is larger than the picture is brought into it when it first comes.
  let fitted: Workspace | null = null;
  stage.watch("workspace fit", () => ({ space: workspace.value, isWanted: look.value.workspace !== "none" }), ({ space, isWanted }) => {
    if (!space || !isWanted || fitted === space) return;
    fitted = space;
    fit(stage, true);
  });

  // Asked for when it is first wanted, and again for another robot.
  let of = -1;
  stage.watch("workspace of", () => ({ isWanted: look.value.workspace !== "none", now: revision.value }), ({ isWanted, now }) => {
    if (of !== now && of >= 0) workspace.value = null;
    if (!isWanted || of === now) return;
    of = now;
    // What was cancelled is wanted no longer, and can be asked for again.
    void ask(now).then((isThere) => {
      if (isThere || revision.peek() !== now) return;
      of = -1;
      show({ workspace: "none" });
    });
  });
}

async function ask(now: number): Promise<boolean> {
  const { begin, finish } = wait("workspace", () => engine().formulas.cancel());
  try {
    begin();
    const answer = await engine().formulas.call("workspace", {});
    if (revision.peek() === now) workspace.value = answer;
    return true;
  } catch (why) {
    said(why);
    return false;
  } finally {
    finish();
  }
}
