//! How near a path of the joints comes to a singular configuration, in numbers.
//!
//! The smallest singular value of the Jacobian changes by no more than the Jacobian does (Weyl's inequality), and that by no
//! more than a bound on its derivatives times the way of the joints: where the value in the middle of a part exceeds what
//! half the part can take from it, nothing there is singular.

use super::between::HermitePath;
use crate::mechanism::{Link, Robot};
use crate::motion::path::JointPath;
use crate::space::JointSpace;
use crate::velocity::{Viewpoint, Whole, geometric};

/// How near a path comes to a singular configuration.
#[derive(Clone, PartialEq, Debug)]
pub struct Clearance {
    /// Where it is nearest.
    pub s: f64,
    /// The configuration there.
    pub q: Vec<f64>,
    /// The smallest singular value of the Jacobian there, lengths by the reach.
    pub smallest: f64,
    /// Whether it is proved that nothing on the path is singular.
    pub is_certain: bool,
}

/// Places that are looked at, at most.
const PLACES: usize = 20_000;
/// A part is halved so often.
const HALVINGS: u32 = 16;
/// What rounding takes from a singular value.
const ROUNDING: f64 = 1e-12;
/// Halvings of the search for the nearest place.
const NEARER: u32 = 40;

/// What the joints can do to the Jacobian of an arm.
struct Bounds<'a> {
    robot: &'a Robot<f64>,
    space: &'a JointSpace,
    /// For each joint, in its unit, what it changes the Jacobian by at most (Frobenius norm).
    rates: Vec<f64>,
    nearest: (f64, f64),
    places: usize,
}

impl Clearance {
    /// Along a path.
    pub(super) fn of(robot: &Robot<f64>, space: &JointSpace, path: &HermitePath) -> Self {
        let movers = |j: usize| robot.links.iter().flat_map(Link::movers).filter(move |m| m.joint == j);
        let factors: Vec<f64> = (0..robot.joints).map(|j| movers(j).map(|m| m.factor.abs()).sum()).collect();
        let furthest = |j: usize| path.samples().iter().map(|q| q[j].abs()).fold(0.0, f64::max);
        let slides = (0..robot.joints).filter(|&j| !space.is_angle[j]);
        // A cubic between samples goes a little beyond them.
        let far = 1.0 + 2.0 * slides.map(|j| factors[j] * furthest(j)).sum::<f64>() / space.length();
        let all = factors.iter().map(|k: &f64| k * k).sum::<f64>().sqrt() * (1.0 + far * far).sqrt();
        let rates = factors.iter().map(|k| k * all).collect();
        let mut bounds = Bounds { robot, space, rates, nearest: (0.0, f64::INFINITY), places: 0 };
        let mut is_certain = true;
        for pair in path.parameters().windows(2) {
            let speed = path.fastest(f64::midpoint(pair[0], pair[1]));
            is_certain &= bounds.is_clear(path, [pair[0], pair[1]], &speed, HALVINGS);
        }
        let step = path.parameters().windows(2).map(|p| p[1] - p[0]).fold(0.0, f64::max);
        let s = bounds.refined(path, step);
        let q = path.eval(s).q;
        Clearance { s, smallest: bounds.smallest(&q), q, is_certain }
    }
}

impl Bounds<'_> {
    fn smallest(&self, q: &[f64]) -> f64 {
        let jacobian = geometric(self.robot, q, &Viewpoint::tool());
        let whole = Whole::new(&jacobian, &self.space.is_angle, self.space.length());
        whole.singular_values.last().copied().unwrap_or(0.0)
    }

    /// Whether nothing between two parameters is singular, where the joints move no faster than `speed`.
    fn is_clear(&mut self, path: &HermitePath, [from, to]: [f64; 2], speed: &[f64], halvings: u32) -> bool {
        let middle = f64::midpoint(from, to);
        let value = self.smallest(&path.eval(middle).q);
        self.places += 1;
        if value < self.nearest.1 {
            self.nearest = (middle, value);
        }
        let way = |j: usize| self.rates[j] * speed[j] / self.space.unit(j);
        let taken = (0..speed.len()).map(way).sum::<f64>() * 0.5 * (to - from);
        if value > taken + ROUNDING {
            return true;
        }
        if halvings == 0 || self.places >= PLACES {
            return false;
        }
        // Both, for the nearest place.
        let first = self.is_clear(path, [from, middle], speed, halvings - 1);
        self.is_clear(path, [middle, to], speed, halvings - 1) && first
    }

    /// The nearest place, within a step of the nearest that was met.
    fn refined(&self, path: &HermitePath, step: f64) -> f64 {
        let (mut low, mut high) = ((self.nearest.0 - step).max(0.0), (self.nearest.0 + step).min(path.end()));
        let value = |s: f64| self.smallest(&path.eval(s).q);
        for _ in 0..NEARER {
            let third = (high - low) / 3.0;
            if value(low + third) <= value(high - third) { high -= third } else { low += third }
        }
        let s = f64::midpoint(low, high);
        if value(s) <= self.nearest.1 { s } else { self.nearest.0 }
    }
}
