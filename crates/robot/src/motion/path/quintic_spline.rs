//! Quintic splines through way-points: C⁴, piecewise of degree five, so that jerk and its derivative are continuous
//! (Biagiotti & Melchiorri 2008, §4.5).

use super::piecewise::PiecewisePath;
use super::way_points::{checked, checked_parameters, chord_lengths};
use crate::motion::error::{MotionError, joints};
use crate::motion::profile::hermite;

/// What a quintic spline does at its ends.
#[derive(Clone, Debug, PartialEq)]
pub enum QuinticEnds {
    /// q''' = q'''' = 0.
    Natural,
    /// Tangent q' and curvature q'' at the start, and both at the end.
    Clamped([Vec<f64>; 2], [Vec<f64>; 2]),
}

/// The quintic spline through way-points, at parameters by chord length ([`chord_lengths`]).
///
/// # Errors
/// As [`chord_lengths`], and if an end condition has not one finite number for each joint.
pub fn quintic_spline(way_points: &[Vec<f64>], ends: &QuinticEnds) -> Result<PiecewisePath, MotionError> {
    quintic_spline_at(&chord_lengths(way_points)?, way_points, ends)
}

/// The quintic spline through way-points at the parameters given: increasing, the first one 0.
///
/// # Errors
/// If the parameters are not so, and as [`quintic_spline`], but for way-points that repeat.
pub fn quintic_spline_at(
    parameters: &[f64],
    way_points: &[Vec<f64>],
    ends: &QuinticEnds,
) -> Result<PiecewisePath, MotionError> {
    let dof = checked(way_points)?;
    checked_parameters(parameters, way_points)?;
    if let QuinticEnds::Clamped(first, last) = ends {
        for values in first.iter().chain(last) {
            joints("end conditions", dof, values)?;
        }
    }
    let pieces: Vec<Vec<[f64; 6]>> = (0..dof)
        .map(|joint| {
            let y: Vec<f64> = way_points.iter().map(|q| q[joint]).collect();
            let ends = match ends {
                QuinticEnds::Natural => None,
                QuinticEnds::Clamped(a, b) => Some([[a[0][joint], a[1][joint]], [b[0][joint], b[1][joint]]]),
            };
            let at = derivatives(parameters, &y, ends);
            let state = |i: usize| [y[i], at[i][0], at[i][1]];
            (0..y.len() - 1)
                .map(|i| hermite(state(i), state(i + 1), parameters[i + 1] - parameters[i]))
                .collect()
        })
        .collect();
    Ok(PiecewisePath::new(dof, 6, parameters.to_vec(), |i, joint, power| pieces[joint][i][power]))
}

type Block = [[f64; 2]; 2];
type Pair = [f64; 2];

/// First and second derivatives at all knots, so that the third and fourth are continuous: with the quintic of
/// [`hermite`] over h, from (p₀, v₀, a₀) to (p₁, v₁, a₁), d = p₁ − p₀,
///
/// q'''  = 3/h³  ( 20 d − (12 v₀ +  8 v₁) h − (3 a₀ −   a₁) h²) at its start,
/// q'''' = 12/h⁴ (−30 d + (16 v₀ + 14 v₁) h + (3 a₀ − 2 a₁) h²) there,
///
/// and at its end the same with −h for h.
fn derivatives(x: &[f64], y: &[f64], ends: Option<[Pair; 2]>) -> Vec<Pair> {
    let n = x.len();
    if n == 2 && ends.is_none() {
        return vec![[(y[1] - y[0]) / (x[1] - x[0]), 0.0]; 2]; // of all parabolas through two points, the line
    }
    // A side of a knot: the block of its own derivatives, that of the knot across the piece, and the rest.
    let side = |i: usize, behind: bool| -> (Block, Block, Pair) {
        let other = if behind { i + 1 } else { i - 1 };
        let h = x[other] - x[i]; // negative before the knot: that reads the piece backwards
        let (d, h2) = (y[other] - y[i], h * h);
        let (third, fourth) = (3.0 / (h2 * h), 12.0 / (h2 * h2));
        let own = [[-12.0 * h * third, -3.0 * h2 * third], [16.0 * h * fourth, 3.0 * h2 * fourth]];
        let across = [[-8.0 * h * third, h2 * third], [14.0 * h * fourth, -2.0 * h2 * fourth]];
        (own, across, [20.0 * d * third, -30.0 * d * fourth])
    };
    const ZERO: Block = [[0.0; 2]; 2];
    const ONE: Block = [[1.0, 0.0], [0.0, 1.0]];
    // The equations of knot i: below · (i−1) + own · i + above · (i+1) = right.
    let row = |i: usize| -> (Block, Block, Block, Pair) {
        match (i, ends) {
            (0, Some([first, _])) => (ZERO, ONE, ZERO, first),
            (i, Some([_, last])) if i == n - 1 => (ZERO, ONE, ZERO, last),
            (0, None) => {
                let (own, across, rest) = side(0, true);
                (ZERO, own, across, rest.map(|r| -r))
            }
            (i, None) if i == n - 1 => {
                let (own, across, rest) = side(i, false);
                (across, own, ZERO, rest.map(|r| -r))
            }
            (i, _) => {
                let (own, above, rest) = side(i, true);
                let (own_before, below, rest_before) = side(i, false);
                let difference = |a: Block, b: Block| -> Block {
                    std::array::from_fn(|r| std::array::from_fn(|c| a[r][c] - b[r][c]))
                };
                let right = std::array::from_fn(|r| rest_before[r] - rest[r]);
                (difference(ZERO, below), difference(own, own_before), above, right)
            }
        }
    };
    let mut reduced: Vec<(Block, Pair)> = Vec::with_capacity(n);
    for i in 0..n {
        let (below, own, above, right) = row(i);
        let (a, r) = if i == 0 { (ZERO, [0.0; 2]) } else { reduced[i - 1] };
        let product = multiply(below, a);
        let pivot = std::array::from_fn(|j| std::array::from_fn(|k| own[j][k] - product[j][k]));
        let inverse = invert(pivot);
        let shift = apply(below, r);
        reduced.push((multiply(inverse, above), apply(inverse, [right[0] - shift[0], right[1] - shift[1]])));
    }
    let mut found = vec![[0.0; 2]; n];
    let mut next = [0.0; 2];
    for i in (0..n).rev() {
        let shift = apply(reduced[i].0, next);
        next = [reduced[i].1[0] - shift[0], reduced[i].1[1] - shift[1]];
        found[i] = next;
    }
    found
}

fn multiply(a: Block, b: Block) -> Block {
    std::array::from_fn(|i| std::array::from_fn(|k| a[i][0] * b[0][k] + a[i][1] * b[1][k]))
}

fn apply(a: Block, x: Pair) -> Pair {
    a.map(|row| row[0] * x[0] + row[1] * x[1])
}

fn invert([[a, b], [c, d]]: Block) -> Block {
    let determinant = a * d - b * c;
    [[d / determinant, -b / determinant], [-c / determinant, a / determinant]]
}
