// The bodies of the tree that the robot is a chain of, as their file draws them: of glass, so that the arm inside, its axes and
// its normals are seen. What is not on the chain stands as at rest.

import {
  BufferAttribute,
  BufferGeometry,
  FrontSide,
  Group,
  Matrix4,
  Mesh,
  ShaderMaterial,
  Vector3,
} from "three";
import type { LookPart, Looks, Matrix, Point } from "../engine/types.ts";
import { batch, computed, effect, note, q, selected, signal } from "../state.ts";
import { Meshes } from "../tree/meshes.ts";
import { tree } from "../tree/open.ts";
import { measures } from "./measure.ts";
import { capsule, FINE } from "./shapes.ts";
import type { Stage } from "./stage.ts";
import { blend, type Colour, colours, isDark, type Palette } from "./theme.ts";

/** Whether bodies are wanted. */
export const bodiesWanted = signal(true);

/** A body as it is drawn. */
interface Body {
  part: LookPart;
  mesh: Mesh;
  depth: Mesh;
}

/** What can be drawn of the tree in hand. */
const drawable = signal<{ looks: Looks; bodies: Body[] } | null>(null);
/** Whether there is something to be shown or hidden. */
export const hasBodies = computed(() => (drawable.value?.bodies.length ?? 0) > 0);
/** Whether the arm stands in its bodies now. */
export const inBodies = computed(() => hasBodies.value && bodiesWanted.value);
/** Counts trees whose bodies are all there: then the view is fitted to them. */
export const wholeTrees = signal(0);

const VERTEX = /* glsl */ `
  varying vec3 vNormal;
  varying float vUp;
  void main() {
    vNormal = normalMatrix * normal;
    vUp = dot(normalize(vNormal), normalize(mat3(viewMatrix) * vec3(0.0, 0.0, 1.0)));
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

// The light of all bodies of the scene, and glass: clearer where it is seen straight on, denser towards its outline.
const FRAGMENT = /* glsl */ `
  uniform vec3 tint;
  uniform float density;
  varying vec3 vNormal;
  varying float vUp;
  void main() {
    vec3 n = normalize(vNormal);
    float lamp = max(dot(n, vec3(0.33, 0.53, 0.78)), 0.0);
    float light = 0.66 + 0.13 * vUp + 0.38 * lamp;
    float edge = smoothstep(0.0, 0.75, abs(n.z));
    gl_FragColor = vec4(tint * light * mix(0.72, 1.0, edge), density * mix(1.75, 1.0, edge));
  }`;

const depthOnly = () => new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { tint: { value: [0, 0, 0] }, density: { value: 0 } }, colorWrite: false, transparent: true, side: FrontSide });
const glass = () => new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { tint: { value: [1, 1, 1] }, density: { value: 0.4 } }, transparent: true, depthWrite: false, side: FrontSide });

/** The order of the glass: behind it the arm, before it strokes and labels. */
const ORDER = 4;

function bodyOf(part: LookPart, geometry: BufferGeometry, colour: Colour | null): Body {
  const [mesh, depth] = [new Mesh(geometry, glass()), new Mesh(geometry, depthOnly())];
  for (const one of [mesh, depth]) {
    one.matrixAutoUpdate = false;
    one.frustumCulled = false;
  }
  mesh.renderOrder = ORDER;
  depth.renderOrder = ORDER - 0.5;
  mesh.userData.colour = colour;
  return { part, mesh, depth };
}

function dispose(bodies: Body[]): void {
  for (const { mesh, depth } of bodies) {
    mesh.geometry.dispose();
    for (const one of [mesh, depth]) (one.material as ShaderMaterial).dispose();
  }
}

/** Own shapes are of size 1. */
function primitive(part: LookPart): BufferGeometry | null {
  const [a, b, c] = part.size;
  switch (part.shape) {
    case "box":
      return FINE.box().scale(a, b, c);
    case "cylinder":
      return FINE.joint().scale(a, a, b);
    case "capsule":
      return capsule(a, b);
    case "ellipsoid":
      return FINE.ball().scale(a, b, c);
    case "sphere":
      return FINE.ball().scale(a, a, a);
    default:
      return null;
  }
}

/** What was read of a description, so that another chain of it is drawn at once. */
const read = new WeakMap<object, Meshes>();
let runs = 0;
/** Whether bodies are being made. */
let areOnTheWay = false;
/** After so many milliseconds what is there is shown before the rest. */
const LONG = 1000;

/** Makes the bodies of the tree in hand; those with a mesh come when it is read. */
async function make(): Promise<void> {
  const run = ++runs;
  const opened = tree.peek();
  const looks = opened?.answer.looks;
  if (!opened || !looks || looks.parts.length === 0) {
    areOnTheWay = false;
    drawable.value = null;
    measures.bodies = 0;
    return;
  }
  const meshes = read.get(opened.source) ?? new Meshes(opened.source.files);
  read.set(opened.source, meshes);
  const bodies: Body[] = [];
  const failed = new Map<string, string>();
  const show = () => {
    drawable.value = { looks, bodies: [...bodies] };
    measures.bodies = bodies.length;
  };
  let shown = performance.now();
  areOnTheWay = true;
  for (const part of looks.parts) {
    const own = part.colour && ([part.colour[0], part.colour[1], part.colour[2]] as Colour);
    const shape = primitive(part);
    if (shape) {
      bodies.push(bodyOf(part, shape, own));
      continue;
    }
    const { file = "" } = part;
    try {
      for (const piece of await meshes.pieces(file)) {
        if (run !== runs) return dispose(bodies);
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(piece.positions, 3));
        geometry.setAttribute("normal", new BufferAttribute(piece.normals, 3));
        bodies.push(bodyOf(part, geometry, piece.colour ?? own));
      }
    } catch (why) {
      failed.set(file, why instanceof Error ? why.message : String(why));
    }
    if (run !== runs) return dispose(bodies);
    if (performance.now() - shown > LONG) {
      show();
      shown = performance.now();
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
  areOnTheWay = false;
  batch(() => {
    show();
    wholeTrees.value += 1;
    measures.trees = wholeTrees.value;
  });
  if (failed.size > 0) note(`${failed.size === 1 ? "A mesh is" : `${failed.size} meshes are`} not drawn: ${[...failed].map(([file, why]) => `${file.split("/").at(-1)} (${why})`).slice(0, 3).join(", ")}${failed.size > 3 ? ", …" : ""}.`);
}

function matrixOf(m: Matrix): Matrix4 {
  return new Matrix4().set(...(m.flat() as Parameters<Matrix4["set"]>));
}

/** Where each body is, in the base of the chain. */
function placed({ base, bodies, joints }: Looks, values: number[]): Matrix4[] {
  const places = Array.from({ length: bodies }, () => new Matrix4());
  const motion = new Matrix4();
  for (const { parent, child, origin, axis, kind, variable, factor, offset } of joints) {
    const place = places[child].multiplyMatrices(places[parent], matrixOf(origin));
    const value = factor * (variable === null ? 0 : (values[variable] ?? 0)) + offset;
    const along = new Vector3(...axis);
    if (kind === "R") place.multiply(motion.makeRotationAxis(along, value));
    else if (kind === "P") place.multiply(motion.makeTranslation(along.multiplyScalar(value)));
  }
  const inBase = places[base].clone().invert();
  return places.map((place) => place.premultiply(inBase));
}

/** Where a part stands in the frame of its body; a mesh is scaled. */
function within({ origin, shape, size }: LookPart): Matrix4 {
  const at = matrixOf(origin);
  return shape === "mesh" ? at.scale(new Vector3(...size)) : at;
}

/** The corners of the boxes around all bodies, in the base. */
export function corners(): Point[] {
  const now = inBodies.peek() ? drawable.peek() : null;
  if (!now) return [];
  const places = placed(now.looks, q.peek());
  return now.bodies.flatMap(({ part, mesh }) => {
    const { geometry } = mesh;
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    const box = geometry.boundingBox;
    if (!box) return [];
    const matrix = places[part.body].clone().multiply(within(part));
    return [0, 1, 2, 3, 4, 5, 6, 7].map((k): Point => {
      const corner = new Vector3(k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z);
      const { x, y, z } = corner.applyMatrix4(matrix);
      return [x, y, z];
    });
  });
}

measures.box = () => {
  const points = corners();
  const ends = (end: (...values: number[]) => number) => ([0, 1, 2] as const).map((k) => end(...points.map((point) => point[k])));
  return points.length > 0 ? [ends(Math.min), ends(Math.max)] : [];
};

/** A body's own colour, brought nearer to the picture's, so that black is seen on black. */
function tintOf(colour: Colour | null, palette: Palette): Colour {
  return colour ? blend(colour, palette.link, isDark.peek() ? 0.4 : 0.2) : palette.link;
}

export function addLooks(stage: Stage): void {
  const group = new Group();
  stage.add(group);
  stage.awaits = () => areOnTheWay;
  let bodies: Body[] = [];
  stage.watch(
    "looks",
    () => ({ now: inBodies.value ? drawable.value : null, values: q.value, palette: colours.value, isBack: selected.value !== null }),
    ({ now, values, palette, isBack }) => {
      group.visible = now !== null;
      if (!now) return;
      if (now.bodies !== bodies) {
        group.clear();
        const kept = new Set(now.bodies.map(({ mesh }) => mesh));
        dispose(bodies.filter(({ mesh }) => !kept.has(mesh)));
        bodies = now.bodies;
        for (const { mesh, depth } of bodies) group.add(depth, mesh);
      }
      const places = placed(now.looks, values);
      for (const { part, mesh, depth } of bodies) {
        mesh.matrix.multiplyMatrices(places[part.body], within(part));
        depth.matrix.copy(mesh.matrix);
        for (const one of [mesh, depth]) one.matrixWorldNeedsUpdate = true;
        const { uniforms } = mesh.material as ShaderMaterial;
        uniforms.density.value = isBack ? 0.2 : isDark.peek() ? 0.6 : 0.5;
        uniforms.tint.value = tintOf(mesh.userData.colour as Colour | null, palette);
      }
    },
  );
  stage.onEnd(() => dispose(bodies));
}

// A tree brings its bodies, whether there is a picture yet or not.
let before: unknown = null;
effect(() => {
  const opened = tree.value;
  if (opened === before) return;
  before = opened;
  void make();
});
