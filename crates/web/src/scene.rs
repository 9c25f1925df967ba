//! The arm in a configuration, as bodies to draw.

use crate::refusal::Refusal;
use crate::steps::{self, Step};
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit::geometry::{Transform, Vector};
use denavit::velocity::{Viewpoint, geometric, measures};
use denavit_report::figure::Arm;
use serde_json::{Value, json};

/// Frames, bodies, the steps of all rows, how well the hand can move.
///
/// # Errors
/// If the configuration does not fit.
pub fn scene(subject: &Subject, q: &[f64]) -> Result<Value, Refusal> {
    let q = subject.configuration(q)?;
    let arm = subject.arm.at(q);
    let mut value = bodies(&arm);
    let skeleton = arm.skeleton();
    let frames = skeleton.frames.iter().chain([&skeleton.tool]);
    value["frames"] = frames.map(matrix).collect();
    let layout = arm.layout();
    value["ground"] = json!({ "at": layout.ground.0.0, "up": layout.ground.1.0 });
    value["unit"] = layout.unit.into();
    value["rows"] = steps(subject, q, &skeleton.frames);
    let jacobian = geometric(&subject.robot, q, &Viewpoint::tool());
    let whole = measures(&jacobian, &subject.space.is_angle, subject.robot.reach().max(1e-9)).whole;
    value["measures"] = json!({
        "manipulability": whole.manipulability,
        "smallest": whole.singular_values.last(),
        "condition": whole.condition,
    });
    let within = |(x, limits): (&f64, &Option<[f64; 2]>)| {
        limits.is_none_or(|[low, high]| (low - 1e-9..=high + 1e-9).contains(x))
    };
    value["withinLimits"] = q.iter().zip(&subject.space.limits).map(within).collect();
    Ok(value)
}

/// The bodies alone.
///
/// # Errors
/// If the configuration does not fit.
pub fn ghost(subject: &Subject, q: &[f64]) -> Result<Value, Refusal> {
    Ok(bodies(&subject.arm.at(subject.configuration(q)?)))
}

/// What is drawn of an arm.
pub fn bodies(arm: &Arm) -> Value {
    let layout = arm.layout();
    let joints = &arm.skeleton().joints;
    let symbols = layout.symbols.iter().map(|s| {
        json!({
            "joint": joints[s.joint].number,
            "kind": if s.kind == JointKind::Revolute { "revolute" } else { "prismatic" },
            "centre": short(s.centre),
            "axis": short(s.axis),
            "radius": s.radius as f32,
            "half": s.half as f32,
        })
    });
    let bars = layout
        .bars
        .iter()
        .map(|b| json!({ "from": short(b.a), "to": short(b.b), "link": b.link, "rod": b.rod }));
    let (at, along, across) = layout.gripper;
    json!({
        "symbols": symbols.collect::<Vec<_>>(),
        "bars": bars.collect::<Vec<_>>(),
        "gripper": { "at": short(at), "along": short(along), "across": short(across) },
    })
}

/// A point of a body: half as many digits are more than anybody sees, and take half as long to write and to read.
fn short(v: Vector<f64>) -> [f32; 3] {
    v.0.map(|x| x as f32)
}

/// A pose as rows of rows.
pub fn matrix(x: &Transform<f64>) -> Value {
    json!(x.matrix().map(|row| row.map(|x| x + 0.0)))
}

/// The steps of each row with the frames before them.
fn steps(subject: &Subject, q: &[f64], frames: &[Transform<f64>]) -> Value {
    let cells = subject.steps.get_or_init(|| steps::of(&subject.description, &subject.valued));
    let variables = subject.valued.variables();
    let value = |s| match variables.iter().position(|v| v.symbol == s) {
        Some(k) => Some(q[k]),
        None => subject.valued.value(s),
    };
    let convention = subject.description.convention;
    let row = |(steps, start): (&Vec<Step>, &Transform<f64>)| -> Value {
        let mut frame = *start;
        let step = |Step { cell, value: formula, text }: &Step| {
            let x = formula.eval(value).unwrap_or(f64::NAN);
            let before = frame;
            frame = frame * cell.transform(x);
            json!({
                "letter": cell.key(convention),
                "axis": cell.axis().to_string(),
                "frame": matrix(&before),
                "value": x,
                "text": text,
            })
        };
        steps.iter().map(step).collect()
    };
    cells.iter().zip(frames).map(row).collect()
}
