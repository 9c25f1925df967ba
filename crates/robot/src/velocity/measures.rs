//! How well a body can move: singular values, condition, manipulability, the nearest singular configuration.

use super::geometric::{Jacobian, Viewpoint, geometric};
use super::svd::{Svd, dot, singular_values, svd};
use crate::mechanism::Robot;

/// What one block of rows can do: the linear one in metres a radian, or the angular one without unit.
#[derive(Clone, PartialEq, Debug)]
pub struct Block {
    /// The singular values, descending: three, or one a joint if those are fewer.
    pub singular_values: Vec<f64>,
    /// Yoshikawa's measure (1985), the product of the singular values: √det(J Jᵀ), with fewer than three joints √det(Jᵀ J).
    pub manipulability: f64,
    /// The largest singular value by the smallest; infinite where the block is singular.
    pub condition: f64,
}

/// All six rows together, lengths divided by one: numbers without unit.
#[derive(Clone, PartialEq, Debug)]
pub struct Whole {
    /// The singular values, descending, as many as there are rows and columns.
    pub singular_values: Vec<f64>,
    /// The largest singular value by the smallest; infinite where the arm is singular.
    pub condition: f64,
    /// The product of the singular values: for six joints |det J|, for more √det(J Jᵀ), for fewer √det(Jᵀ J).
    pub manipulability: f64,
    /// Singular values above [`RANK`] times the largest.
    pub rank: usize,
    /// Directions in which the body cannot move, orthonormal: no twist that it can have has a component along them.
    pub lost: Vec<[f64; 6]>,
    /// Motions of the joints that leave the body where it is, orthonormal.
    pub free: Vec<Vec<f64>>,
}

/// Measures of a Jacobian at a configuration: metres and radians kept apart, and together.
#[derive(Clone, PartialEq, Debug)]
pub struct Measures {
    /// The rows vx, vy, vz.
    pub linear: Block,
    /// The rows wx, wy, wz.
    pub angular: Block,
    /// All rows, lengths divided by `length`.
    pub whole: Whole,
    /// The length, metres.
    pub length: f64,
}

/// A singular value below this part of the largest counts as 0.
pub const RANK: f64 = 1e-9;

/// The measures of a Jacobian; `is_angle` says which joints turn, `length` is the arm's size in metres.
pub fn measures(jacobian: &Jacobian<f64>, is_angle: &[bool], length: f64) -> Measures {
    let part = |rows: std::ops::Range<usize>| {
        let mut columns = jacobian.columns.clone();
        for column in &mut columns {
            (0..6).filter(|r| !rows.contains(r)).for_each(|r| column[r] = 0.0);
        }
        block(columns)
    };
    let whole = Whole::new(jacobian, is_angle, length);
    Measures { linear: part(0..3), angular: part(3..6), whole, length }
}

impl Whole {
    /// Those of a Jacobian; see [`measures`].
    pub fn new(jacobian: &Jacobian<f64>, is_angle: &[bool], length: f64) -> Self {
        Whole::of(&svd(scaled(jacobian, is_angle, length)))
    }

    /// From the singular values of a matrix without units.
    fn of(decomposed: &Svd) -> Self {
        let count = decomposed.vectors.len().min(6);
        let values: Vec<f64> = decomposed.values[..count].to_vec();
        let largest = values.first().copied().unwrap_or(0.0);
        let rank = values.iter().filter(|&&v| v > RANK * largest).count();
        Whole {
            condition: condition(&values, rank == count && count > 0),
            manipulability: values.iter().product(),
            lost: complement(&decomposed.images[..rank]),
            free: decomposed.vectors[rank..].to_vec(),
            singular_values: values,
            rank,
        }
    }
}

fn block(columns: Vec<[f64; 6]>) -> Block {
    let singular_values: Vec<f64> = singular_values(columns).into_iter().take(3).collect();
    let largest = singular_values.first().copied().unwrap_or(0.0);
    let is_full = !singular_values.is_empty() && singular_values.iter().all(|&v| v > RANK * largest);
    Block {
        manipulability: singular_values.iter().product(),
        condition: condition(&singular_values, is_full),
        singular_values,
    }
}

fn condition(values: &[f64], is_full: bool) -> f64 {
    match values {
        [largest, .., smallest] if is_full => largest / smallest,
        [_] if is_full => 1.0,
        _ => f64::INFINITY,
    }
}

/// The columns with lengths divided by `length`, and slides counted in it: numbers without unit.
pub(super) fn scaled(jacobian: &Jacobian<f64>, is_angle: &[bool], length: f64) -> Vec<[f64; 6]> {
    let unit = |turns: bool| if turns { 1.0 } else { length };
    let column = |(c, &turns): (&[f64; 6], &bool)| {
        let u = unit(turns);
        [c[0] * u / length, c[1] * u / length, c[2] * u / length, c[3] * u, c[4] * u, c[5] * u]
    };
    jacobian.columns.iter().zip(is_angle).map(column).collect()
}

/// Orthonormal vectors that are orthogonal to these orthogonal ones.
fn complement(images: &[[f64; 6]]) -> Vec<[f64; 6]> {
    let mut all: Vec<[f64; 6]> = images.iter().filter_map(normalised).collect();
    let known = all.len();
    while all.len() < 6 {
        // The unit vector that is furthest from all others.
        let rest = |k: usize| {
            let mut e = [0.0; 6];
            e[k] = 1.0;
            for _ in 0..2 {
                for v in &all {
                    let along = dot(&e, v);
                    (0..6).for_each(|i| e[i] -= along * v[i]);
                }
            }
            e
        };
        let candidates = (0..6).map(rest).max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
        let Some(next) = candidates.as_ref().and_then(normalised) else { break };
        all.push(next);
    }
    all.split_off(known)
}

fn normalised(v: &[f64; 6]) -> Option<[f64; 6]> {
    let length = dot(v, v).sqrt();
    (length > 0.0).then(|| v.map(|x| x / length))
}

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

/// Newton steps towards a singular configuration.
const STEPS: usize = 60;
/// A step is not longer than this (radians, slides by the arm's length).
const LONGEST: f64 = 0.3;

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
    let descended = |from: &[f64]| descend(robot, view, is_angle, length, from, q);
    let mut best = descended(q);
    let starts = alone(robot, view, is_angle, length, q);
    for start in starts.into_iter().take((WORK / q.len().max(1)).max(1)) {
        let found = descended(&start);
        let distance = |n: &Option<NearestSingularity>| n.as_ref().map_or(f64::INFINITY, |n| n.distance);
        if distance(&found) < distance(&best) {
            best = found;
        }
    }
    best
}

/// Starts times joints: a step from each takes a Jacobian for each joint.
const WORK: usize = 512;
/// Steps of a joint that is moved alone, up to half a turn or the arm's length either way.
const ALONE: i32 = 32;

/// For each joint and direction, the first place where the smallest singular value has a minimum; the nearest first, where
/// there are too many to start from all.
fn alone(
    robot: &Robot<f64>,
    view: &Viewpoint<f64>,
    is_angle: &[bool],
    length: f64,
    q: &[f64],
) -> Vec<Vec<f64>> {
    let smallest = |q: &[f64]| {
        let values = singular_values(scaled(&geometric(robot, q, view), is_angle, length));
        values.get(q.len().min(6).wrapping_sub(1)).copied().unwrap_or(0.0)
    };
    let here = smallest(q);
    let mut found = vec![];
    for j in 0..q.len() {
        let reach = if is_angle[j] { std::f64::consts::PI } else { length };
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
fn descend(
    robot: &Robot<f64>,
    view: &Viewpoint<f64>,
    is_angle: &[bool],
    length: f64,
    from: &[f64],
    q: &[f64],
) -> Option<NearestSingularity> {
    let unit = |j: usize| if is_angle[j] { 1.0 } else { length };
    let at = |q: &[f64]| svd(scaled(&geometric(robot, q, view), is_angle, length));
    let smallest = |s: &Svd| s.values.get(q.len().min(6).saturating_sub(1)).copied();
    let mut here = from.to_vec();
    for _ in 0..STEPS {
        let decomposed = at(&here);
        let value = smallest(&decomposed)?;
        let largest = decomposed.values[0];
        if value <= 1e-10 * largest {
            let away = here.iter().zip(q).enumerate().map(|(j, (a, b))| ((a - b) / unit(j)).powi(2));
            return Some(NearestSingularity { distance: away.sum::<f64>().sqrt(), q: here, smallest: value });
        }
        let gradient = slope(robot, view, is_angle, length, &here, &decomposed)?;
        let square: f64 = gradient.iter().map(|g| g * g).sum();
        if square <= 1e-20 {
            return None;
        }
        let step = (value / square).min(LONGEST / square.sqrt());
        for (j, (x, g)) in here.iter_mut().zip(&gradient).enumerate() {
            *x -= step * g * unit(j);
        }
    }
    None
}

/// The derivative of the smallest singular value by each joint, in units: central differences of uᵀ J v.
fn slope(
    robot: &Robot<f64>,
    view: &Viewpoint<f64>,
    is_angle: &[bool],
    length: f64,
    q: &[f64],
    decomposed: &Svd,
) -> Option<Vec<f64>> {
    let last = q.len().min(6).checked_sub(1)?;
    let u = normalised(&decomposed.images[last])?;
    let v = &decomposed.vectors[last];
    let bilinear = |q: &[f64]| -> f64 {
        let columns = scaled(&geometric(robot, q, view), is_angle, length);
        columns.iter().zip(v).map(|(c, x)| dot(c, &u) * x).sum()
    };
    let derivative = |j: usize| {
        let step = 1e-6 * if is_angle[j] { 1.0 } else { length };
        let moved = |by: f64| {
            let mut at = q.to_vec();
            at[j] += by;
            bilinear(&at)
        };
        (moved(step) - moved(-step)) / 2e-6
    };
    Some((0..q.len()).map(derivative).collect())
}
