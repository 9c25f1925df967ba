//! How far one description is another: proved the same function of the joint variables, or how far apart in samples.
//!
//! What was written in a format that knows decimals only comes back with the digits of doubles: then no proof can succeed, and
//! what can be said is by how much poses differ in configurations that look random.

use super::{MissingValue, Robot};
use crate::description::{Description, JointKind, compare_screws, prove_same_chain};
use crate::geometry::Transform;
use crate::random::Random;
use denavit_symbolic::Expr;
use std::f64::consts::PI;

/// How many configurations are compared.
pub const COMPARED: usize = 256;

/// Slides are compared from minus to plus this many metres, turns from −π to π; what has limits, within them.
const FAR: f64 = 0.5;

/// How two descriptions agree.
#[derive(Clone, PartialEq, Debug)]
pub enum Comparison {
    /// Proved: the same pose for all values of the joint variables.
    Proved,
    /// Not proved; in [`COMPARED`] configurations the entries of the matrices of the tool in the base differ by this at most
    /// (directions, and metres).
    Sampled(f64),
    /// They do not have the same joint variables: their kinds, in order, are not the same.
    OtherJoints,
    /// Not proved, and a parameter has no value to compare with.
    NoNumbers(MissingValue),
}

/// By how much poses differ that are computed in doubles of one arm written twice, directions and metres: of 250 rows by less.
const ROUNDING: f64 = 1e-11;

impl Comparison {
    /// True if poses differ by more than doubles round by, or joints are others.
    pub fn differs(&self) -> bool {
        match self {
            Comparison::Proved | Comparison::NoNumbers(_) => false,
            // What is no number is more.
            Comparison::Sampled(by) => by.is_nan() || *by > ROUNDING,
            Comparison::OtherJoints => true,
        }
    }
}

/// Compares two descriptions joint by joint; the first one's parameters may have their values in the other.
pub fn compare(a: &Description, b: &Description) -> Comparison {
    let kinds = |d: &Description| d.variables().iter().map(|v| v.kind).collect::<Vec<_>>();
    if kinds(a) != kinds(b) {
        return Comparison::OtherJoints;
    }
    let (a_numbers, b_numbers) = (a.in_numbers(), b.in_numbers());
    let is_proved =
        || prove_same_chain(a, b).is_equal() || prove_same_chain(&a_numbers, &b_numbers).is_equal();
    // What is another function by its axes need not be multiplied out.
    if compare_screws(&a_numbers, &b_numbers).unwrap_or_else(is_proved) {
        return Comparison::Proved;
    }
    let (one, other) = match (Robot::numeric(a), Robot::numeric(b)) {
        (Ok(one), Ok(other)) => (one, other),
        (Err(missing), _) | (_, Err(missing)) => return Comparison::NoNumbers(missing),
    };
    let ranges: Vec<[f64; 2]> =
        a.rows.iter().filter_map(|r| Some(range(r.variable?.kind, r.limits))).collect();
    let mut random = Random(20);
    let mut most = 0.0_f64;
    for _ in 0..COMPARED {
        let q: Vec<f64> = ranges.iter().map(|[low, high]| low + (high - low) * random.unit()).collect();
        most = apart(most, &one.pose(&q), &other.pose(&q));
    }
    Comparison::Sampled(most)
}

/// The largest difference of entries, or what was larger before.
pub(super) fn apart(most: f64, x: &Transform<f64>, y: &Transform<f64>) -> f64 {
    let (x, y) = (x.matrix().concat(), y.matrix().concat());
    x.iter().zip(y).fold(most, |most, (x, y)| largest(most, (x - y).abs()))
}

/// Where values of a variable are taken from.
pub(super) fn range(kind: JointKind, limits: Option<[Expr; 2]>) -> [f64; 2] {
    let all = match kind {
        JointKind::Revolute => [-PI, PI],
        JointKind::Prismatic => [-FAR, FAR],
    };
    let numbers = limits.map(|l| l.map(|e| e.eval(|_| None).unwrap_or(f64::NAN)));
    numbers.filter(|[low, high]| low < high && (high - low).is_finite()).unwrap_or(all)
}

/// The larger one; what is no number is larger than any.
fn largest(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}
