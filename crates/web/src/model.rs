//! What the page has to know of a robot before anything is computed.

use crate::subject::Subject;
use crate::words;
use denavit::Robot;
use denavit::description::{Description, JointKind, Measure, Parameter as Symbolic};
use denavit_report::words::Geometry as _;
use denavit_symbolic::Expr;
use denavit_wire::robot::{Structure, kind};
use serde::Serialize;
use std::f64::consts::PI;

/// The joints, the letters of the table, where to begin.
#[derive(Serialize)]
pub struct Model {
    convention: &'static str,
    joints: Vec<Joint>,
    /// The letters of the table, in the convention's order.
    letters: Vec<&'static str>,
    parameters: Vec<Parameter>,
    poses: Vec<Named>,
    /// The configuration to begin with, a regular one.
    q: Vec<f64>,
    /// How far the arm reaches, about.
    reach: f64,
    remarks: Vec<String>,
    /// Its name.
    robot: String,
    /// How many rows the table has.
    rows: usize,
    structure: Structure,
}

/// A joint.
#[derive(Serialize)]
struct Joint {
    acceleration: Option<f64>,
    kind: &'static str,
    limits: Option<[f64; 2]>,
    name: String,
    /// What a slider goes through: the limits, or a turn, or the arm's length.
    range: [f64; 2],
    /// The row, from 0, that introduces it.
    row: usize,
    /// The joint's own name, if it has one.
    title: Option<String>,
    velocity: Option<f64>,
}

/// A symbol.
#[derive(Serialize)]
struct Parameter {
    /// Whether its value is the description's.
    given: bool,
    measure: &'static str,
    name: String,
    value: Option<f64>,
}

/// A configuration that has a name.
#[derive(Serialize)]
struct Named {
    name: String,
    q: Vec<f64>,
}

/// The parameters that place something: angles and lengths.
fn placing(d: &Description) -> impl Iterator<Item = (&Symbolic, Measure)> {
    let all = d.parameters.iter().map(|p| (p, d.measure(p.symbol)));
    all.filter(|(_, measure)| !matches!(measure, Measure::Other(_)))
}

impl Model {
    /// A robot in hand.
    pub fn of(subject: &Subject) -> Self {
        let d = &subject.description;
        let structure = denavit::structure::Structure::of(&subject.valued);
        let mut remarks: Vec<String> = structure.nearly.iter().map(|near| words().nearly(near)).collect();
        let missing: Vec<String> =
            placing(d).filter(|(p, _)| p.value.is_none()).map(|(p, _)| p.symbol.name().to_string()).collect();
        if !missing.is_empty() {
            remarks.push(format!(
                "no value is known for {}: the picture and all numbers take one that was chosen",
                missing.join(", ")
            ));
        }
        let parameters = placing(d).map(|(own, measure)| Parameter {
            given: own.value.is_some(),
            measure: if measure == Measure::Angle { "angle" } else { "length" },
            name: own.symbol.name().to_string(),
            value: subject.valued.value(own.symbol),
        });
        let poses = subject.valued.poses.iter().filter_map(|(name, q)| {
            let q: Option<Vec<f64>> = q.iter().map(|&x| number(subject, x)).collect();
            Some(Named { name: name.clone(), q: q? })
        });
        Model {
            convention: d.convention.name(),
            joints: joints(subject),
            letters: d.columns().iter().map(|c| c.key(d.convention)).collect(),
            parameters: parameters.collect(),
            poses: poses.collect(),
            q: denavit::velocity::regular_configuration(&subject.valued, subject.arm.pose().to_vec()),
            reach: subject.robot.reach(),
            remarks,
            robot: d.name.clone(),
            rows: d.rows.len(),
            structure: Structure::from(&structure),
        }
    }
}

/// A constant at the robot's own values.
pub fn number(subject: &Subject, e: Expr) -> Option<f64> {
    e.eval(|s| subject.valued.value(s)).ok().filter(|x| x.is_finite())
}

fn joints(subject: &Subject) -> Vec<Joint> {
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
        Joint {
            acceleration: row.acceleration.and_then(|a| number(subject, a)),
            kind: kind(variable.kind),
            limits,
            name: variable.symbol.name().to_string(),
            range,
            row: k,
            title: row.name.clone(),
            velocity: row.velocity.and_then(|v| number(subject, v)),
        }
    };
    moving.enumerate().map(joint).collect()
}

/// How far something slides whose limits are not known.
fn length(robot: &Robot<f64>) -> f64 {
    if robot.reach() > 0.0 { robot.reach() } else { 1.0 }
}
