//! Singular configurations as formulas: where the Jacobian loses rank, what is lost there, what comes free.

mod found;
mod minors;
mod place;
mod sample;
mod together;

pub use found::singular_configurations;
pub use minors::Minor;
pub use place::{Place, Still};
pub use sample::singular_configuration;

use super::geometric::{Jacobian, Viewpoint, geometric};
use super::inverse::RateFormulas;
use super::measures::Whole;
use super::model::JacobianModel;
use crate::description::Description;
use crate::forward::{Reference, symbol_order};
use crate::geometry::Vector;
use crate::mechanism::Robot;
use crate::space::JointSpace;
use denavit_symbolic::factor::{Factored, Zero, zeros};
use denavit_symbolic::{Expr, Refusal};
use std::fmt;
use together::{Known, never_all_zero, zero_at_once};

/// Joints beyond which minors are not expanded.
pub const MAX_JOINTS: usize = 8;

/// Why the singularities are not known as formulas.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Obstacle {
    /// The Jacobian or a determinant is too large to expand.
    TooLarge(Refusal),
    /// More joints than [`MAX_JOINTS`].
    ManyJoints(usize),
    /// The body has fewer freedoms than joints in every configuration, by more than one: so many at most.
    AlwaysSingular(usize),
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Obstacle::TooLarge(why) => write!(f, "the determinant is not expanded: {why}"),
            Obstacle::ManyJoints(n) => {
                write!(f, "{n} joints are too many: minors are expanded up to {MAX_JOINTS}")
            }
            Obstacle::AlwaysSingular(rank) => {
                write!(f, "every configuration is singular: the rank is {rank} at the most")
            }
        }
    }
}

impl std::error::Error for Obstacle {}

/// Where an arm is singular.
#[derive(Clone, Debug)]
pub struct Singularities {
    /// The Jacobian where it is shortest; its determinant is the same in every frame and at every point.
    pub jacobian: JacobianModel,
    /// The rows that count, from 0: all six, or those of the position.
    pub rows: Vec<usize>,
    /// The largest square parts that are not identically 0. With six joints the determinant itself; with fewer, of some
    /// rows; with more, of some joints. The arm is singular where all of them are 0.
    pub minors: Vec<Minor>,
    /// The rank where the arm is not singular, if it is one less than rows and joints allow: a direction is lost in every
    /// configuration, and the minors have one row and one joint less.
    pub deficient: Option<usize>,
    /// The factors that all minors share, each a singularity of its own.
    pub common: Vec<Singularity>,
    /// Whether it is proved that the minors have no common zeros beside: there is a single one, nothing is left of one, or what
    /// is left of all is never 0 at once (lengths that are named and have no value are taken to be other than 0).
    pub is_complete: bool,
    /// Where the minors are 0 at once beside: each list of factors that are all 0, and nowhere else; nothing if there are too many
    /// such lists, none if the common factors are all.
    pub others: Option<Vec<Vec<Expr>>>,
    /// The joint velocities for a twist as formulas, where they are short.
    pub rates: Option<RateFormulas>,
}

/// One singularity: the zeros of a factor.
#[derive(Clone, Debug)]
pub struct Singularity {
    /// What is 0 there.
    pub factor: Expr,
    /// How often it divides the determinant.
    pub power: u32,
    /// The factor solved for an angle, where that is simple.
    pub zeros: Vec<Zero>,
    /// A configuration where this factor alone is 0, and what happens there; `None` if there is none: the factor is
    /// never 0 with the lengths of the robot.
    pub example: Option<Example>,
}

/// What happens at a singular configuration.
#[derive(Clone, PartialEq, Debug)]
pub struct Example {
    /// The configuration.
    pub q: Vec<f64>,
    /// Motions of the joints that leave at rest what is asked for, the largest component 1 or −1 (radians, metres); none where
    /// other joints move elsewhere on the singularity.
    pub free: Vec<Vec<f64>>,
    /// What is at rest then.
    pub still: Still,
    /// Twists that cannot be had, in the frame and at the point of the Jacobian: whatever the joints do, the sum of
    /// products with the twist's components is 0. Directions in which the arm never moves are left out, and all where
    /// other kinds are lost elsewhere on the singularity.
    pub lost: Vec<[f64; 6]>,
    /// How the axes lie that makes it singular.
    pub place: Place,
}

impl Example {
    /// What is the same here and at others: a place that differs is said to, motions of other joints and twists of other kinds are
    /// left out.
    fn everywhere(self, others: &[Self]) -> Self {
        let moving = |e: &Self| -> Vec<Vec<bool>> {
            e.free.iter().map(|f| f.iter().map(|x| *x != 0.0).collect()).collect()
        };
        // Along or about one axis, or else linear, angular or both.
        let kinds = |e: &Self| -> Vec<(bool, bool, Option<usize>)> {
            let kind = |w: &[f64; 6]| {
                let parts: Vec<usize> = (0..6).filter(|&k| w[k] != 0.0).collect();
                let one = if let [k] = parts[..] { Some(k) } else { None };
                (parts.iter().any(|&k| k < 3), parts.iter().any(|&k| k >= 3), one)
            };
            e.lost.iter().map(kind).collect()
        };
        let is_still = others.iter().all(|e| e.still == self.still && e.free.len() == self.free.len());
        // Of several motions each basis is as good as another.
        let moves_alike =
            is_still && (self.free.len() != 1 || others.iter().all(|e| moving(e) == moving(&self)));
        let loses_alike = others.iter().all(|e| kinds(e) == kinds(&self));
        let places: Vec<&Place> = others.iter().chain([&self]).map(|e| &e.place).collect();
        let place = match places.iter().all(|p| **p == self.place) {
            true => self.place.clone(),
            false => Place::shared(&places).unwrap_or(Place::Differs),
        };
        let is_one_place = place == self.place;
        let free = if moves_alike && is_one_place { self.free } else { vec![] };
        Example { place, free, lost: if loses_alike { self.lost } else { vec![] }, ..self }
    }
}

impl Singularities {
    /// Those of a body.
    ///
    /// # Errors
    /// See [`Obstacle`].
    pub fn derive(description: &Description, body: Reference) -> Result<Self, Obstacle> {
        bounded(description)?;
        Self::of(description, JacobianModel::shortest(description, body), &[0, 1, 2, 3, 4, 5])
    }

    /// Those of the position of a body's origin, its orientation left aside.
    ///
    /// # Errors
    /// See [`Obstacle`].
    pub fn of_position(description: &Description, body: Reference) -> Result<Self, Obstacle> {
        bounded(description)?;
        Self::of(description, JacobianModel::shortest_at_origin(description, body), &[0, 1, 2])
    }

    /// Those of the origin of the body alone, where the arm has three joints at the most, these are all six rows' and the origin
    /// gets stuck elsewhere than the body: what most people ask for of such an arm.
    #[must_use]
    pub fn of_its_point(&self, description: &Description) -> Option<Self> {
        let body = self.jacobian.view.body;
        if self.rows.len() < 6 || description.variables().len() > 3 {
            return None;
        }
        let factors = |s: &Self| s.common.iter().map(|one| one.factor).collect::<Vec<_>>();
        let point = Self::of_position(description, body).ok()?;
        (factors(&point) != factors(self) || point.is_complete != self.is_complete).then_some(point)
    }

    /// Those of some rows of a Jacobian.
    fn of(description: &Description, jacobian: JacobianModel, rows: &[usize]) -> Result<Self, Obstacle> {
        let matrix = jacobian.matrix.as_ref().map_err(|why| Obstacle::TooLarge(*why))?;
        let minors = minors::all(matrix, rows, &symbol_order(description)).map_err(Obstacle::TooLarge)?;
        let Some(first) = minors.first() else {
            let moved = |&&r: &&usize| matrix.columns.iter().any(|c| !c[r].is_zero());
            let bound = rows.iter().filter(moved).count();
            return Err(Obstacle::AlwaysSingular(minors::rank(matrix, rows).saturating_sub(2).min(bound)));
        };
        let size = first.rows.len();
        let deficient = (size < minors::rank(matrix, rows)).then_some(size);
        let shared: Vec<(Expr, u32)> = first
            .determinant
            .factors
            .iter()
            .filter_map(|&(f, n)| Some((f, n.min(minors.iter().map(|m| power(&m.determinant, f)).min()?))))
            .filter(|&(f, n)| n > 0 && varies(description, f))
            .collect();
        let left = |m: &Minor| -> Vec<Expr> {
            let own = |f: Expr| shared.iter().find(|s| s.0 == f).map_or(0, |s| s.1);
            let factors = m.determinant.factors.iter();
            factors.filter(|&&(f, n)| n > own(f) && varies(description, f)).map(|f| f.0).collect()
        };
        let products: Vec<Vec<Expr>> = minors.iter().map(left).collect();
        let all: Vec<Expr> = shared.iter().map(|s| s.0).collect();
        let others = if products.iter().any(Vec::is_empty) {
            Some(vec![])
        } else {
            let variables = description.variables().iter().map(|v| v.symbol).collect();
            let known = Known { variables, values: description.known_values() };
            // A length in front of one may be 0 with the values of the robot: that one says nothing.
            let vanishes = |f: Expr| !varies(description, f) && known.may_vanish(f);
            let counts = |m: &Minor| !m.determinant.factors.iter().any(|f| vanishes(f.0));
            let sure: Vec<Vec<Expr>> =
                minors.iter().zip(products).filter(|(m, _)| counts(m)).map(|m| m.1).collect();
            if never_all_zero(&sure, &known) { Some(vec![]) } else { zero_at_once(&sure, &all, &known) }
        };
        let is_complete = others.as_ref().is_some_and(Vec::is_empty);
        let finder = sample::Finder::new(description);
        let common = shared
            .iter()
            .map(|&(factor, power)| {
                let at = |near: Option<&[f64]>| {
                    let (robot, q) = finder.find(factor, &all, near)?;
                    Some(example(description, &robot, &jacobian.view, rows, q))
                };
                let example = at(None).map(|found| {
                    let others: Vec<Example> =
                        finder.starts(OTHERS).iter().filter_map(|q| at(Some(q))).collect();
                    found.everywhere(&others)
                });
                Singularity { factor, power, zeros: zeros(factor), example }
            })
            .collect();
        let rates = RateFormulas::derive(description, &jacobian).map_err(Obstacle::TooLarge)?;
        Ok(Singularities {
            jacobian,
            rows: rows.to_vec(),
            minors,
            deficient,
            common,
            is_complete,
            others,
            rates,
        })
    }
}

/// Configurations at which what happens at one is looked at again.
const OTHERS: usize = 3;

/// A body turns that is faster than this where the fastest joint has 1 rad/s.
const TURNS: f64 = 1e-6;

/// Whether there are few enough joints.
fn bounded(description: &Description) -> Result<(), Obstacle> {
    let joints = description.variables().len();
    if joints > MAX_JOINTS { Err(Obstacle::ManyJoints(joints)) } else { Ok(()) }
}

fn power(determinant: &Factored, factor: Expr) -> u32 {
    determinant.factors.iter().find(|f| f.0 == factor).map_or(0, |f| f.1)
}

/// Whether a formula depends on the configuration.
fn varies(description: &Description, e: Expr) -> bool {
    let variables = description.variables();
    e.symbols().iter().any(|s| variables.iter().any(|v| v.symbol == *s))
}

/// What happens at a configuration, in some rows.
fn example(
    description: &Description,
    robot: &Robot<f64>,
    view: &Viewpoint<Expr>,
    rows: &[usize],
    q: Vec<f64>,
) -> Example {
    let space = JointSpace::new(description, robot);
    let length = if space.reach > 0.0 { space.reach } else { 1.0 };
    // The Jacobian is taken at an origin.
    let view = Viewpoint { axes: view.axes, body: view.body, at: view.at, offset: Vector::zero() };
    let whole_body = geometric(robot, &q, &view);
    // Joints that do not move the body are free in every configuration: here, and anywhere else. Directions in which no joint
    // ever moves it are not lost here.
    let elsewhere: Vec<f64> = q.iter().enumerate().map(|(j, x)| x + 0.6 + 0.2 * j as f64).collect();
    let there = geometric(robot, &elsewhere, &view);
    let is_had = |&r: &usize| {
        let least = if r < 3 { TURNS * length } else { TURNS };
        [&whole_body, &there].iter().any(|at| at.columns.iter().any(|c| c[r].abs() > least))
    };
    let had: Vec<usize> = rows.iter().copied().filter(is_had).collect();
    let rows = &had[..];
    let mut jacobian = whole_body.clone();
    for column in &mut jacobian.columns {
        (0..6).filter(|r| !rows.contains(r)).for_each(|r| column[r] = 0.0);
    }
    let moves =
        |&j: &usize| [&whole_body, &there].iter().any(|at| rows.iter().any(|&r| at.columns[j][r] != 0.0));
    let moving: Vec<usize> = (0..q.len()).filter(moves).collect();
    let part = Jacobian { columns: moving.iter().map(|&j| jacobian.columns[j]).collect() };
    let is_angle: Vec<bool> = moving.iter().map(|&j| space.is_angle[j]).collect();
    let whole = Whole::new(&part, &is_angle, length);
    let in_units = |v: &Vec<f64>| {
        let mut all = vec![0.0; q.len()];
        for (&j, x) in moving.iter().zip(v) {
            all[j] = if space.is_angle[j] { *x } else { x * length };
        }
        normal(all)
    };
    let free: Vec<Vec<f64>> = whole.free.iter().map(in_units).collect();
    let is_asked = |w: &&[f64; 6]| (0..6).all(|r| rows.contains(&r) || w[r].abs() < 1e-9);
    let lost = whole.lost.iter().filter(is_asked).map(|w| {
        let n = normal((0..6).map(|k| if k < 3 { w[k] / length } else { w[k] }).collect());
        std::array::from_fn(|k| n[k])
    });
    let turns = |v: &Vec<f64>| whole_body.twist(v)[3..].iter().any(|w| w.abs() > TURNS);
    let still = if free.iter().any(turns) { Still::Point } else { Still::Body };
    let place = Place::of(robot, (view.body, still), &q, &free);
    Example { lost: lost.collect(), q, free, still, place }
}

/// The largest component made 1, rounding errors made 0.
fn normal(v: Vec<f64>) -> Vec<f64> {
    let largest = v.iter().fold(0.0_f64, |m, x| if x.abs() > m.abs() + 1e-9 { *x } else { m });
    v.iter().map(|x| if x.abs() < 1e-7 * largest.abs() { 0.0 } else { x / largest }).collect()
}
