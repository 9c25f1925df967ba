// A path as a table of numbers, in SI units; the columns are those of `denavit path --format csv`, and torques
// and energies where there are such.

import type { Path } from "../engine/types.ts";

export function pathCsv(path: Path, names: string[]): string {
  const { torque, energy } = path;
  const more = [...(torque ? names.map((name) => `${name}_torque`) : []), ...(energy ? Object.keys(energy) : [])];
  const head = ["t", ...names, ...names.map((name) => `${name}_velocity`), "x", "y", "z", "r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33", "manipulability", ...more];
  const lines = path.t.map((time, k) => {
    const pose = path.pose[k] ?? [];
    const rotation = [0, 1, 2].flatMap((row) => [0, 1, 2].map((column) => pose[row]?.[column] ?? ""));
    const position = [0, 1, 2].map((row) => pose[row]?.[3] ?? "");
    return [time, ...(path.q[k] ?? []), ...(path.velocity[k] ?? []), ...position, ...rotation, path.manipulability[k] ?? "", ...(torque?.[k] ?? []), ...(energy ? Object.values(energy).map((values) => values[k] ?? "") : [])].join(",");
  });
  return [head.join(","), ...lines, ""].join("\n");
}
