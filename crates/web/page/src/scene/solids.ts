// Many matte bodies in few draw calls: each shape is one instanced mesh, each body a row of numbers in its buffers.

import {
  type BufferGeometry,
  DoubleSide,
  EqualStencilFunc,
  FrontSide,
  Group,
  IncrementStencilOp,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  KeepStencilOp,
  LessEqualDepth,
  Mesh,
  ShaderMaterial,
} from "three";
import type { Point } from "../engine/types.ts";
import { cross, middle, norm, perpendicular, scale, sub, unit } from "./geometry.ts";
import { COARSE, FINE, type Shape } from "./shapes.ts";
import type { Colour } from "./theme.ts";

/** Three rows of a 3×4 matrix and a colour with its fourth number. */
const STRIDE = 16;
/** The rest of the stencil belongs to the section of the workspace. */
const SHADOW_BITS = 0x7f;

const VERTEX = /* glsl */ `
  attribute vec4 row0, row1, row2, tint;
  uniform float floorAt;
  varying vec3 vNormal;
  varying float vUp;
  varying vec4 vTint;
  void main() {
    vec4 p = vec4(position, 1.0);
    vec3 world = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
    mat3 m = transpose(mat3(row0.xyz, row1.xyz, row2.xyz));
    // Normals go with the inverse transposed: R S⁻¹ n = (R S) S⁻² n.
    vec3 n = normalize(m * (normal / vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2]))));
    vNormal = mat3(viewMatrix) * n;
    vUp = n.z;
    vTint = tint;
    #ifdef FLAT
      world.z = floorAt;
    #endif
    gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
  }`;

// A sky, a lamp beside the head of whoever looks, and edges that turn a little darker: matte, and cheap in software.
const FRAGMENT = /* glsl */ `
  varying vec3 vNormal;
  varying float vUp;
  varying vec4 vTint;
  uniform vec3 shadow;
  uniform float strength;
  void main() {
    #ifdef FLAT
      gl_FragColor = vec4(shadow, strength);
    #else
      vec3 n = normalize(vNormal);
      float lamp = max(dot(n, vec3(0.33, 0.53, 0.78)), 0.0);
      float light = 0.66 + 0.13 * vUp + 0.38 * lamp;
      float edge = smoothstep(-0.05, 0.5, n.z);
      #ifdef GHOST
        // Glass: clear where it is seen straight on, denser towards its outline.
        gl_FragColor = vec4(vTint.rgb * (0.55 + 0.55 * light), clamp(vTint.a * (1.9 - 1.25 * edge), 0.0, 1.0));
      #else
        vec3 lit = vTint.rgb * light * (0.86 + 0.14 * edge);
        gl_FragColor = vec4(mix(lit, vTint.rgb * (0.86 + 0.28 * lamp), vTint.a), 1.0);
      #endif
    #endif
  }`;

/** A colour and its fourth number: how much a matte body glows, or how dense a ghost is. */
export type Tint = readonly [Colour, number];

export type Pass = "matte" | "ghost" | "shadow";

function material(pass: Pass | "depth"): ShaderMaterial {
  const made = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { floorAt: { value: 0 }, shadow: { value: [0, 0, 0] }, strength: { value: 0.2 } },
    side: FrontSide,
    depthFunc: LessEqualDepth,
  });
  if (pass === "ghost" || pass === "depth") {
    // Where a ghost and the arm are at one place, the arm is seen.
    made.transparent = true;
    made.polygonOffset = true;
    made.polygonOffsetFactor = 1;
    made.polygonOffsetUnits = 4;
  }
  if (pass === "ghost") {
    made.defines = { GHOST: "" };
    made.depthWrite = false;
  } else if (pass === "depth") {
    made.colorWrite = false;
  } else if (pass === "shadow") {
    made.defines = { FLAT: "" };
    made.transparent = true;
    made.depthWrite = false;
    made.side = DoubleSide;
    // Parts lie one over the other in a shadow: each pixel darkens once.
    made.stencilWrite = true;
    made.stencilRef = 0;
    made.stencilFuncMask = SHADOW_BITS;
    made.stencilWriteMask = SHADOW_BITS;
    made.stencilFunc = EqualStencilFunc;
    made.stencilFail = KeepStencilOp;
    made.stencilZFail = KeepStencilOp;
    made.stencilZPass = IncrementStencilOp;
  }
  return made;
}

class Instances {
  readonly geometry = new InstancedBufferGeometry();
  count = 0;
  #rows!: Record<"row0" | "row1" | "row2" | "tint", InstancedBufferAttribute>;
  #room = 0;

  constructor(body: BufferGeometry, room: number) {
    this.geometry.setAttribute("position", body.getAttribute("position"));
    this.geometry.setAttribute("normal", body.getAttribute("normal"));
    this.geometry.setIndex(body.getIndex());
    this.#grow(room);
  }

  #grow(room: number): void {
    const before = this.#rows;
    // Buffers on the card have a fixed size.
    if (before) this.geometry.dispose();
    const make = (name: keyof typeof before) => {
      const attribute = new InstancedBufferAttribute(new Float32Array(4 * room), 4);
      if (before) attribute.array.set(before[name].array);
      this.geometry.setAttribute(name, attribute);
      return attribute;
    };
    this.#rows = { row0: make("row0"), row1: make("row1"), row2: make("row2"), tint: make("tint") };
    this.#room = room;
  }

  push(x: Point, y: Point, z: Point, at: Point, [colour, fourth]: Tint): void {
    if (this.count === this.#room) this.#grow(2 * this.#room);
    const k = this.count++;
    this.#rows.row0.setXYZW(k, x[0], y[0], z[0], at[0]);
    this.#rows.row1.setXYZW(k, x[1], y[1], z[1], at[1]);
    this.#rows.row2.setXYZW(k, x[2], y[2], z[2], at[2]);
    this.#rows.tint.setXYZW(k, colour[0], colour[1], colour[2], fourth);
  }

  end(): void {
    this.geometry.instanceCount = this.count;
    for (const attribute of Object.values(this.#rows)) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, (STRIDE / 4) * this.count);
      attribute.needsUpdate = true;
    }
  }
}

export class Solids {
  readonly object = new Group();
  #instances: Partial<Record<Shape, Instances>> = {};
  #materials: ShaderMaterial[] = [];
  #meshes: { mesh: Mesh; instances: Instances }[] = [];

  constructor(passes: readonly Pass[], order: number, shapes: readonly Shape[] = ["joint", "rod", "box", "ball"], room = 32) {
    const bodies = passes.includes("ghost") ? COARSE : FINE;
    for (const shape of shapes) this.#instances[shape] = new Instances(bodies[shape](), room);
    for (const pass of passes) {
      // Of a ghost only what is in front is seen: first its depth, then its colour.
      if (pass === "ghost") this.#add(material("depth"), order - 0.5);
      this.#add(material(pass), pass === "shadow" ? order - 2 : order);
    }
  }

  #add(made: ShaderMaterial, order: number): void {
    this.#materials.push(made);
    for (const instances of Object.values(this.#instances)) {
      const mesh = new Mesh(instances.geometry, made);
      mesh.frustumCulled = false;
      mesh.renderOrder = order;
      this.#meshes.push({ mesh, instances });
      this.object.add(mesh);
    }
  }

  /** Where the shadow falls and how it looks. */
  shade(floorAt: number, colour: Colour, strength: number): void {
    for (const { uniforms } of this.#materials) {
      uniforms.floorAt.value = floorAt;
      uniforms.shadow.value = colour;
      uniforms.strength.value = strength;
    }
  }

  begin(): void {
    for (const instances of Object.values(this.#instances)) instances.count = 0;
  }

  end(): void {
    for (const instances of Object.values(this.#instances)) instances.end();
    for (const { mesh, instances } of this.#meshes) mesh.visible = instances.count > 0;
  }

  cylinder(shape: "joint" | "rod", from: Point, to: Point, radius: number, tint: Tint): void {
    const v = sub(to, from);
    if (norm(v) < 1e-9) return;
    const axis = unit(v);
    const side = perpendicular(axis);
    this.#instances[shape]?.push(scale(side, radius), scale(cross(axis, side), radius), v, middle(from, to), tint);
  }

  /** Half edges along three directions at right angles. */
  box(centre: Point, x: Point, y: Point, z: Point, tint: Tint): void {
    this.#instances.box?.push(scale(x, 2), scale(y, 2), scale(z, 2), centre, tint);
  }

  ball(centre: Point, radius: number, tint: Tint): void {
    this.#instances.ball?.push([radius, 0, 0], [0, radius, 0], [0, 0, radius], centre, tint);
  }

  dispose(): void {
    for (const instances of Object.values(this.#instances)) instances.geometry.dispose();
    for (const made of this.#materials) made.dispose();
  }
}
