//! Cubic splines through way-points: C², piecewise cubic (de Boor, *A Practical Guide to Splines*, ch. IV;
//! Biagiotti & Melchiorri 2008, §4.4).

use super::piecewise::PiecewisePath;
use super::way_points::{checked, checked_parameters, chord_lengths};
use crate::motion::error::{MotionError, joints};

/// What a cubic spline does at its ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Ends {
    /// No curvature: q'' = 0.
    Natural,
    /// These tangents q' at the start and at the end, one entry a joint.
    Clamped(Vec<f64>, Vec<f64>),
}

/// The cubic spline through way-points, at parameters by chord length ([`chord_lengths`]).
///
/// # Errors
/// As [`chord_lengths`], and if a tangent has not one finite number for each joint.
pub fn cubic_spline(way_points: &[Vec<f64>], ends: &Ends) -> Result<PiecewisePath, MotionError> {
    cubic_spline_at(&chord_lengths(way_points)?, way_points, ends)
}

/// The cubic spline through way-points at the parameters given: increasing, the first one 0.
///
/// # Errors
/// If the parameters are not so, and as [`cubic_spline`], but for way-points that repeat.
pub fn cubic_spline_at(
    parameters: &[f64],
    way_points: &[Vec<f64>],
    ends: &Ends,
) -> Result<PiecewisePath, MotionError> {
    let dof = checked(way_points)?;
    checked_parameters(parameters, way_points)?;
    if let Ends::Clamped(first, last) = ends {
        joints("tangent at the start", dof, first)?;
        joints("tangent at the end", dof, last)?;
    }
    let slopes: Vec<Vec<f64>> = (0..dof)
        .map(|joint| {
            let values: Vec<f64> = way_points.iter().map(|q| q[joint]).collect();
            let ends = match ends {
                Ends::Natural => None,
                Ends::Clamped(first, last) => Some([first[joint], last[joint]]),
            };
            slopes(parameters, &values, ends)
        })
        .collect();
    let coefficient = |i: usize, joint: usize, power: usize| {
        let h = parameters[i + 1] - parameters[i];
        let (y, m) = ([way_points[i][joint], way_points[i + 1][joint]], &slopes[joint][i..i + 2]);
        let chord = (y[1] - y[0]) / h;
        match power {
            0 => y[0],
            1 => m[0],
            2 => (3.0 * chord - 2.0 * m[0] - m[1]) / h,
            _ => (m[0] + m[1] - 2.0 * chord) / (h * h),
        }
    };
    Ok(PiecewisePath::new(dof, 4, parameters.to_vec(), coefficient))
}

/// Slopes at all knots, from the equations that q'' is continuous: with h and the slope d of the chords,
/// mᵢ₋₁/hᵢ₋₁ + 2 (1/hᵢ₋₁ + 1/hᵢ) mᵢ + mᵢ₊₁/hᵢ = 3 (dᵢ₋₁/hᵢ₋₁ + dᵢ/hᵢ).
fn slopes(x: &[f64], y: &[f64], ends: Option<[f64; 2]>) -> Vec<f64> {
    let n = x.len();
    // Weights 1/h of the chord before and behind a knot, and the equation (below, diagonal, above, right-hand side).
    let weight = |i: usize| 1.0 / (x[i + 1] - x[i]);
    let pull = |i: usize| 3.0 * (y[i + 1] - y[i]) * weight(i) * weight(i);
    let row = |i: usize| match (i, ends) {
        (0, Some([m, _])) => (0.0, 1.0, 0.0, m),
        (0, None) => (0.0, 2.0 * weight(0), weight(0), pull(0)),
        (i, Some([_, m])) if i == n - 1 => (0.0, 1.0, 0.0, m),
        (i, None) if i == n - 1 => (weight(i - 1), 2.0 * weight(i - 1), 0.0, pull(i - 1)),
        (i, _) => (weight(i - 1), 2.0 * (weight(i - 1) + weight(i)), weight(i), pull(i - 1) + pull(i)),
    };
    // Gaussian elimination; the diagonal dominates.
    let mut reduced: Vec<(f64, f64)> = Vec::with_capacity(n);
    for i in 0..n {
        let (below, diagonal, above, right) = row(i);
        let (a, r) = if i == 0 { (0.0, 0.0) } else { reduced[i - 1] };
        let pivot = diagonal - below * a;
        reduced.push((above / pivot, (right - below * r) / pivot));
    }
    let mut m = vec![0.0; n];
    let mut next = 0.0;
    for i in (0..n).rev() {
        next = reduced[i].1 - reduced[i].0 * next;
        m[i] = next;
    }
    m
}
