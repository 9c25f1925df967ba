//! One configuration within the limits by descent, beside `k`, from the same random configurations.

use super::{Arm, figure};
use crate::measure::times;
use crate::peers::KChain;
use crate::read;
use anyhow::{Result, ensure};
use denavit::geometry::Transform;
use denavit::inverse::Goal;
use denavit::inverse::numeric::NumericSolver;
use serde_json::{Value, json};
use std::hint::black_box;

/// Robots of the catalogue and the most that a pose may take in the mean, µs.
const CATALOGUE: &[(&str, f64)] = &[("ur5", 40.0), ("franka-panda", 70.0)];

/// Somebody's way to a configuration for a pose, from another one.
type Solve<'a> = Box<dyn FnMut(&Transform<f64>, &[f64]) -> Option<Vec<f64>> + 'a>;

/// Measures all arms.
///
/// # Errors
/// If an arm cannot be read, or it is another one for `k`.
pub fn measure(count: usize, random: &mut impl FnMut() -> f64) -> Result<Value> {
    CATALOGUE.iter().map(|(name, limit)| arm(name, *limit, count, random)).collect()
}

fn arm(name: &str, limit: f64, count: usize, random: &mut impl FnMut() -> f64) -> Result<Value> {
    let arm = Arm::new(read(name)?)?;
    let poses = arm.targets(count, random);
    let seeds: Vec<Vec<f64>> = (0..count).map(|_| arm.configuration(random)).collect();
    let k = KChain::new(&arm.robot, &arm.space.limits)?;
    let (theirs, ours) = (k.pose(&seeds[0]).translation.vector, arm.robot.pose(&seeds[0]).translation.0);
    let apart = theirs.iter().zip(ours).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    ensure!(apart < 1e-12, "{name} is another arm for `k`");

    let descent = |solver: NumericSolver| -> Solve<'static> {
        Box::new(move |pose, seed| {
            let outcome = solver.solve(pose, Some(seed));
            outcome.is_solved().then_some(outcome.q)
        })
    };
    let whole = NumericSolver::new(&arm.description, Goal::Pose)?;
    let mut single = whole.clone();
    single.options.max_restarts = 0;
    let contestants: [(&str, Option<f64>, Solve<'_>); 3] = [
        ("k 0.32, one start", None, Box::new(|pose, seed| k.solve(pose, seed))),
        ("Denavit, one start", None, descent(single)),
        ("Denavit", Some(limit), descent(whole)),
    ];
    let mut rows = vec![];
    for (name, limit, mut solve) in contestants {
        let answers: Vec<_> = poses.iter().zip(&seeds).map(|(pose, seed)| solve(pose, seed)).collect();
        let solved = arm.solved(&poses, &answers) as f64 / count as f64;
        let times = times(count, |k| {
            black_box(solve(black_box(&poses[k]), black_box(&seeds[k])));
        });
        rows.push(json!({
            "name": name, "solved": solved, "must": limit.is_some(), "times": figure(&times, [limit, None]),
        }));
    }
    Ok(json!({"title": arm.description.name, "rows": rows}))
}
