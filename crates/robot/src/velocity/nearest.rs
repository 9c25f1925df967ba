//! Singular configurations in numbers: Newton's method on the smallest singular value.

use super::geometric::{Viewpoint, geometric};
use super::measures::{normalised, scaled};
use super::svd::{Svd, dot, singular_values, svd};
use crate::mechanism::Robot;

/// A singular configuration near another.
#[derive(Clone, PartialEq, Debug)]
pub struct NearestSingularity {
    /// The configuration.
    pub q: Vec<f64>,
    /// How far it is: the Euclidean norm of the joints' differences, radians, slides by the arm's length.
    pub distance: f64,
    /// Its smallest singular value.
    pub smallest: f64,
}

/// A singular configuration near `q`: the nearest of those that Newton's method on the smallest singular value leads to
/// (whose derivative by a joint is uᵀ (∂J/∂q) v) from `q` itself and from where a joint moved alone comes near to one;
/// `None` if there are none. Not certainly the nearest of all.
///
/// # Panics
/// If `q` has not one entry a joint, or the robot has no such frame.
pub fn nearest_singularity(
    robot: &Robot<f64>,
    view: &Viewpoint<f64>,
    is_angle: &[bool],
    length: f64,
    q: &[f64],
) -> Option<NearestSingularity> {
    let slope = Slope { robot, view, is_angle, length, rows: &[0, 1, 2, 3, 4, 5] };
    let mut best = slope.descend(q, q);
    for start in slope.alone(q).into_iter().take((WORK / q.len().max(1)).max(1)) {
        let found = slope.descend(&start, q);
        let distance = |n: &Option<NearestSingularity>| n.as_ref().map_or(f64::INFINITY, |n| n.distance);
        if distance(&found) < distance(&best) {
            best = found;
        }
    }
    best
}

/// Newton steps towards a singular configuration.
const STEPS: usize = 60;
/// A step is not longer than this (radians, slides by the arm's length).
const LONGEST: f64 = 0.3;
/// Starts times joints: a step from each takes a Jacobian for each joint.
const WORK: usize = 512;
/// Steps of a joint that is moved alone, up to half a turn or the arm's length either way.
const ALONE: i32 = 32;

/// The smallest singular value of some rows of a Jacobian without units, over the configurations.
pub(super) struct Slope<'a> {
    pub robot: &'a Robot<f64>,
    pub view: &'a Viewpoint<f64>,
    pub is_angle: &'a [bool],
    /// What lengths are divided by, metres.
    pub length: f64,
    /// The rows that count, from 0.
    pub rows: &'a [usize],
}

impl Slope<'_> {
    fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.length }
    }

    fn columns(&self, q: &[f64]) -> Vec<[f64; 6]> {
        let mut columns = scaled(&geometric(self.robot, q, self.view), self.is_angle, self.length);
        for column in &mut columns {
            (0..6).filter(|r| !self.rows.contains(r)).for_each(|r| column[r] = 0.0);
        }
        columns
    }

    /// Which singular value is the smallest.
    fn last(&self) -> Option<usize> {
        self.is_angle.len().min(self.rows.len()).checked_sub(1)
    }

    /// For each joint and direction, the first place where the smallest singular value has a minimum; the nearest first,
    /// where there are too many to start from all.
    fn alone(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let smallest = |q: &[f64]| {
            let values = singular_values(self.columns(q));
            self.last().and_then(|k| values.get(k).copied()).unwrap_or(0.0)
        };
        let here = smallest(q);
        let mut found = vec![];
        for j in 0..q.len() {
            let reach = if self.is_angle[j] { std::f64::consts::PI } else { self.length };
            for way in [reach, -reach] {
                let at = |k: i32| {
                    let mut q = q.to_vec();
                    q[j] += way * f64::from(k) / f64::from(ALONE);
                    q
                };
                let (mut before, mut value) = (f64::INFINITY, here);
                for k in 1..=ALONE {
                    let next = smallest(&at(k));
                    if value < before && value < next && value < 0.5 * here {
                        found.push((k, at(k - 1)));
                        break;
                    }
                    (before, value) = (value, next);
                }
            }
        }
        if found.len() * q.len() > WORK {
            found.sort_by_key(|f| f.0);
        }
        found.into_iter().map(|f| f.1).collect()
    }

    /// Newton's method from a configuration; the distance is from `q`.
    pub fn descend(&self, from: &[f64], q: &[f64]) -> Option<NearestSingularity> {
        let mut here = from.to_vec();
        for _ in 0..STEPS {
            let decomposed = svd(self.columns(&here));
            let value = decomposed.values.get(self.last()?).copied()?;
            let largest = decomposed.values[0];
            if value <= 1e-10 * largest {
                let away = here.iter().zip(q).enumerate().map(|(j, (a, b))| ((a - b) / self.unit(j)).powi(2));
                let distance = away.sum::<f64>().sqrt();
                return Some(NearestSingularity { distance, q: here, smallest: value });
            }
            let gradient = self.gradient(&here, &decomposed)?;
            let square: f64 = gradient.iter().map(|g| g * g).sum();
            if square <= 1e-20 {
                return None;
            }
            let step = (value / square).min(LONGEST / square.sqrt());
            for (j, (x, g)) in here.iter_mut().zip(&gradient).enumerate() {
                *x -= step * g * self.unit(j);
            }
        }
        None
    }

    /// The derivative of the smallest singular value by each joint, in units: central differences of uᵀ J v.
    fn gradient(&self, q: &[f64], decomposed: &Svd) -> Option<Vec<f64>> {
        let last = self.last()?;
        let u = normalised(&decomposed.images[last])?;
        let v = &decomposed.vectors[last];
        let bilinear =
            |q: &[f64]| -> f64 { self.columns(q).iter().zip(v).map(|(c, x)| dot(c, &u) * x).sum() };
        let derivative = |j: usize| {
            let step = 1e-6 * self.unit(j);
            let moved = |by: f64| {
                let mut at = q.to_vec();
                at[j] += by;
                bilinear(&at)
            };
            (moved(step) - moved(-step)) / 2e-6
        };
        Some((0..q.len()).map(derivative).collect())
    }
}
