//! Jacobians in numbers: velocities, forces, how well the body moves.

use crate::Schema;
use crate::pose::Orientation;
use denavit::forward::Reference;
use denavit::velocity::{self, Damping, JointRates, NearestSingularity, ROWS, Whole};
use serde::Serialize;

/// A Jacobian, row by row, an entry a joint: m/s and rad/s by the joints' own units.
pub type Rows = [Vec<f64>; 6];

/// `base`, `tool`, or the number of a frame.
pub fn frame(frame: Reference) -> String {
    match frame {
        Reference::Base => "base".into(),
        Reference::Tool => "tool".into(),
        Reference::Frame(i) => i.to_string(),
    }
}

/// The Jacobian alone.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Matrix<'a> {
    /// Along whose axes.
    pub frame: &'a str,
    /// Six rows, an entry a joint.
    pub jacobian: Vec<&'a [f64]>,
    /// The joint variables.
    pub q: &'a [f64],
    /// The robot's name.
    pub robot: &'a str,
    /// `vx` … `wz`.
    pub rows: [&'static str; 6],
    /// The version.
    pub schema: Schema,
}

impl<'a> Matrix<'a> {
    /// From its entries, row by row.
    pub fn of(robot: &'a str, frame: &'a str, q: &'a [f64], entries: &'a [f64]) -> Self {
        let jacobian = entries.chunks(q.len().max(1)).collect();
        Matrix { frame, jacobian, q, robot, rows: ROWS, schema: Schema }
    }

    /// Appends a line; compiled here, because there may be millions.
    pub fn write(&self, out: &mut Vec<u8>) {
        crate::line(self, out);
    }
}

/// Everything about a configuration; with orientation, rates, twist, wrench or derivatives where those were asked for.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Answer {
    /// The rates of an orientation's values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub analytic: Option<Analytic>,
    /// The rows wx, wy, wz.
    pub angular: Measures,
    /// The origin that the point is given from.
    pub at: String,
    /// The largest singular value by the smallest, lengths by `length`; null if it is infinite.
    pub condition: f64,
    /// J̇q̇ at the rates that were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<[f64; 6]>,
    /// Along whose axes.
    pub frame: String,
    /// Motions of the joints that leave the body at rest, orthonormal.
    pub free: Vec<Vec<f64>>,
    /// For each joint the derivative of the Jacobian.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hessian: Option<Vec<Rows>>,
    /// The Jacobian.
    pub jacobian: Rows,
    /// J̇ at the rates that were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jacobian_rate: Option<Rows>,
    /// What gives the twist that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_rates: Option<Rates>,
    /// What the file calls the joints, where it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<Vec<String>>,
    /// By how much the wrench can grow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_wrench: Option<Largest>,
    /// What lengths are divided by where they stand beside angles.
    pub length: f64,
    /// The rows vx, vy, vz.
    pub linear: Measures,
    /// Directions in which the body cannot move, orthonormal.
    pub lost: Vec<[f64; 6]>,
    /// The product of the singular values, lengths by `length`.
    pub manipulability: f64,
    /// A singular configuration nearby.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest_singularity: Option<Near>,
    /// Whose velocity.
    pub of: String,
    /// The joint variables.
    pub q: Vec<f64>,
    /// The rank.
    pub rank: usize,
    /// The robot's name.
    pub robot: String,
    /// `vx` … `wz`.
    pub rows: [&'static str; 6],
    /// The version.
    pub schema: Schema,
    /// The singular values, descending, lengths by `length`.
    pub singular_values: Vec<f64>,
    /// What holds the wrench, N·m and N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torques: Option<Vec<f64>>,
    /// The twist at the rates that were given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub twist: Option<[f64; 6]>,
}

/// How well a body moves.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Measures {
    /// The largest singular value by the smallest; null if it is infinite.
    pub condition: f64,
    /// The product of the singular values.
    pub manipulability: f64,
    /// Descending.
    pub singular_values: Vec<f64>,
}

impl From<&velocity::Block> for Measures {
    fn from(block: &velocity::Block) -> Self {
        Measures {
            condition: block.condition,
            manipulability: block.manipulability,
            singular_values: block.singular_values.clone(),
        }
    }
}

impl From<&Whole> for Measures {
    fn from(whole: &Whole) -> Self {
        Measures {
            condition: whole.condition,
            manipulability: whole.manipulability,
            singular_values: whole.singular_values.clone(),
        }
    }
}

/// The rates of position and of an orientation's values.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Analytic {
    /// A row for each of `rows`, an entry a joint.
    pub jacobian: Vec<Vec<f64>>,
    /// What the rows are the rates of.
    pub rows: Vec<String>,
    /// The set of values.
    pub set: String,
    /// Whether it is singular here.
    pub singular: bool,
    /// The orientation.
    pub values: Vec<f64>,
}

impl Analytic {
    /// An orientation and its rates.
    pub fn of(orientation: Orientation, rates: &velocity::AnalyticJacobian<f64>) -> Self {
        let Orientation { set, singular, values } = orientation;
        Analytic { jacobian: rates.rows.clone(), rows: rates.names.clone(), set, singular, values }
    }
}

/// Joint velocities for a twist.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Rates {
    /// The twist that they give.
    pub achieved: [f64; 6],
    /// Singular values that were damped.
    pub damped: Vec<f64>,
    /// How singular values are damped.
    pub damping: Damped,
    /// The velocities, one a joint.
    pub rates: Vec<f64>,
    /// What they were multiplied with so that none exceeds its limit.
    pub scale: f64,
}

/// The bounds of a damping.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Damped {
    /// λ where the arm is singular.
    pub largest: f64,
    /// Singular values below this are damped.
    pub threshold: f64,
}

impl Rates {
    /// What was solved, and how it was damped.
    pub fn of(solved: &JointRates, damping: &Damping) -> Self {
        Rates {
            achieved: solved.achieved,
            damped: solved.damped.clone(),
            damping: Damped { largest: damping.largest, threshold: damping.threshold },
            rates: solved.rates.clone(),
            scale: solved.scale,
        }
    }
}

/// A singular configuration.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Near {
    /// How far: the norm of the joints' differences, slides by the arm's size.
    pub distance: f64,
    /// The joint variables.
    pub q: Vec<f64>,
}

impl From<&NearestSingularity> for Near {
    fn from(found: &NearestSingularity) -> Self {
        Near { distance: found.distance, q: found.q.clone() }
    }
}

/// How far a wrench can grow.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Largest {
    /// By what it can be multiplied.
    pub factor: f64,
    /// The joint that is at its limit then.
    pub joint: usize,
}
