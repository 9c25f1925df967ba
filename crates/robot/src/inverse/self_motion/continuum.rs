//! Whether the arm can move with its hand still at a configuration, or its Jacobian is singular there only.

use super::jacobian::Frame;
use super::{Tracker, length};
use std::f64::consts::PI;

/// How far is tried, radians (slides: by the length).
const STEP: f64 = 0.01;
/// What the pose may be missed by after that: a fold misses it by the square of the step.
const MISSED: f64 = 1e-11;
/// Singular values below this count as 0 where the null space is looked for: a configuration at a multiple root is known
/// to the square root of rounding only.
const NULL: f64 = 1e-6;
/// Directions that are tried in a plane of them.
const DIRECTIONS: usize = 60;

/// The direction of a self-motion, in the units of the frame, a unit vector; nothing if there is none.
pub(super) fn direction(tracker: &Tracker, q: &[f64]) -> Option<Vec<f64>> {
    let singular = tracker.frame.singular(q);
    let n = q.len();
    let null = singular.values.iter().filter(|s| **s <= NULL).count();
    let single = singular.vectors.last()?.clone();
    if null < 2 {
        return holds(tracker, q, &single, n - 1).then_some(single);
    }
    // The motion is somewhere in a plane: where the miss is least.
    let (a, b) = (&singular.vectors[n - 2], &singular.vectors[n - 1]);
    let mix =
        |phi: f64| -> Vec<f64> { a.iter().zip(b).map(|(x, y)| phi.cos() * x + phi.sin() * y).collect() };
    let miss = |phi: f64| missed(tracker, q, &mix(phi), n - null);
    let at = |k: usize| PI * k as f64 / DIRECTIONS as f64;
    let tried: Vec<f64> = (0..DIRECTIONS).map(|k| miss(at(k))).collect();
    let mut lowest: Vec<usize> = (0..DIRECTIONS)
        .filter(|&k| {
            tried[k] <= tried[(k + DIRECTIONS - 1) % DIRECTIONS] && tried[k] <= tried[(k + 1) % DIRECTIONS]
        })
        .collect();
    lowest.sort_by(|&i, &j| tried[i].total_cmp(&tried[j]));
    lowest.into_iter().take(6).find_map(|k| {
        let phi = least(miss, at(k) - at(1), at(k) + at(1));
        let v = mix(phi);
        (miss(phi) <= MISSED).then_some(v)
    })
}

fn holds(tracker: &Tracker, q: &[f64], v: &[f64], rank: usize) -> bool {
    missed(tracker, q, v, rank) <= MISSED
}

/// What the pose is missed by a step along `v` away, the worse of both ways; infinite if the correction undoes the step.
fn missed(tracker: &Tracker, q: &[f64], v: &[f64], rank: usize) -> f64 {
    let one = |step: f64| {
        let start = stepped(&tracker.frame, q, v, step);
        let (at, residual) = tracker.corrected(&start, rank);
        let kept: f64 = (0..q.len()).map(|j| (at[j] - q[j]) / tracker.frame.unit(j) * v[j]).sum();
        if (kept / step - 1.0).abs() <= 0.5 { residual } else { f64::INFINITY }
    };
    one(STEP).max(one(-STEP))
}

/// `q` moved by `step` along `v`, which is in the units of the frame.
pub(super) fn stepped(frame: &Frame, q: &[f64], v: &[f64], step: f64) -> Vec<f64> {
    let by = step / length(v);
    (0..q.len()).map(|j| q[j] + by * v[j] * frame.unit(j)).collect()
}

/// Where a function is least between two places, by golden sections.
fn least(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..50 {
        let (x, y) = (high - golden * (high - low), low + golden * (high - low));
        if f(x) <= f(y) { high = y } else { low = x }
    }
    (low + high) / 2.0
}
