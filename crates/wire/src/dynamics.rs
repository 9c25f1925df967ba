//! Torques, inertia and motion, in numbers and as formulas.

use crate::Schema;
use crate::program::{Operations, Step};
use denavit::dynamics::{BaseParameter, DynamicModel, Fate, Ground, Minimality};
use denavit_symbolic::Expr;
use serde::Serialize;

/// An arm in a state: N·m and N by its joints, the state's units radians, metres and seconds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answer {
    /// What the torques that were given accelerate the arm by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accelerations: Option<Vec<f64>>,
    /// The energies, joules.
    pub energy: Energy,
    /// The torques of friction.
    pub friction: Vec<f64>,
    /// The torques of gravity.
    pub gravity: Vec<f64>,
    /// A(q), row by row.
    pub inertia: Vec<Vec<f64>>,
    /// The joint variables.
    pub q: Vec<f64>,
    /// Their rates.
    pub qd: Vec<f64>,
    /// Their accelerations, if these were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub qdd: Option<Vec<f64>>,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// The torques for the accelerations, or those that were given.
    pub torques: Vec<f64>,
    /// C(q, q̇) q̇.
    pub velocity: Vec<f64>,
    /// What holds the wrench of the tool, if one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wrench: Option<Vec<f64>>,
}

/// Energies, joules.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Energy {
    /// The kinetic one.
    pub kinetic: f64,
    /// The potential one; 0 with all mass at the origin of the base.
    pub potential: f64,
}

/// The model as formulas.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Model {
    /// The base parameters, link by link.
    pub base_parameters: Vec<Base>,
    /// What the steps cost.
    pub count: Operations,
    /// Gravity by its components in the base, as formulas.
    pub gravity: [String; 3],
    /// Whether the base parameters are proved to be the fewest.
    pub minimal: bool,
    /// A(q), C(q, q̇) q̇ and Q(q), of arms with few joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<Parts>,
    /// On what it rests that the torques are Lagrange's: `proved`, `sampled` (equal at random states), `failed`.
    pub proof: &'static str,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// A program for the torques `t1` ….
    pub steps: Vec<Step>,
    /// Parameters of the links on which no torque depends.
    pub without_effect: Vec<String>,
}

/// A base parameter.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Base {
    /// The link, from 1.
    pub link: usize,
    /// Its name.
    pub name: String,
    /// Its value, if those of the links are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number: Option<f64>,
    /// What it is in the parameters of the links.
    pub value: String,
}

/// The parts of the torques.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Parts {
    /// Q(q).
    pub gravity: Vec<String>,
    /// A(q), row by row.
    pub inertia: Vec<Vec<String>>,
    /// On what it rests that their sum gives Lagrange's torques: `proved` or `sampled`.
    pub proof: &'static str,
    /// C(q, q̇) q̇.
    pub velocity: Vec<String>,
}

/// A word for what torques rest on.
fn word(ground: Ground) -> &'static str {
    match ground {
        Ground::Proved => "proved",
        Ground::Modulo(_) | Ground::Numbers(..) => "sampled",
        Ground::Failed => "failed",
    }
}

impl Model {
    /// A model, its formulas printed by `text`.
    pub fn of(robot: &str, model: &DynamicModel, text: impl Fn(Expr) -> String) -> Self {
        let base = |p: &BaseParameter| Base {
            link: p.link + 1,
            name: p.symbol.name().to_string(),
            number: model.base.value(&model.formulas, p),
            value: text(p.value),
        };
        let list = |all: &[Expr]| all.iter().map(|&e| text(e)).collect::<Vec<_>>();
        let idle = model.base.fates.iter().filter(|f| f.1 == Fate::WithoutEffect);
        Model {
            base_parameters: model.base.parameters.iter().map(base).collect(),
            count: (&model.torques.count()).into(),
            gravity: model.formulas.dynamics.gravity.0.map(&text),
            minimal: model.base.minimality == Minimality::Proved,
            parts: model.parts.as_ref().map(|p| Parts {
                gravity: list(&p.gravity),
                inertia: p.inertia.iter().map(|row| list(row)).collect(),
                proof: word(p.ground),
                velocity: list(&p.velocity),
            }),
            proof: word(model.ground),
            robot: robot.into(),
            schema: Schema,
            steps: model.torques.steps().iter().map(|s| Step::of(s, &text)).collect(),
            without_effect: idle.map(|f| f.0.name().to_string()).collect(),
        }
    }
}
