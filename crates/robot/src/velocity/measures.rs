//! How well a body can move: singular values, condition, manipulability.

use super::geometric::Jacobian;
use super::svd::{Svd, dot, singular_values, svd};

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

pub(super) fn normalised(v: &[f64; 6]) -> Option<[f64; 6]> {
    let length = dot(v, v).sqrt();
    (length > 0.0).then(|| v.map(|x| x / length))
}
