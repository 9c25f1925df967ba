//! The arm in a configuration, as bodies to draw.

use crate::refusal::Refusal;
use crate::session::Subject;
use denavit::description::{JointKind, Row};
use denavit::geometry::{Axis, Transform, Vector};
use denavit::velocity::{Viewpoint, geometric, measures};
use denavit_report::figure::Arm;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use serde_json::{Value, json};

/// A step of a row as it stands in the table.
pub struct Cell {
    letter: &'static str,
    axis: Axis,
    turns: bool,
    value: Expr,
    text: String,
}

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
    let cells = subject.cells.get_or_init(|| {
        let rows = subject.description.rows.iter().zip(&subject.valued.rows);
        rows.map(|(own, valued)| cells(subject, own, valued)).collect()
    });
    let variables = subject.valued.variables();
    let parameters = &subject.valued.parameters;
    let value = |s| match variables.iter().position(|v| v.symbol == s) {
        Some(k) => Some(q[k]),
        None => parameters.iter().find(|p| p.symbol == s)?.value?.eval(|_| None).ok(),
    };
    let row = |(cells, start): (&Vec<Cell>, &Transform<f64>)| -> Value {
        let mut frame = *start;
        let step = |cell: &Cell| {
            let x = cell.value.eval(value).unwrap_or(f64::NAN);
            let before = frame;
            let along = |x: f64| match cell.axis {
                Axis::X => Vector([x, 0.0, 0.0]),
                Axis::Y => Vector([0.0, x, 0.0]),
                Axis::Z => Vector([0.0, 0.0, x]),
            };
            let Vector([a, b, c]) = along(x);
            frame = frame
                * match cell.turns {
                    true => Transform::rotation_about(cell.axis, x),
                    false => Transform::translation(a, b, c),
                };
            json!({
                "letter": cell.letter,
                "axis": if cell.axis == Axis::X { "x" } else { "z" },
                "frame": matrix(&before),
                "value": x,
                "text": cell.text,
            })
        };
        cells.iter().map(step).collect()
    };
    cells.iter().zip(frames).map(row).collect()
}

/// The steps of a row in the convention's order.
fn cells(subject: &Subject, own: &Row, valued: &Row) -> Vec<Cell> {
    let convention = subject.description.convention;
    let names = subject.description.vocabulary();
    let cell = |letter, axis, turns, shown: Expr, value: Expr| Cell {
        letter,
        axis,
        turns,
        value,
        text: print(shown, &names, Style::Unicode),
    };
    let about_z = [
        cell("theta", Axis::Z, true, own.theta, valued.theta),
        cell(convention.length_z(), Axis::Z, false, own.d, valued.d),
    ];
    let about_x = [
        cell("alpha", Axis::X, true, own.alpha, valued.alpha),
        cell(convention.length_x(), Axis::X, false, own.a, valued.a),
    ];
    let branch =
        [cell("gamma", Axis::Z, true, own.gamma, valued.gamma), cell("b", Axis::Z, false, own.b, valued.b)];
    let has_branch = !own.gamma.is_zero() || !own.b.is_zero();
    let [alpha, a] = about_x;
    if convention.begins_with_joint() {
        about_z.into_iter().chain([a, alpha]).collect()
    } else {
        let before = branch.into_iter().filter(|_| has_branch);
        before.chain([alpha, a]).chain(about_z).collect()
    }
}
