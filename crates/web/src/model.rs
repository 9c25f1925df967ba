//! What the page has to know of a robot before anything is computed.

use crate::subject::Subject;
use crate::words;
use denavit::Robot;
use denavit::description::{JointKind, Measure};
use denavit::structure::Structure;
use denavit_report::words::Geometry as _;
use denavit_symbolic::Expr;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// The joints, the letters of the table, where to begin.
pub fn model(subject: &Subject) -> Value {
    let d = &subject.description;
    let structure = Structure::of(&subject.valued);
    let mut remarks: Vec<String> = structure.nearly.iter().map(|near| words().nearly(near)).collect();
    let missing: Vec<String> =
        d.parameters.iter().filter(|p| p.value.is_none()).map(|p| p.symbol.name().to_string()).collect();
    if !missing.is_empty() {
        remarks.push(format!(
            "no value is known for {}: the picture and all numbers take one that was chosen",
            missing.join(", ")
        ));
    }
    let parameters = subject.valued.parameters.iter().zip(&d.parameters).map(|(valued, own)| {
        json!({
            "name": &*own.symbol.name(),
            "measure": if d.measure(own.symbol) == Measure::Angle { "angle" } else { "length" },
            "value": valued.value.and_then(|v| number(subject, v)),
            "given": own.value.is_some(),
        })
    });
    let poses = subject.valued.poses.iter().filter_map(|(name, q)| {
        let q: Option<Vec<f64>> = q.iter().map(|&x| number(subject, x)).collect();
        Some(json!({ "name": name, "q": q? }))
    });
    json!({
        "name": d.name,
        "convention": d.convention.name(),
        "letters": d.columns().iter().map(|c| c.key(d.convention)).collect::<Vec<_>>(),
        "joints": joints(subject),
        "rows": d.rows.len(),
        "parameters": parameters.collect::<Vec<_>>(),
        "q": denavit::velocity::regular_configuration(&subject.valued, subject.arm.pose().to_vec()),
        "poses": poses.collect::<Vec<_>>(),
        "reach": subject.robot.reach(),
        "structure": structure.schematic(),
        "remarks": remarks,
    })
}

/// A constant at the robot's own values.
pub fn number(subject: &Subject, e: Expr) -> Option<f64> {
    e.eval(|s| subject.valued.value(s)).ok().filter(|x| x.is_finite())
}

fn joints(subject: &Subject) -> Vec<Value> {
    let rows = subject.valued.rows.iter().enumerate();
    let moving = rows.filter_map(|(k, row)| Some((k, row, row.variable?)));
    let joint = |(j, (k, row, variable)): (
        usize,
        (usize, &denavit::description::Row, denavit::description::Variable),
    )| {
        let limits = subject.space.limits[j];
        let range = limits.filter(|[low, high]| low < high).unwrap_or(match variable.kind {
            JointKind::Revolute => [-PI, PI],
            JointKind::Prismatic => [0.0, length(&subject.robot)],
        });
        json!({
            "name": &*variable.symbol.name(),
            "title": row.name,
            "kind": if variable.kind == JointKind::Revolute { "revolute" } else { "prismatic" },
            "row": k,
            "limits": limits,
            "range": range,
            "velocity": row.velocity.and_then(|v| number(subject, v)),
            "acceleration": row.acceleration.and_then(|a| number(subject, a)),
        })
    };
    moving.enumerate().map(joint).collect()
}

/// How far something slides whose limits are not known.
fn length(robot: &Robot<f64>) -> f64 {
    if robot.reach() > 0.0 { robot.reach() } else { 1.0 }
}
