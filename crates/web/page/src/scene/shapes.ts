// The few bodies everything is made of: of size 1 and about z, so that a matrix brings them to any size and place.

import { BoxGeometry, BufferAttribute, BufferGeometry } from "three";

/** A piece of a profile: two points (radius, height) with their normals. */
type Piece = [from: [number, number], to: [number, number], normalFrom: [number, number], normalTo: [number, number]];

/** A profile turned about z. Pieces have normals of their own, so that edges stay edges. */
function revolved(pieces: Piece[], segments: number): BufferGeometry {
  const positions: number[] = [];
  const normals: number[] = [];
  const faces: number[] = [];
  for (const [from, to, normalFrom, normalTo] of pieces) {
    const first = positions.length / 3;
    for (let i = 0; i <= segments; i++) {
      const angle = (2 * Math.PI * i) / segments;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      positions.push(from[0] * c, from[0] * s, from[1], to[0] * c, to[0] * s, to[1]);
      normals.push(normalFrom[0] * c, normalFrom[0] * s, normalFrom[1], normalTo[0] * c, normalTo[0] * s, normalTo[1]);
      if (i === segments) break;
      const k = first + 2 * i;
      if (from[0] > 0) faces.push(k, k + 2, k + 1);
      if (to[0] > 0) faces.push(k + 1, k + 2, k + 3);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(faces);
  return geometry;
}

function cylinder(bevel: number, rise: number, segments: number): BufferGeometry {
  const h = 0.5;
  const slope: [number, number] = [Math.SQRT1_2, Math.SQRT1_2];
  const below: [number, number] = [Math.SQRT1_2, -Math.SQRT1_2];
  const pieces: Piece[] = [
    [[0, -h], [1 - bevel, -h], [0, -1], [0, -1]],
    [[1, rise - h], [1, h - rise], [1, 0], [1, 0]],
    [[1 - bevel, h], [0, h], [0, 1], [0, 1]],
  ];
  if (bevel > 0) {
    pieces.push([[1 - bevel, -h], [1, rise - h], below, below], [[1, h - rise], [1 - bevel, h], slope, slope]);
  }
  return revolved(pieces, segments);
}

function ball(rings: number, segments: number): BufferGeometry {
  const point = (k: number): [number, number] => {
    const angle = Math.PI * (k / rings - 0.5);
    return [k === 0 || k === rings ? 0 : Math.cos(angle), Math.sin(angle)];
  };
  const pieces = Array.from({ length: rings }, (_, k): Piece => [point(k), point(k + 1), point(k), point(k + 1)]);
  return revolved(pieces, segments);
}

/** A cylinder about z with half a ball at each end, which adds its radius. */
export function capsule(radius: number, length: number): BufferGeometry {
  const half = length / 2;
  const rings = 8;
  const point = (k: number): [number, number] => [k === 0 || k === 2 * rings ? 0 : Math.sin((Math.PI * k) / (2 * rings)), -Math.cos((Math.PI * k) / (2 * rings))];
  const at = ([r, z]: [number, number], rise: number): [number, number] => [radius * r, radius * z + rise];
  const pieces: Piece[] = [[[radius, -half], [radius, half], [1, 0], [1, 0]]];
  for (let k = 0; k < 2 * rings; k++) {
    const rise = k < rings ? -half : half;
    pieces.push([at(point(k), rise), at(point(k + 1), rise), point(k), point(k + 1)]);
  }
  return revolved(pieces, 28);
}

/** Of what the arm is made; ghosts are of fewer pieces. */
export const FINE = {
  /** Radius 1, height 1, edges broken. */
  joint: () => cylinder(0.09, 0.035, 28),
  /** Radius 1, height 1. */
  rod: () => cylinder(0, 0, 14),
  /** Edges of length 1. */
  box: () => new BoxGeometry(1, 1, 1),
  /** Radius 1. */
  ball: () => ball(7, 14),
};

export type Shape = keyof typeof FINE;

export const COARSE: Record<Shape, () => BufferGeometry> = {
  joint: () => cylinder(0, 0, 16),
  rod: () => cylinder(0, 0, 9),
  box: FINE.box,
  ball: () => ball(4, 9),
};
