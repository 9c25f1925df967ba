// The list of way-points, and the fields of one.

import { useId, useMemo, useState } from "preact/hooks";
import type { Matrix, Point, Waypoint } from "../engine/types.ts";
import { engine, look, move, q, reach, robot } from "../state.ts";
import { format, formatWithUnit, type Measure, unitOf } from "../units.ts";
import { Button } from "../widgets/button.tsx";
import { NumberField } from "../widgets/number.tsx";
import { hand, place, points, put, remove, shift, start, startHere } from "./points.ts";

/** The angles that a pose of a way-point is edited with. */
const SET = "zyx";

export function WaypointList() {
  const first = start.value;
  return (
    <ol class="waypoints" aria-label="Way-points">
      <li class="waypoint">
        <div class="waypoint-row">
          <span class="waypoint-kind">Start</span>
          <span class="waypoint-words" title={first ? jointWords(first) : undefined}>
            {first ? jointWords(first) : "the joints when the path is planned"}
          </span>
          <span class="waypoint-actions">
            <Button label="Start here" hint="Start with the present joints" small onClick={startHere} />
            {first && <Button label="Go" hint="Move the arm to the start" small onClick={() => move(first)} />}
          </span>
        </div>
      </li>
      {points.value.map((point, k) => (
        <WaypointItem key={k} point={point} index={k} count={points.value.length} />
      ))}
    </ol>
  );
}

function WaypointItem({ point, index, count }: { point: Waypoint; index: number; count: number }) {
  const [editing, setEditing] = useState(false);
  const id = useId();
  const number = index + 1;
  const title = { joint: "Joints", line: "Line", arc: "Arc" }[point.kind];
  return (
    <li class="waypoint">
      <div class="waypoint-row">
        <button
          type="button"
          class="waypoint-open"
          aria-expanded={editing}
          aria-controls={id}
          aria-label={`Way-point ${number}, ${title}: ${editing ? "close" : "edit"}`}
          onClick={() => setEditing(!editing)}
        >
          <span class="waypoint-kind">
            {number}. {title}
          </span>
          <span class="waypoint-words" title={words(point)}>
            {words(point)}
          </span>
        </button>
        <span class="waypoint-actions">
          <Button label={`Move way-point ${number} up`} icon="up" bare small disabled={index === 0} onClick={() => shift(index, -1)} />
          <Button label={`Move way-point ${number} down`} icon="down" bare small disabled={index === count - 1} onClick={() => shift(index, 1)} />
          <Button label={`Remove way-point ${number}`} icon="trash" bare small onClick={() => remove(index)} />
        </span>
      </div>
      <div id={id} hidden={!editing}>
        {editing && <Editor point={point} index={index} />}
      </div>
    </li>
  );
}

function Editor({ point, index }: { point: Waypoint; index: number }) {
  if (point.kind === "joint") {
    return (
      <div class="waypoint-editor">
        <div class="fields">
          {robot.value!.joints.map((joint, k) => (
            <label key={k}>
              <span>{joint.name}</span>
              <NumberField
                label={joint.name}
                value={point.q[k] ?? 0}
                measure={joint.kind === "R" ? "angle" : "length"}
                onChange={(value) => put(index, { kind: "joint", q: point.q.map((old, j) => (j === k ? value : old)) })}
              />
            </label>
          ))}
        </div>
        <div class="row-of-buttons">
          <Button label="Take the present joints" small onClick={() => put(index, { kind: "joint", q: q.peek() })} />
          <Button label="Move the arm there" small onClick={() => move(point.q)} />
        </div>
      </div>
    );
  }
  const take = () => {
    const now = hand();
    if (now) put(index, { ...point, pose: now });
  };
  return (
    <div class="waypoint-editor">
      {point.kind === "arc" && (
        <fieldset>
          <legend>Through</legend>
          <Coordinates at={point.via} onChange={(at) => put(index, { ...point, via: at })} />
        </fieldset>
      )}
      <PoseFields pose={point.pose} onChange={(pose) => put(index, { ...point, pose })} />
      <div class="row-of-buttons">
        <Button label="Take the present hand" small onClick={take} />
        <Button label="Move the hand there" small onClick={() => reach(point.pose)} />
      </div>
    </div>
  );
}

function Coordinates({ at, onChange }: { at: Point; onChange: (at: Point) => void }) {
  return (
    <div class="fields">
      {["x", "y", "z"].map((name, k) => (
        <label key={name}>
          <span>{name}</span>
          <NumberField label={name} value={at[k]!} measure="length" onChange={(value) => onChange(at.map((old, j) => (j === k ? value : old)) as Point)} />
        </label>
      ))}
    </div>
  );
}

function PoseFields({ pose, onChange }: { pose: Matrix; onChange: (pose: Matrix) => void }) {
  const set = useMemo(() => engine().now.call("orientations", {}).sets.find((s) => s.name === SET), []);
  const angles = useMemo(() => (set ? engine().now.call("angles", { pose, set: set.name }).values : []), [pose, set]);
  const build = (xyz: Point, values: number[]) => onChange(engine().now.call("pose", { xyz, set: set!.name, values }).pose);
  if (!set) return null;
  return (
    <fieldset>
      <legend>Pose of the hand at the end</legend>
      <Coordinates at={place(pose)} onChange={(at) => build(at, angles)} />
      <div class="fields">
        {set.names.map((name, k) => (
          <label key={name}>
            <span>{name}</span>
            <NumberField label={`${name} (${set.title})`} value={angles[k] ?? 0} measure="angle" onChange={(value) => build(place(pose), angles.map((old, j) => (j === k ? value : old)))} />
          </label>
        ))}
      </div>
    </fieldset>
  );
}

function words(point: Waypoint): string {
  switch (point.kind) {
    case "joint":
      return jointWords(point.q);
    case "line":
      return `to ${pointWords(place(point.pose))}`;
    case "arc":
      return `by ${pointWords(point.via)} to ${pointWords(place(point.pose))}`;
  }
}

/** `10.0°, 20.0°, −50.0°`; lengths beside angles say their unit. */
export function jointWords(values: number[]): string {
  const joints = robot.value?.joints ?? [];
  const write = (x: number, k: number) => {
    const measure: Measure = joints[k]?.kind === "P" ? "length" : "angle";
    return formatWithUnit(x, measure, look.value, measure === "angle" && look.value.angles === "deg" ? 1 : undefined);
  };
  return values.map(write).join(", ");
}

export function pointWords(at: Point): string {
  const places = look.value.lengths === "mm" ? 0 : 3;
  return `(${at.map((x) => format(x, "length", look.value, places)).join(", ")}) ${unitOf("length", look.value)}`;
}
