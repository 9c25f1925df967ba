//! The arm in a configuration, as bodies to draw.

use crate::refusal::Refusal;
use crate::steps::{self, Step as CellStep};
use crate::subject::Subject;
use denavit::geometry::{Transform, Vector};
use denavit::velocity::{Viewpoint, Whole, geometric};
use denavit_report::figure::Arm;
use denavit_wire::jacobian::Measures;
use denavit_wire::pose::{Matrix, matrix};
use denavit_wire::robot::kind;
use serde::Serialize;

/// A point of a body: half as many digits are more than anybody sees, and take half as long to write and to read.
type Point = [f32; 3];

/// What is drawn of an arm.
#[derive(Serialize)]
pub struct Bodies {
    bars: Vec<Bar>,
    gripper: Gripper,
    symbols: Vec<Symbol>,
}

/// A straight part of a link; link 0 is the base.
#[derive(Serialize)]
struct Bar {
    from: Point,
    link: usize,
    /// Whether it slides out of a joint.
    rod: bool,
    to: Point,
}

/// The hand.
#[derive(Serialize)]
struct Gripper {
    across: Point,
    along: Point,
    at: Point,
}

/// What moves: a cylinder about its axis, or a box along it.
#[derive(Serialize)]
struct Symbol {
    axis: Point,
    centre: Point,
    half: f32,
    joint: Option<usize>,
    kind: &'static str,
    radius: f32,
}

/// An arm in a configuration.
#[derive(Serialize)]
pub struct Scene {
    bars: Vec<Bar>,
    /// Frames 0 … n and then the tool, in the base.
    frames: Vec<Matrix>,
    gripper: Gripper,
    ground: Ground,
    /// Of the tool, lengths by the arm's reach.
    measures: Measures,
    /// The steps of each row.
    rows: Vec<Vec<Step>>,
    symbols: Vec<Symbol>,
    /// The radius of the largest joint.
    unit: f64,
    /// Joint by joint.
    within_limits: Vec<bool>,
}

/// What the arm stands on.
#[derive(Serialize)]
struct Ground {
    at: [f64; 3],
    up: [f64; 3],
}

/// A step of a row.
#[derive(Serialize)]
struct Step {
    axis: String,
    /// The frame before it, in the base.
    frame: Matrix,
    letter: &'static str,
    /// As it is printed.
    text: String,
    value: f64,
}

/// Frames, bodies, the steps of all rows, how well the hand can move.
///
/// # Errors
/// If the configuration does not fit.
pub fn scene(subject: &Subject, q: &[f64]) -> Result<Scene, Refusal> {
    let q = subject.configuration(q)?;
    let arm = subject.arm.at(q);
    let (layout, skeleton) = (arm.layout(), arm.skeleton());
    let Bodies { bars, gripper, symbols } = bodies(&arm);
    let jacobian = geometric(&subject.robot, q, &Viewpoint::tool());
    let whole = Whole::new(&jacobian, &subject.space.is_angle, subject.robot.reach().max(1e-9));
    let within = |(x, limits): (&f64, &Option<[f64; 2]>)| {
        limits.is_none_or(|[low, high]| (low - 1e-9..=high + 1e-9).contains(x))
    };
    Ok(Scene {
        bars,
        frames: skeleton.frames.iter().chain([&skeleton.tool]).map(matrix).collect(),
        gripper,
        ground: Ground { at: layout.ground.0.0, up: layout.ground.1.0 },
        measures: Measures::from(&whole),
        rows: steps(subject, q, &skeleton.frames),
        symbols,
        unit: layout.unit,
        within_limits: q.iter().zip(&subject.space.limits).map(within).collect(),
    })
}

/// The bodies alone.
///
/// # Errors
/// If the configuration does not fit.
pub fn ghost(subject: &Subject, q: &[f64]) -> Result<Bodies, Refusal> {
    Ok(bodies(&subject.arm.at(subject.configuration(q)?)))
}

/// What is drawn of an arm.
pub fn bodies(arm: &Arm) -> Bodies {
    let layout = arm.layout();
    let joints = &arm.skeleton().joints;
    let symbols = layout.symbols.iter().map(|s| Symbol {
        axis: short(s.axis),
        centre: short(s.centre),
        half: s.half as f32,
        joint: joints[s.joint].number,
        kind: kind(s.kind),
        radius: s.radius as f32,
    });
    let bars = layout.bars.iter().map(|b| Bar { from: short(b.a), link: b.link, rod: b.rod, to: short(b.b) });
    let (at, along, across) = layout.gripper;
    Bodies {
        bars: bars.collect(),
        gripper: Gripper { across: short(across), along: short(along), at: short(at) },
        symbols: symbols.collect(),
    }
}

fn short(v: Vector<f64>) -> Point {
    v.0.map(|x| x as f32)
}

/// The steps of each row with the frames before them.
fn steps(subject: &Subject, q: &[f64], frames: &[Transform<f64>]) -> Vec<Vec<Step>> {
    let cells = subject.steps.get_or_init(|| steps::of(&subject.description, &subject.valued));
    let variables = subject.valued.variables();
    let value = |s| match variables.iter().position(|v| v.symbol == s) {
        Some(k) => Some(q[k]),
        None => subject.valued.value(s),
    };
    let convention = subject.description.convention;
    let row = |(steps, start): (&Vec<CellStep>, &Transform<f64>)| -> Vec<Step> {
        let mut frame = *start;
        let step = |CellStep { cell, value: formula, text }: &CellStep| {
            let x = formula.eval(value).unwrap_or(f64::NAN);
            let before = frame;
            frame = frame * cell.transform(x);
            Step {
                axis: cell.axis().to_string(),
                frame: matrix(&before),
                letter: cell.key(convention),
                text: text.clone(),
                value: x,
            }
        };
        steps.iter().map(step).collect()
    };
    cells.iter().zip(frames).map(row).collect()
}
