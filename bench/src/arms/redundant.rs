//! Arms with a joint too many: one configuration within the limits; poses of a path, one after the other.

use super::{Arm, figure, missed, rows};
use crate::inverse::VALID;
use crate::measure::times;
use crate::read;
use anyhow::{Result, anyhow, ensure};
use denavit::inverse::{Course, Goal, InverseKinematics, InverseOptions, RedundantSolver};
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

/// Arms that follow a path: with an arm angle, by a joint that is given, without a closed form.
const FOLLOWING: &[&str] = &["franka-panda", "kuka-iiwa-14", "kinova-gen3", "rethink-sawyer"];
/// The most that a pose of a path may take in the mean, µs.
const FOLLOWED: f64 = 50.0;
/// Poses between two configurations of a path.
const POSES: usize = 500;
/// Poses that all is solved for.
const WHOLE: usize = 20;

/// Measures paths of all arms, beside all solutions and the nearest of them.
///
/// # Errors
/// If an arm cannot be read or prepared, or an answer misses its pose or leaves the limits.
pub fn following(random: &mut impl FnMut() -> f64) -> Result<Value> {
    FOLLOWING.iter().map(|name| path(name, random)).collect()
}

fn path(name: &str, random: &mut impl FnMut() -> f64) -> Result<Value> {
    let arm = Arm::new(read(name)?)?;
    let solver = InverseKinematics::new(&arm.description, &InverseOptions::default())
        .map_err(|e| anyhow!("{name}: {e}"))?;
    let mut ends: Vec<Vec<f64>> = (0..5).map(|_| arm.configuration(random)).collect();
    // Well within the limits.
    let middle = arm.space.middle();
    ends.iter_mut().flatten().zip(middle.iter().cycle()).for_each(|(x, m)| *x = m + 0.8 * (*x - m));
    let between = |pair: &[Vec<f64>], k: usize| -> Vec<f64> {
        let part = k as f64 / POSES as f64;
        pair[0].iter().zip(&pair[1]).map(|(x, y)| x + part * (y - x)).collect()
    };
    let wanted = ends.windows(2).flat_map(|pair| (1..=POSES).map(move |k| between(pair, k)));
    let poses: Vec<_> = wanted.map(|q| arm.robot.pose(&q)).collect();
    let (mut before, mut jumps, mut worst, mut last) = (vec![], 0, 0.0_f64, ends[0].clone());
    for pose in &poses {
        let found = solver.track(pose, &last).ok_or_else(|| anyhow!("{name}: a pose has no answer"))?;
        let miss = missed(&rows(&arm.robot.pose(&found.q)), &rows(pose));
        ensure!(miss <= VALID && arm.is_within(&found.q), "{name}: {found:?} misses its pose by {miss:e}");
        worst = worst.max(miss);
        jumps += usize::from(found.course != Course::Followed);
        before.push(std::mem::replace(&mut last, found.q));
    }
    let ours = times(poses.len(), |k| {
        black_box(solver.track(black_box(&poses[k]), &before[k]));
    });
    let every = poses.len() / WHOLE;
    let whole = times(WHOLE, |k| {
        let (pose, last) = (&poses[k * every], &before[k * every]);
        let answer = solver.solve(black_box(pose), &[]);
        black_box(solver.nearest(pose, &answer, last));
    });
    let mean = |times: &[f64]| times.iter().sum::<f64>() / times.len() as f64;
    Ok(json!({
        "title": arm.description.name, "poses": poses.len(), "jumps": jumps, "worst": worst,
        "times": figure(&ours, [Some(FOLLOWED), None]), "ratio": mean(&whole) / mean(&ours),
    }))
}
