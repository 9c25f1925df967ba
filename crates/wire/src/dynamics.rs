//! Torques, inertia and motion, in numbers and as formulas.

use crate::Schema;
use crate::program::{Operations, Step};
use denavit::dynamics::{
    BaseParameter, DynamicModel, Fate, Ground, Inward, Minimality, Moment, Outward, Recursion, Simulation,
};
use denavit_symbolic::{Expr, Symbol};
use serde::Serialize;

/// An arm in a state: N·m and N by its joints, the state's units radians, metres and seconds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answer {
    /// What the torques that were given accelerate the arm by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accelerations: Option<Vec<f64>>,
    /// The first derivatives of the torques, or of the accelerations where torques were given, if they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<Slopes>,
    /// The energies, joules.
    pub energy: Energy,
    /// The torques of friction.
    pub friction: Vec<f64>,
    /// The torques of gravity.
    pub gravity: Vec<f64>,
    /// A(q), row by row.
    pub inertia: Vec<Vec<f64>>,
    /// The assembly mode of closed loops of which not all passive joints are couplings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mode: Option<String>,
    /// The momentum.
    pub momentum: Momentum,
    /// The passive joints of such loops, p1 first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passive: Option<Vec<f64>>,
    /// Work by time.
    pub power: Power,
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

/// First derivatives: row j is that of joint j.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Slopes {
    /// By the joint variables.
    pub by_q: Vec<Vec<f64>>,
    /// By their rates.
    pub by_qd: Vec<Vec<f64>>,
    /// Of torques by the accelerations: A.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_qdd: Option<Vec<Vec<f64>>>,
    /// Of accelerations by the torques: the inverse of A.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_tau: Option<Vec<Vec<f64>>>,
}

/// Energies, joules.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Energy {
    /// The kinetic one.
    pub kinetic: f64,
    /// The potential one; 0 with all mass at the origin of the base.
    pub potential: f64,
}

/// The momentum of all that moves, along the axes of the base; rotors aside.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Momentum {
    /// About the centre of mass, kg·m²/s.
    pub angular: [f64; 3],
    /// The centre of mass in the base, metres.
    pub centre: [f64; 3],
    /// Kg·m/s.
    pub linear: [f64; 3],
    /// Kilograms.
    pub mass: f64,
}

/// Work by time, watts: what the torques supply goes into friction, the tool's surroundings and the energies.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Power {
    /// What friction takes.
    pub dissipated: f64,
    /// What the tool gives to its surroundings.
    pub exerted: f64,
    /// By which the kinetic energy grows.
    pub kinetic: f64,
    /// By which the potential energy grows.
    pub potential: f64,
    /// What the torques supply.
    pub supplied: f64,
}

impl From<denavit::dynamics::Power> for Power {
    fn from(p: denavit::dynamics::Power) -> Self {
        let denavit::dynamics::Power { dissipated, exerted, kinetic, potential, supplied } = p;
        Power { dissipated, exerted, kinetic, potential, supplied }
    }
}

/// A motion under torques.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Motion {
    /// The largest imbalance of the energy in size, joules: the error of the integration.
    pub drift: f64,
    /// Why it ends before it was to, at the last sample.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ends: Option<String>,
    /// Joints that leave their limits: nothing stops them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub leaves: Vec<Left>,
    /// The robot's name.
    pub robot: String,
    /// The motion at regular times.
    pub samples: Vec<Sample>,
    /// The version.
    pub schema: Schema,
    /// Steps that were taken.
    pub steps: usize,
}

/// A joint that leaves its limits.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Left {
    /// Its name.
    pub joint: String,
    /// The first sample beyond, seconds.
    pub t: f64,
}

/// A moment of a motion.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Sample {
    /// What friction has taken since the start, joules.
    pub dissipated: f64,
    /// The energies.
    pub energy: Energy,
    /// What the tool has given to its surroundings since the start, joules.
    pub exerted: f64,
    /// The joint variables.
    pub q: Vec<f64>,
    /// Their rates.
    pub qd: Vec<f64>,
    /// What the torques have supplied since the start, joules.
    pub supplied: f64,
    /// Seconds.
    pub t: f64,
    /// The torques.
    pub torques: Vec<f64>,
}

impl Motion {
    /// A motion of a robot; why it ends before it was to; the joints that leave their limits.
    pub fn of(robot: &str, found: &Simulation, ends: Option<String>, leaves: Vec<Left>) -> Self {
        let sample = |m: &Moment| Sample {
            dissipated: m.dissipated,
            energy: Energy { kinetic: m.kinetic, potential: m.potential },
            exerted: m.exerted,
            q: m.q.clone(),
            qd: m.qd.clone(),
            supplied: m.supplied,
            t: m.t,
            torques: m.torques.clone(),
        };
        Motion {
            drift: found.drift().0,
            ends,
            leaves,
            robot: robot.into(),
            samples: found.moments.iter().map(sample).collect(),
            schema: Schema,
            steps: found.steps,
        }
    }
}

/// The model as formulas.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Model {
    /// The base parameters, link by link.
    pub base_parameters: Vec<Base>,
    /// What the steps cost.
    pub count: Operations,
    /// What the steps and the groupings divide by: where one of these is 0 they do not hold.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub divides_by: Vec<String>,
    /// Gravity by its components in the base, as formulas.
    pub gravity: [String; 3],
    /// Whether the base parameters are proved to be the fewest.
    pub minimal: bool,
    /// A(q), C(q, q̇) q̇ and Q(q), of arms with few joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<Parts>,
    /// On what it rests that the torques are Lagrange's: `proved`, `sampled` (equal at random states), `failed`.
    pub proof: &'static str,
    /// The recursion of Newton and Euler, where it is to be explained.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recursion: Option<Recursive>,
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

/// The recursion of Newton and Euler, step by step.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Recursive {
    /// From the tip to the base: what moves the links, `f` and `n`.
    pub inward: Vec<OfLink>,
    /// From the base to the tip: how the links move, `w`, `wd`, `U`, `a`.
    pub outward: Vec<OfLink>,
    /// On what it rests that the torques are Lagrange's.
    pub proof: &'static str,
    /// The torques.
    pub torques: Vec<Step>,
}

/// Quantities of a link.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct OfLink {
    /// The link, from 1.
    pub link: usize,
    /// On what it rests that it moves so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<&'static str>,
    /// Each by those before.
    pub steps: Vec<Step>,
}

impl Recursive {
    /// A recursion, its formulas printed by `text`.
    pub fn of(recursion: &Recursion, text: impl Fn(Expr) -> String) -> Self {
        let steps = |all: &[(Symbol, Expr)]| -> Vec<Step> {
            all.iter()
                .map(|(s, e)| Step { name: s.name().to_string(), output: false, value: text(*e) })
                .collect()
        };
        let outward =
            |o: &Outward| OfLink { link: o.link + 1, proof: Some(word(o.ground)), steps: steps(&o.steps) };
        let inward = |i: &Inward| OfLink { link: i.link + 1, proof: None, steps: steps(&i.steps) };
        Recursive {
            inward: recursion.inward.iter().map(inward).collect(),
            outward: recursion.outward.iter().map(outward).collect(),
            proof: word(recursion.ground),
            torques: steps(&recursion.torques),
        }
    }
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
            divides_by: list(&model.divisors()),
            gravity: model.formulas.dynamics.gravity.0.map(&text),
            minimal: model.base.minimality == Minimality::Proved,
            parts: model.parts.as_ref().map(|p| Parts {
                gravity: list(&p.gravity),
                inertia: p.inertia.iter().map(|row| list(row)).collect(),
                proof: word(p.ground),
                velocity: list(&p.velocity),
            }),
            proof: word(model.ground),
            recursion: None,
            robot: robot.into(),
            schema: Schema,
            steps: model.torques.steps().iter().map(|s| Step::of(s, &text)).collect(),
            without_effect: idle.map(|f| f.0.name().to_string()).collect(),
        }
    }
}
