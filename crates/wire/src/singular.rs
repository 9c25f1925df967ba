//! The Jacobian as formulas, and where it is singular.

use crate::jacobian::frame;
use crate::program::{Named, Operations, Step};
use crate::{Schema, words};
use denavit::symbolic::factor::Zero;
use denavit::velocity::{self, JacobianModel, Minor, ROWS, RateFormulas, Still};
use denavit_report::words::{Terms as _, Velocity as _};
use denavit_symbolic::Expr;
use serde::Serialize;

/// A Jacobian as formulas; with where it is singular if that was asked for.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Model {
    /// Why it is singular everywhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub always_singular: Option<String>,
    /// The origin that the point is given from.
    pub at: String,
    /// Whether the singularities are all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub complete: Option<bool>,
    /// What the steps cost.
    pub count: Operations,
    /// Square parts that are 0 where it is singular.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub determinants: Option<Vec<Determinant>>,
    /// Along whose axes.
    pub frame: String,
    /// The matrix, six rows; null if it is too large to expand.
    pub jacobian: Option<[Vec<String>; 6]>,
    /// The joint velocities for a twist, where they are short.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_rates: Option<Rates>,
    /// Whose velocity.
    pub of: String,
    /// Lists of factors: all determinants are 0, too, where all of one list are; not there if there are too many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub others: Option<Vec<Vec<String>>>,
    /// Where its origin alone is singular, the orientation left aside: of arms with three joints at the most, if that is elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<Point>,
    /// What is proved of the steps.
    pub proof: String,
    /// The robot's name.
    pub robot: String,
    /// `vx` … `wz`.
    pub rows: [&'static str; 6],
    /// The version.
    pub schema: Schema,
    /// Where the determinant is not expanded, configurations that were found in numbers, one of each kind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub singular_configurations: Option<Vec<Example>>,
    /// What the determinants have in common.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub singularities: Option<Vec<Singularity>>,
    /// A program for the matrix.
    pub steps: Vec<Step>,
    /// Why the determinant is not expanded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unexpanded: Option<String>,
}

/// Where the origin of a body alone is singular.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Point {
    /// Whether the singularities are all.
    pub complete: bool,
    /// Square parts of its three rows that are 0 where it is singular.
    pub determinants: Vec<Determinant>,
    /// What the determinants have in common.
    pub singularities: Vec<Singularity>,
}

impl Point {
    fn of(found: &velocity::Singularities, text: impl Fn(Expr) -> String + Copy) -> Self {
        Point {
            complete: found.is_complete,
            determinants: found.minors.iter().map(|m| Determinant::of(m, text)).collect(),
            singularities: found.common.iter().map(|s| Singularity::of(s, text)).collect(),
        }
    }
}

/// A square part of the Jacobian.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Determinant {
    /// In factors.
    pub determinant: String,
    /// Its joints.
    pub joints: Vec<usize>,
    /// Its rows by name.
    pub rows: Vec<&'static str>,
}

impl Determinant {
    fn of(m: &Minor, text: impl Fn(Expr) -> String) -> Self {
        Determinant {
            determinant: text(m.determinant.to_expr()),
            joints: m.joints.iter().map(|j| j + 1).collect(),
            rows: m.rows.iter().map(|&r| ROWS[r]).collect(),
        }
    }
}

/// The zeros of a factor.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Singularity {
    /// A configuration where this factor alone is 0.
    pub example: Option<Example>,
    /// What is 0.
    pub factor: String,
    /// How often it divides the determinant.
    pub power: u32,
    /// The factor solved for an angle, where that is simple.
    pub zeros: Vec<Zeros>,
}

impl Singularity {
    fn of(s: &velocity::Singularity, text: impl Fn(Expr) -> String + Copy) -> Self {
        Singularity {
            example: s.example.as_ref().map(Example::from),
            factor: text(s.factor),
            power: s.power,
            zeros: s.zeros.iter().map(|z| Zeros::of(z, text)).collect(),
        }
    }
}

/// Values of an angle.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Zeros {
    /// The angle: `q5`, `q2 + q3`.
    pub angle: String,
    /// Its values.
    pub values: Vec<String>,
}

impl Zeros {
    /// Zeros, printed by `text`.
    pub fn of(zero: &Zero, text: impl Fn(Expr) -> String) -> Self {
        Zeros { angle: text(zero.angle()), values: zero.values().into_iter().map(text).collect() }
    }
}

/// What happens at a singular configuration.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Example {
    /// Motions of the joints that leave what is asked for where it is.
    pub free: Vec<Vec<f64>>,
    /// Twists that cannot be had.
    pub lost: Vec<[f64; 6]>,
    /// The joint variables.
    pub q: Vec<f64>,
    /// What stands still where the joints move so: `body`, or `point`.
    pub still: &'static str,
    /// How the axes lie.
    pub why: String,
}

impl From<&velocity::Example> for Example {
    fn from(e: &velocity::Example) -> Self {
        let still = match e.still {
            Still::Body => "body",
            Still::Point => "point",
        };
        let (free, lost, q) = (e.free.clone(), e.lost.clone(), e.q.clone());
        Example { free, lost, q, still, why: words().place(&e.place) }
    }
}

/// Joint velocities for a twist `vx` … `wz`, as formulas.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Rates {
    /// What must not be 0.
    pub not_zero: Vec<String>,
    /// Whether it is proved.
    pub proved: bool,
    /// Names and formulas; the velocity of joint 1 is `dq1`.
    pub steps: Vec<Named>,
}

impl Rates {
    fn of(rates: &RateFormulas, text: impl Fn(Expr) -> String) -> Self {
        let named = |(name, value): &(String, Expr)| Named { name: name.clone(), value: text(*value) };
        Rates {
            not_zero: rates.conditions.iter().map(|&c| text(c)).collect(),
            proved: rates.is_proved,
            steps: rates.steps.iter().map(named).collect(),
        }
    }
}

impl Model {
    /// The matrix of a robot, formulas printed by `text`.
    pub fn of(robot: &str, model: &JacobianModel, text: impl Fn(Expr) -> String + Copy) -> Self {
        let matrix = model.matrix.as_ref().ok();
        Model {
            always_singular: None,
            at: frame(model.view.at),
            complete: None,
            count: Operations::from(&model.algorithm.count()),
            determinants: None,
            frame: frame(model.view.axes),
            jacobian: matrix.map(|m| m.rows().map(|row| row.into_iter().map(text).collect())),
            joint_rates: None,
            of: frame(model.view.body),
            others: None,
            point: None,
            proof: words().jacobian_proof(model.proof),
            robot: robot.into(),
            rows: ROWS,
            schema: Schema,
            singular_configurations: None,
            singularities: None,
            steps: model.algorithm.steps().iter().map(|s| Step::of(s, text)).collect(),
            unexpanded: None,
        }
    }

    /// The matrix with what was found in numbers (nothing if it was not looked for), where the singularities are not had
    /// as formulas.
    pub fn without_singularities(
        robot: &str,
        model: &JacobianModel,
        why: &velocity::Obstacle,
        found: Option<&[velocity::Example]>,
        text: impl Fn(Expr) -> String + Copy,
    ) -> Self {
        let is_everywhere = matches!(why, velocity::Obstacle::AlwaysSingular(_));
        Model {
            always_singular: is_everywhere.then(|| why.to_string()),
            singular_configurations: found
                .filter(|_| !is_everywhere)
                .map(|found| found.iter().map(Example::from).collect()),
            unexpanded: (!is_everywhere).then(|| why.to_string()),
            ..Self::of(robot, model, text)
        }
    }

    /// The matrix with where it is singular, and where its origin alone is if that is looked at, too.
    pub fn with_singularities(
        robot: &str,
        found: &velocity::Singularities,
        point: Option<&velocity::Singularities>,
        text: impl Fn(Expr) -> String + Copy,
    ) -> Self {
        Model {
            always_singular: found.deficient.map(|rank| velocity::Obstacle::AlwaysSingular(rank).to_string()),
            complete: Some(found.is_complete),
            determinants: Some(found.minors.iter().map(|m| Determinant::of(m, text)).collect()),
            joint_rates: found.rates.as_ref().map(|rates| Rates::of(rates, text)),
            others: found
                .others
                .as_ref()
                .map(|sets| sets.iter().map(|set| set.iter().map(|&f| text(f)).collect()).collect()),
            point: point.map(|point| Point::of(point, text)),
            singularities: Some(found.common.iter().map(|s| Singularity::of(s, text)).collect()),
            ..Self::of(robot, &found.jacobian, text)
        }
    }
}
