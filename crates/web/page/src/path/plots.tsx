// The plots of a path: joints, their speeds, torques and energies where there are masses, manipulability, with events and the time.

import { useMemo, useState } from "preact/hooks";
import type { Joint, Path } from "../engine/types.ts";
import { type Entry, Legend } from "../plot/legend.tsx";
import { Plot, type Series } from "../plot/plot.tsx";
import { look, robot } from "../state.ts";
import { factor, formatWithUnit, type Measure, type Units, unitOf } from "../units.ts";

export function Plots({ path }: { path: Path }) {
  const joints = robot.value!.joints;
  const units = look.value;
  const [hidden, setHidden] = useState<ReadonlySet<number>>(new Set());
  const toggle = (joint: number) => {
    const next = new Set(hidden);
    if (!next.delete(joint)) next.add(joint);
    setHidden(next);
  };
  const entries = useMemo<Entry[]>(() => {
    return joints.map((joint, k) => ({
      joint: k,
      name: joint.name,
      values: path.q.map((q) => q[k] ?? NaN),
      write: (value) => formatWithUnit(value, measure(joint.kind), units, units.angles === "deg" && joint.kind === "R" ? 1 : undefined),
    }));
  }, [path, joints, units]);
  const kinds = useMemo(() => {
    return (["R", "P"] as const)
      .filter((kind) => joints.some((joint) => joint.kind === kind))
      .map((kind) => {
        const of = (samples: number[][], by = factor(measure(kind), units)) => curves(samples, joints, kind, by, hidden);
        return { kind, positions: of(path.q), speeds: of(path.velocity), torques: path.torque && of(path.torque, 1) };
      });
  }, [path, joints, units, hidden]);
  const manipulability = useMemo<Series[]>(() => [{ name: "manipulability", joint: null, values: path.manipulability }], [path]);
  const energies = useMemo<Series[]>(() => {
    const { kinetic, potential, lost } = path.energy ?? { kinetic: [], potential: [], lost: [] };
    const all = [{ name: "kinetic", values: kinetic }, { name: "potential", values: potential }, { name: "lost to friction", values: lost }];
    return all.filter(({ values }) => values.some((x) => x !== 0)).map((one, k) => ({ ...one, joint: null, colour: k }));
  }, [path]);
  const common = { times: path.t, events: path.events };
  const mixed = kinds.length > 1;
  return (
    <div class="plots">
      <Legend times={path.t} entries={entries} hidden={hidden} toggle={toggle} />
      {kinds.map(({ kind, positions }) => (
        <Plot key={kind} title={mixed ? (kind === "R" ? "Joint angles" : "Joint displacements") : "Joints"} unit={unit(kind, units)} degrees={unit(kind, units) === "°"} series={positions} {...common} />
      ))}
      {kinds.map(({ kind, speeds }) => (
        <Plot key={kind} title={mixed ? (kind === "R" ? "Angular speeds" : "Linear speeds") : "Joint speeds"} unit={`${unit(kind, units)}/s`} degrees={unit(kind, units) === "°"} series={speeds} {...common} />
      ))}
      {kinds.map(({ kind, torques }) => torques && <Plot key={kind} title={mixed ? (kind === "R" ? "Torques" : "Forces") : kind === "R" ? "Joint torques" : "Joint forces"} unit={kind === "R" ? "N m" : "N"} series={torques} {...common} />)}
      {path.energy && <Plot title={`Energies since the start: ${energies.map(({ name }) => name).join(", ")}`} unit="J" series={energies} {...common} />}
      <Plot title="Manipulability" unit="lengths by the arm’s reach" fromZero series={manipulability} {...common} />
    </div>
  );
}

function unit(kind: Joint["kind"], units: Units): string {
  return unitOf(measure(kind), units);
}

function measure(kind: Joint["kind"]): Measure {
  return kind === "R" ? "angle" : "length";
}

/** The curves of one kind of joint, in a unit that is so much of the other one. */
function curves(samples: number[][], joints: Joint[], kind: Joint["kind"], factor: number, hidden: ReadonlySet<number>): Series[] {
  return joints.flatMap((joint, k) => {
    if (joint.kind !== kind || hidden.has(k)) return [];
    return [{ name: joint.name, joint: k, values: samples.map((sample) => (sample[k] ?? NaN) * factor) }];
  });
}
