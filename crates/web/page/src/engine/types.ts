// What the engine is asked and what it answers: the JSON that crosses the border between the page and `crates/web/src`. What
// the command line says, too, has the names that it has there (`crates/wire`, `docs/json.md`).
// Lengths are metres, angles radians, matrices rows of rows.

/** A pose: four rows of four. */
export type Matrix = number[][];
export type Point = [number, number, number];
export type Convention = "standard" | "craig" | "khalil";
export type Letter = "theta" | "d" | "a" | "alpha" | "r" | "gamma" | "b";

/** A robot file as somebody writes it: every value a text, as it stands in a cell. */
export interface RobotFile {
  name: string;
  convention: Convention;
  source?: string;
  gravity?: string[];
  /** Symbols; an empty text where no value is known. */
  parameters: { name: string; value: string }[];
  joints: Row[];
  base?: Frame;
  tool?: Frame;
  poses: { name: string; values: string[] }[];
}

/** A row of the table. Missing letters are 0. */
export interface Row {
  name?: string;
  theta?: string;
  d?: string;
  a?: string;
  alpha?: string;
  r?: string;
  gamma?: string;
  b?: string;
  limits?: [string, string];
  velocity?: string;
  acceleration?: string;
  mass?: string;
  com?: string[];
  inertia?: string[];
  first_moment?: string[];
  inertia_at_origin?: string[];
  rotor?: string;
  viscous?: string;
  coulomb?: string;
}

/** A constant transform: a displacement and roll, pitch, yaw; or a matrix. */
export interface Frame {
  xyz?: string[];
  rpy?: string[];
  matrix?: string[][];
}

export type Severity = "error" | "warning" | "note";

/** What is wrong with a text, or worth saying. */
export interface Finding {
  severity: Severity;
  message: string;
  hint: string | null;
  /** Where in a text that was opened. */
  at?: Place;
  /** The file that the place is in, where it is not the one that was opened. */
  source?: string;
  /** Where in a robot file: `joints.2.theta`, `joints.0.limits.1`, `parameters.3.value`, `tool.xyz.0`, `name`. */
  cell?: string;
}

/** `open`, `read` */
export interface Opened {
  file: RobotFile | null;
  findings: Finding[];
}

/** `catalogue` */
export interface Listed {
  name: string;
  title: string;
  /** `RRPRRR` */
  joints: string;
  convention: Convention;
  source: string | null;
}

/** What a robot is, once it is read; `edit` answers with it. */
export interface RobotModel {
  /** Its name. */
  robot: string;
  convention: Convention;
  /** The letters of the table in the convention's order, with `gamma` and `b` where used. */
  letters: Letter[];
  joints: Joint[];
  /** How many rows the table has. */
  rows: number;
  parameters: { name: string; measure: "length" | "angle"; value: number; given: boolean }[];
  /** The configuration to begin with, a regular one. */
  q: number[];
  poses: { name: string; q: number[] }[];
  /** How far the arm reaches, about. */
  reach: number;
  /** What is special about it. */
  structure: Structure;
  /** On geometry that is nearly special, and values that are not known. */
  remarks: string[];
}

/** What is special about an arm; joints are counted from 1. */
export interface Structure {
  /** `RRR·RRR with spherical wrist` */
  schematic: string;
  parallel: number[][];
  /** How axes k and k + 1 lie. */
  relations: string[];
  spherical_wrists: number[];
  nearly: { joints: [number, number]; nearly: string; by: number }[];
}

/** A joint that turns, or slides. */
export type JointKind = "R" | "P";

export interface Joint {
  /** `q1` */
  name: string;
  /** The joint's own name, if it has one. */
  title: string | null;
  kind: JointKind;
  /** The row (from 0) that introduces it. */
  row: number;
  limits: [number, number] | null;
  /** What a slider goes through: the limits, or a turn, or the arm's length. */
  range: [number, number];
  velocity: number | null;
  acceleration: number | null;
}

/** An arm in a configuration, `scene` answers with it. */
export interface Scene {
  /** Frames 0 … n and then the tool, in the base. */
  frames: Matrix[];
  /** A cylinder about its axis or a box along it for everything that moves. */
  symbols: { joint: number | null; kind: JointKind; centre: Point; axis: Point; radius: number; half: number }[];
  /** Straight parts of links; link 0 is the base. A rod slides out of a joint. */
  bars: { from: Point; to: Point; link: number; rod: boolean }[];
  ground: { at: Point; up: Point };
  gripper: { at: Point; along: Point; across: Point };
  /** The radius of the largest joint. */
  unit: number;
  /** The four elementary steps of each row, in the convention's order. */
  rows: Step[][];
  /** Of the tool, with lengths by the arm's reach. */
  measures: Measures;
  within_limits: boolean[];
}

/** How well a body moves. */
export interface Measures {
  /** √det(J Jᵀ) */
  manipulability: number;
  /** The largest singular value by the smallest; null if it is infinite. */
  condition: number | null;
  /** Descending. */
  singular_values: number[];
}

/** A step of a row: from one frame to the next, a turn about or a way along x or z of `frame`. */
export interface Step {
  letter: Letter;
  axis: "x" | "z";
  /** The frame before the step, in the base. */
  frame: Matrix;
  value: number;
  /** The cell as it is printed: `q2 + π/2`. */
  text: string;
}

/** `solve`. An arm that cannot take the pose has the solutions of the nearest that it can. */
export interface Answer {
  pose: Matrix;
  status: "solved" | "unreachable" | "not found";
  method: "closed form" | "elimination" | "self-motion" | "descent";
  complete: boolean;
  doubt?: string;
  solutions: Solution[];
  /** Each solution as it is drawn. */
  scenes: Ghost[];
  families: Family[];
  /** What is said of each family. */
  motions: Motion[];
  /** Why there is none, and the nearest configuration. */
  obstacle?: Obstacle;
  /** The same in words, and what the arm takes instead. */
  stop?: { words: string; pose: Matrix; scene: Ghost };
  /** The solution nearest to where the arm was: whole turns from one of the list, */
  nearest?: { q: number[]; distance: number; within_limits: boolean };
  /** this one. */
  index?: number;
  /** Values of joints that are given beside the pose, by their names. */
  given?: Record<string, number>;
}

export interface Obstacle {
  nearest: number[];
  angle: number;
  distance: number;
  unknown: string | null;
  violated: { condition: string; by: number }[];
}

/** What a ghost is drawn from. */
export type Ghost = Pick<Scene, "symbols" | "bars" | "gripper">;

export interface Solution {
  q: number[];
  branch: string;
  residual: number;
  multiplicity: number;
  within_limits: boolean;
  /** For each joint the least and the greatest number of whole turns by which the limits allow to move it. */
  turns: [number, number][] | null;
}

/** One configuration of it, and how it goes on. */
export interface Family extends Solution {
  /** What is free: `q4 + q6`. */
  free: string[];
  dimension: number;
  direction: number[];
  affine: boolean;
  interval: [number, number] | null;
  feasible?: [number, number][];
  /** Members along it, in order; the first again at the end if it is closed. */
  curve?: number[][];
}

export interface Motion {
  words: string;
  closed: boolean;
}

/** `orientations`: the sets by name, `zyx` with the names of their angles. */
export interface OrientationSet {
  name: string;
  title: string;
  names: string[];
}

/** A part of a document. */
export type Block =
  | { kind: "heading"; level: number; html: string }
  | { kind: "paragraph"; html: string }
  | { kind: "list"; items: string[] }
  | { kind: "formula"; formula: Formula; number?: number; proof?: "proved" | "sampled" | "wrong" }
  | { kind: "equations"; formulas: Formula[] }
  /** Formulas that may stand side by side. */
  | { kind: "beside"; formulas: Formula[] }
  | { kind: "table"; caption: string; head: string[]; rows: string[][] }
  | { kind: "tree"; root: Tree }
  | { kind: "figure"; svgs: { svg: string; caption: string }[]; caption: string }
  | { kind: "summary"; rows: [string, string][] }
  | { kind: "code"; text: string };

export interface Tree {
  html: string;
  children: Tree[];
}

/** A formula to show and to copy. */
export interface Formula {
  /** The `math` element. */
  mathml: string;
  /** The formula in words of the keyboard, for a screen reader. */
  text: string;
  latex: string;
  typst: string;
  python: string;
  c: string;
  /** Whether it may not fit a narrow screen. */
  wide: boolean;
  /** The name that it defines, if it defines one: `C23`, `k1`. */
  name?: string;
}

export type Topic = "table" | "links" | "forward" | "algorithm" | "inverse" | "jacobian" | "singularities";

/** `formulas` */
export interface Formulas {
  topic: Topic;
  blocks: Block[];
  /** For each name in the formulas the joints (from 0) that it is about: `C23` is about joints 1 and 2. */
  joints: Record<string, number[]>;
}

/** `values`: the current number of each name that a topic defines. */
export type Values = Record<string, number>;

/** `path` */
export interface PathRequest {
  start: number[];
  /** Way-points: configurations, or targets of the hand. */
  points: Waypoint[];
  /** Asked for in seconds; as fast as the limits allow without it. */
  duration?: number;
  /** Of the hand where no limits are known, m/s. */
  speed?: number;
  /** How many samples. */
  samples: number;
}

export type Waypoint =
  | { kind: "joint"; q: number[] }
  | { kind: "line"; pose: Matrix }
  | { kind: "arc"; via: Point; pose: Matrix };

export interface Path {
  /** What path it is. */
  path: string;
  timing: string;
  duration: number;
  /** The part of the way that could be followed, 1 if all. */
  reached: number;
  /** Sample by sample: seconds, joints, their velocities. */
  t: number[];
  q: number[][];
  velocity: number[][];
  /** Manipulability as in `Scene`. */
  manipulability: number[];
  pose: Matrix[];
  /** Singular configurations and limits on the way. */
  events: PathEvent[];
  /** Of the drives, N·m and N; nothing where no masses are known, or nothing drives. */
  torque?: number[][];
  /** Of an arm that falls, joules. */
  energy?: { kinetic: number[]; potential: number[]; lost: number[] };
  /** Configurations in which it can start. */
  starts: { q: number[]; branch: string; reached: number; singular: number; within_limits: boolean }[];
}

export interface PathEvent {
  /** Seconds. */
  t: number;
  words: string;
  kind: "singular" | "limit" | "within_limits" | "end";
}

/** A column of a recording; null where a number is missing. */
export interface RecordedColumn {
  name: string;
  values: (number | null)[];
}

/** `recording`; `recorded` is that of `denavit check --json`, as far as it is used here. */
export interface RecordedAnswer {
  /** The recording with all of it undone, as CSV. */
  fixed: string | null;
  /** What was found, line by line. */
  lines: string[];
  recorded: {
    findings: { kind: string; text: string }[];
    recipe: string;
    robot: string;
    roles: { joints: string[]; position: string[]; rotation: string[]; time: string | null };
    rows: number;
    understood: boolean;
    /** What no motion in it tells: a joint from 1, null for all of them. */
    unseen: { joint: number | null }[];
  };
  remarks: string[];
  /** With all of it undone, and, where something was found, as the columns stand; metres and radians that the hand is off. */
  views: { path: Path; shift: number[]; turn: number[] }[];
}

/** `check`; the claims are those of `denavit check --json`. */
export interface Checked {
  tally: Record<Verdict | "unjudged", number>;
  causes: { change: string; turns_right: string[] }[];
  claims: Claim[];
  notes: (Finding & { at: Place })[];
  /** What looks like a formula and was not judged. */
  unjudged: { at: Place; text: string; why: string }[];
}

export type Verdict = "equal" | "wrong" | "conditional" | "carried" | "undecided" | "unreadable";
/** Bytes are those of the UTF-8 text; characters those of a JavaScript string. */
export interface Place {
  line: number;
  column: number;
  bytes: [number, number];
}

export interface Claim {
  claim: string;
  about: string;
  at: Place;
  /** Which of the robots. */
  robot: number;
  verdict: Verdict;
  /** It is right by proof; what is equal and not proved is right in numbers. */
  proved: boolean;
  correct: string | null;
  slip: Slip | null;
  remarks: string[];
  entries: Entry[];
}

export interface Entry {
  verdict: Verdict;
  at: Place;
  printed: string;
  row?: number;
  column?: number;
  unless_zero?: string[];
  condition?: string;
  correct?: string;
  remarks?: string[];
  why?: string;
  errors?: { at: Place; message: string; hint: string | null }[];
  slip?: Slip | null;
  difference?: string | null;
  counterexample?: { at: Record<string, number>; printed: number; right: number } | null;
  holds_if?: string | null;
}

export interface Slip {
  kind: string;
  words: string;
  patches: { at: Place; was: string; now: string }[];
  formula: string;
}

/** `singular`: singular configurations of the tool, with the factor that vanishes. */
export interface Singularity {
  why: string | null;
  factor: Formula;
  /** Whether the tool's point alone gets stuck there. */
  of_point: boolean;
  /** The factor solved for angles. */
  zeros: { angle: string; values: string[] }[];
  q: number[] | null;
  scene: Ghost | null;
}

/** `workspace`: a section of where the tool comes to. */
export interface Workspace {
  /** The plane in the base: a point of it and its two directions. */
  origin: Point;
  first: Point;
  second: Point;
  /** Whether the section turns about the first joint's axis. */
  revolves: boolean;
  axis: { at: Point; along: Point } | null;
  names: [string, string];
  boundary: [number, number][][];
  /** Points of cells that are reached, with manipulability from 0 to 1. */
  cells: { at: [number, number]; value: number }[];
  size: [number, number];
  remarks: string[];
  area: number;
}

/** `hold`: what holds the arm at rest. */
export interface Held {
  /** No masses are known: those of bars were taken, kg/m. */
  bars?: number;
  /** Of all that moves, kg. */
  mass: number;
  /** N·m, and N of slides. */
  torques: number[];
}

/** Everything that can be asked, by name. */
export interface Requests {
  catalogue: [Record<string, never>, { robots: Listed[] }];
  open: [{ text: string; kind: "robot" | "toml" }, Opened];
  read: [{ text: string; kind: "markdown" | "csv" | "latex" | "any"; convention?: Convention; degrees?: boolean; millimetres?: boolean; table?: number }, Opened];
  edit: [{ file: RobotFile }, { robot: RobotModel | null; findings: Finding[] }];
  write: [{ file: RobotFile }, { text: string }];
  convert: [{ to: Convention }, { file: RobotFile; words: string; proved: boolean }];
  scene: [{ q: number[] }, Scene];
  ghost: [{ q: number[] }, Ghost];
  /** `quick`: one solution near to where the arm is will do. */
  solve: [{ pose?: Matrix; q?: number[]; near?: number[]; quick?: boolean }, Answer];
  orientations: [Record<string, never>, { sets: OrientationSet[] }];
  angles: [{ pose: Matrix; set: string }, { set: string; values: number[]; singular: boolean }];
  pose: [{ xyz: Point; set: string; values: number[] }, { pose: Matrix }];
  jacobian: [{ q: number[]; frame: "base" | "tool" }, { robot: string; frame: string; q: number[]; rows: string[]; jacobian: Matrix }];
  formulas: [{ topic: Topic; q: number[] }, Formulas];
  values: [{ topic: Topic; q: number[] }, { values: Values }];
  singular: [Record<string, never>, { singularities: Singularity[]; complete: boolean }];
  workspace: [Record<string, never>, Workspace];
  path: [PathRequest, Path];
  hold: [{ q: number[] }, Held];
  /** A path of an arm that falls from rest. */
  fall: [{ q: number[]; seconds: number }, Path];
  check: [{ text: string; name: string }, Checked];
  /** The bytes of a file as characters, or columns out of one. */
  recording: [{ name: string; latin1: string } | { name: string; columns: RecordedColumn[] }, RecordedAnswer];
  report: [{ format: "html" | "typst" | "latex" | "markdown"; language: "en" | "fr" | "de" | "es"; q: number[] }, { text: string; files?: { path: string; text: string }[] }];
  code: [{ language: "rust" | "c" | "python" | "matlab" | "javascript" | "cuda" | "ikfast"; name?: string }, { files: { path: string; text: string }[]; words: string; test: string }];
  tree: [TreeWanted, TreeTaken];
  figure: [{ q: number[]; scheme: boolean; azimuth?: number; elevation?: number }, { svg: string }];
}

/** `tree` */
export interface TreeWanted {
  /** The path of the description among the files. */
  name: string;
  text: string;
  around?: { texts?: [string, string][]; packages?: [string, string][]; others?: string[] };
  /** Names and values that xacro is given. */
  arguments?: [string, string][];
  base?: string;
  tip?: string;
  convention?: Convention;
  as_written?: boolean;
}

/** How the bodies of a tree look, and how they move with the joints of the chain. */
export interface Looks {
  /** The body whose frame is the base of the chain. */
  base: number;
  bodies: number;
  /** From the root on: child = parent · origin · motion by factor · variable + offset. */
  joints: {
    parent: number;
    child: number;
    origin: Matrix;
    axis: Point;
    kind: JointKind | null;
    variable: number | null;
    factor: number;
    offset: number;
  }[];
  parts: LookPart[];
}

export interface LookPart {
  body: number;
  shape: "box" | "cylinder" | "capsule" | "ellipsoid" | "sphere" | "mesh";
  /** Edges of a box; radius and length of a cylinder, or of that of a capsule; half the axes of an ellipsoid; radius of a ball; scales of a mesh. */
  size: Point;
  origin: Matrix;
  colour: [number, number, number, number] | null;
  /** The path of its mesh. */
  file?: string;
}

export interface TreeTaken {
  /** The table; nothing where the description has errors or a choice has to be made. */
  file: RobotFile | null;
  findings: Finding[];
  /** Nothing where there is no chain yet. */
  looks: Looks | null;
  /** Nothing where the description has errors. */
  tree: {
    name: string;
    base: string;
    /** Nothing where several links may be meant. */
    tip: string | null;
    links: string[];
    /** The links that may be meant; else those at which the tree ends. */
    tips: string[];
    words: string;
  } | null;
}

export type Op = keyof Requests;
export type Input<K extends Op> = Requests[K][0];
export type Output<K extends Op> = Requests[K][1];
/** Every answer can be this instead. */
export interface Refused {
  error: string;
  hint?: string;
}
