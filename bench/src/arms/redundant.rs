//! One configuration within the limits for arms with a joint too many.

use super::{Arm, figure};
use crate::measure::times;
use crate::read;
use anyhow::{Result, anyhow};
use denavit::inverse::{Goal, RedundantSolver};
use serde_json::{Value, json};
use std::hint::black_box;

const CATALOGUE: &[&str] = &["franka-panda", "kuka-iiwa-14"];
/// The most that a pose may take in the mean, µs.
const MEAN: f64 = 20.0;

/// Measures all arms.
///
/// # Errors
/// If an arm cannot be read or solved.
pub fn measure(count: usize, random: &mut impl FnMut() -> f64) -> Result<Value> {
    CATALOGUE.iter().map(|name| arm(name, count, random)).collect()
}

fn arm(name: &str, count: usize, random: &mut impl FnMut() -> f64) -> Result<Value> {
    let arm = Arm::new(read(name)?)?;
    let solver = RedundantSolver::new(&arm.description, Goal::Pose).map_err(|e| anyhow!("{name}: {e}"))?;
    let poses = arm.targets(count, random);
    // Solutions have angles in (−π, π]; the limits may allow a copy a turn away.
    let copy = |q: Vec<f64>| arm.space.nearest_copy(&q, &q);
    let answers: Vec<_> = poses.iter().map(|pose| Some(copy(solver.within_limits(pose, None)?.q))).collect();
    let solved = arm.solved(&poses, &answers) as f64 / count as f64;
    let times = times(count, |k| {
        black_box(solver.within_limits(black_box(&poses[k]), None));
    });
    Ok(json!({
        "title": arm.description.name, "parameter": solver.parameter(), "solved": solved,
        "times": figure(&times, [Some(MEAN), None]),
    }))
}
