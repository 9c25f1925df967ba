// What the readers of meshes give: triangles as plain arrays, in the file's own axes, lengths in metres where it says its unit.

import { BufferAttribute, type BufferGeometry, type Material, Matrix4, Mesh, type Object3D } from "three";

export interface Piece {
  /** Three numbers a corner, three corners a triangle. */
  positions: Float32Array;
  normals: Float32Array;
  /** Red, green, blue, as they are seen, if the file says. */
  colour: [number, number, number] | null;
}

/** More triangles are refused while they are counted. */
export const MOST_TRIANGLES = 5_000_000;

const AS_IT_IS = new Matrix4();

/** All triangles of a scene. */
export function piecesOf(scene: Object3D, hasColours: boolean): Piece[] {
  scene.updateMatrixWorld(true);
  const pieces: Piece[] = [];
  let left = 3 * MOST_TRIANGLES;
  scene.traverse((one) => {
    if (!(one instanceof Mesh)) return;
    const geometry = flat(one.geometry as BufferGeometry);
    const count = geometry.getAttribute("position").count;
    left -= count;
    if (left < 0) throw new Error("more than 5 million triangles");
    if (!one.matrixWorld.equals(AS_IT_IS)) geometry.applyMatrix4(one.matrixWorld);
    const [positions, normals] = ["position", "normal"].map((name) => plain(geometry.getAttribute(name) as BufferAttribute));
    const materials: Material[] = Array.isArray(one.material) ? one.material : [one.material];
    const groups = materials.length > 1 && geometry.groups.length > 0 ? geometry.groups : [{ start: 0, count, materialIndex: 0 }];
    for (const { start, count: some, materialIndex } of groups) {
      const [from, to] = [3 * start, 3 * Math.min(count, start + some)];
      if (to <= from) continue;
      const colour = hasColours ? colourOf(materials[materialIndex ?? 0]) : null;
      pieces.push({ positions: positions.subarray(from, to), normals: normals.subarray(from, to), colour });
    }
  });
  if (pieces.length === 0) throw new Error("no triangles in it");
  return pieces;
}

/** Corner by corner, with normals. */
function flat(geometry: BufferGeometry): BufferGeometry {
  if (!geometry.getAttribute("normal")) geometry.computeVertexNormals();
  const whole = geometry.index ? geometry.toNonIndexed() : geometry.clone();
  for (const name of Object.keys(whole.attributes)) if (name !== "position" && name !== "normal") whole.deleteAttribute(name);
  for (const name of ["position", "normal"]) {
    const attribute = whole.getAttribute(name);
    if (attribute instanceof BufferAttribute && attribute.array instanceof Float32Array && attribute.itemSize === 3) continue;
    // Packed and interleaved numbers become plain ones, so that a matrix can be applied to them.
    const values = new Float32Array(3 * attribute.count);
    for (let k = 0; k < attribute.count; k++) {
      values[3 * k] = attribute.getX(k);
      values[3 * k + 1] = attribute.getY(k);
      values[3 * k + 2] = attribute.getZ(k);
    }
    whole.setAttribute(name, new BufferAttribute(values, 3));
  }
  return whole;
}

function plain(attribute: BufferAttribute): Float32Array {
  return attribute.array as Float32Array;
}

function colourOf(material: Material | undefined): Piece["colour"] {
  const colour = (material as { color?: { getHex(): number } } | undefined)?.color;
  if (!colour) return null;
  const hex = colour.getHex();
  return [((hex >> 16) & 255) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255];
}
