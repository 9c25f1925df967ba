//! The path by the parameter τ from 0 to 1, s = end · (10τ³ − 15τ⁴ + 6τ⁵).

use crate::motion::error::MotionError;
use crate::motion::path::{JointPath, PathPoint, Side};
use crate::motion::timing::{divided, is_corner};

/// A change of q'' at a knot is a jump if it is more than this part of its greatest entry on the path.
const JUMP: f64 = 1e-6;

/// s / end and three derivatives by τ.
pub(super) fn warp(tau: f64) -> [f64; 4] {
    let (t, r) = (tau, 1.0 - tau);
    [
        t * t * t * (10.0 + t * (6.0 * t - 15.0)),
        30.0 * t * t * r * r,
        60.0 * t * r * (r - t),
        60.0 * (1.0 - 6.0 * t * r),
    ]
}

/// Replaces the derivatives of `point` by s by those by τ; `point` is the path's at s(τ).
pub(super) fn chain(point: &mut PathPoint, [_, s1, s2, s3]: [f64; 4], end: f64) {
    let (s1, s2, s3) = (s1 * end, s2 * end, s3 * end);
    let (first, second) = (point.dq.iter_mut(), point.ddq.iter_mut());
    for ((dq, ddq), dddq) in first.zip(second).zip(&mut point.dddq) {
        (*dq, *ddq, *dddq) =
            (*dq * s1, *ddq * s1 * s1 + *dq * s2, *dddq * s1 * s1 * s1 + 3.0 * *ddq * s1 * s2 + *dq * s3);
    }
}

/// The grid in τ, with the knots of the path.
pub(super) fn grid<P: JointPath>(path: &P, intervals: usize) -> Result<Vec<f64>, MotionError> {
    let knots: Vec<f64> = path.knots().iter().map(|s| unwarp(s / path.end())).collect();
    divided(&knots, 1.0, intervals)
}

/// τ by s / end: halving, for s grows with τ.
fn unwarp(share: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return middle;
        }
        if warp(middle)[0] < share { low = middle } else { high = middle }
    }
}

/// Refuses a path on which q' or q'' jumps.
pub(super) fn smooth<P: JointPath>(path: &P) -> Result<(), MotionError> {
    let (mut before, mut behind) = (PathPoint::zeros(path.dof()), PathPoint::zeros(path.dof()));
    let mut greatest = 0.0f64;
    let mut jumps = vec![];
    let mut last = 0.0;
    for &s in path.knots() {
        path.eval_into((last + s) / 2.0, Side::Behind, &mut before);
        greatest = before.ddq.iter().fold(greatest, |m, a| m.max(a.abs()));
        path.eval_into(s, Side::Before, &mut before);
        path.eval_into(s, Side::Behind, &mut behind);
        if is_corner(&before.dq, &behind.dq) {
            return Err(MotionError::Kink { s });
        }
        greatest = before.ddq.iter().chain(&behind.ddq).fold(greatest, |m, a| m.max(a.abs()));
        // On a line all of q'' is rounding.
        greatest = before.dq.iter().fold(greatest, |m, v| m.max(v.abs() / path.end()));
        let pairs = before.ddq.iter().zip(&behind.ddq);
        jumps.push((s, pairs.fold(0.0f64, |m, (a, b)| m.max((a - b).abs()))));
        last = s;
    }
    match jumps.iter().find(|(_, jump)| *jump > JUMP * greatest) {
        Some(&(s, _)) => Err(MotionError::Kink { s }),
        None => Ok(()),
    }
}
