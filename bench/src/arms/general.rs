//! All solutions of six joints by elimination, beside the general solver of `ik-geo`.

use super::{Arm, figure, missed, rows};
use crate::inverse::{Check, Joints, Rows, VALID};
use crate::measure::times;
use crate::peers::inverse::{Family, Geo};
use crate::read;
use anyhow::{Result, anyhow, ensure};
use denavit::description::read_toml;
use denavit::geometry::Transform;
use denavit::inverse::general::GeneralSolver;
use serde_json::{Value, json};
use std::hint::black_box;

/// Robots of the catalogue. A closed form that there may be is left aside.
const CATALOGUE: &[&str] = &[
    OBLIQUE,
    "fanuc-crx10ia-l",
    "kinova-jaco",
    "ufactory-xarm6",
    "motoman-hc10",
    "abb-gofa-crb15000-5",
    "agilex-piper",
];
/// The one without any special geometry, which `ik-geo` is asked about too.
const OBLIQUE: &str = "oblique-6r";
/// The most that a pose of it may take in the mean, and of the others, µs.
const MEANS: [f64; 2] = [25.0, 40.0];
/// The most that 99 of 100 poses may take, µs.
const P99: f64 = 150.0;
/// Poses for `ik-geo`, which takes milliseconds for one.
const PEER_POSES: usize = 50;

/// The UR10e with errors of 1e-3 to 6e-3 (radians, metres) in each angle and length, as a calibration finds them.
const CALIBRATED: &str = r#"
name = "UR10e, calibrated"
convention = "standard"
source = "made for this benchmark: the maker's table with an error in each entry"

[[joints]]
theta = "q1 + 0.1 deg"
d = "0.1822 m"
a = "0.0012 m"
alpha = "90.2 deg"

[[joints]]
theta = "q2 - 0.2 deg"
d = "0.003 m"
a = "-0.614 m"
alpha = "0.15 deg"

[[joints]]
theta = "q3 + 0.25 deg"
d = "-0.0021 m"
a = "-0.5699 m"
alpha = "-0.12 deg"

[[joints]]
theta = "q4 - 0.15 deg"
d = "0.17655 m"
a = "0.0017 m"
alpha = "89.83 deg"

[[joints]]
theta = "q5 + 0.18 deg"
d = "0.1211 m"
a = "-0.0014 m"
alpha = "-90.21 deg"

[[joints]]
theta = "q6 + 0.3 deg"
d = "0.1179 m"
a = "0.0013 m"
alpha = "0.08 deg"
"#;

/// An arm with its solver, and its poses.
struct Case {
    name: &'static str,
    arm: Arm,
    solver: GeneralSolver,
    drawn: Vec<Joints>,
    poses: Vec<Transform<f64>>,
}

/// What the answers for all poses are worth.
struct Worth {
    check: Check,
    /// Poses that needed more than one split of the loop.
    second: usize,
    /// Poses whose answer is certified to be complete.
    complete: usize,
}

/// Measures all arms, and `ik-geo`.
///
/// # Errors
/// If an arm cannot be read or solved, or a configuration that a pose was made from is not among the answers.
pub fn measure(poses: usize, random: &mut impl FnMut() -> f64) -> Result<Value> {
    let mut cases = vec![];
    for name in CATALOGUE.iter().copied().chain([""]) {
        cases.push(Case::new(name, poses, random)?);
    }
    let worth: Vec<Worth> = cases.iter().map(Case::worth).collect();
    let lacking = cases.iter().zip(&worth).filter(|(_, w)| w.check.drawn_found < poses);
    let lacking = lacking.map(|(case, w)| {
        let lost = poses - w.check.drawn_found;
        format!("{}: {lost} of {poses} drawn configurations are not found", case.arm.description.name)
    });
    let lacking: Vec<String> = lacking.collect();
    ensure!(lacking.is_empty(), "{}", lacking.join("\n"));

    let (mut arms, mut peers) = (vec![], vec![]);
    for (case, worth) in cases.iter().zip(worth) {
        let times = case.times();
        if case.name == OBLIQUE {
            peers.push(case.peer("gen_six_dof", Family::General, &times)?);
            peers.push(case.peer("two_intersecting", Family::TwoMeet, &times)?);
        }
        let mean = MEANS[usize::from(case.name != OBLIQUE)];
        let share = |n: usize| n as f64 / poses as f64;
        arms.push(json!({
            "title": case.arm.description.name, "times": figure(&times, [Some(mean), Some(P99)]),
            "solutions": share(worth.check.distinct.iter().sum()), "second": share(worth.second),
            "complete": share(worth.complete), "worst": worth.check.worst,
        }));
    }
    Ok(json!({"arms": arms, "peers": peers}))
}

impl Case {
    /// An arm of the catalogue; without a name the calibrated one.
    fn new(name: &'static str, count: usize, random: &mut impl FnMut() -> f64) -> Result<Self> {
        let description = if name.is_empty() {
            read_toml(CALIBRATED).map_err(|_| anyhow!("the calibrated arm cannot be read"))?.0
        } else {
            read(name)?
        };
        let arm = Arm::new(description)?;
        let solver = GeneralSolver::new(&arm.robot, &arm.space).map_err(|e| anyhow!("{name}: {e}"))?;
        let drawn: Vec<Joints> = (0..count).map(|_| std::array::from_fn(|_| random())).collect();
        let poses = drawn.iter().map(|q| arm.robot.pose(q)).collect();
        Ok(Case { name, arm, solver, drawn, poses })
    }

    fn worth(&self) -> Worth {
        let (mut answers, mut second, mut complete) = (vec![], 0, 0);
        for pose in &self.poses {
            let answer = self.solver.solve(pose);
            second += usize::from(self.solver.splits(pose) > 1);
            complete += usize::from(answer.is_complete());
            answers.push(joints(answer.solutions.into_iter().map(|s| s.q)));
        }
        Worth { check: self.check(&answers), second, complete }
    }

    /// Holds the answers for the first poses against them.
    fn check(&self, answers: &[Vec<Joints>]) -> Check {
        let rows_of = |q: &Joints| rows(&self.arm.robot.pose(q));
        let poses: Vec<Rows> = self.poses.iter().take(answers.len()).map(rows).collect();
        Check::new(answers, &poses, &self.drawn, rows_of)
    }

    /// What each pose takes, µs.
    fn times(&self) -> Vec<f64> {
        times(self.poses.len(), |k| {
            black_box(self.solver.solve(black_box(&self.poses[k])));
        })
    }

    /// `ik-geo` on the first poses, beside our times.
    fn peer(&self, name: &str, family: Family, ours: &[f64]) -> Result<Value> {
        let geo = Geo::new(&self.arm.robot, family);
        let (theirs, own) = (geo.position(&self.drawn[0]), self.poses[0].translation.0);
        let apart = theirs.iter().zip(own).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        ensure!(apart < 1e-12, "{} is another arm for `ik-geo`", self.arm.description.name);
        let poses: Vec<Rows> = self.poses.iter().take(PEER_POSES).map(rows).collect();
        let mut solve = geo.solver(&poses);
        let answers: Vec<Vec<Joints>> = (0..poses.len()).map(&mut solve).collect();
        let check = self.check(&answers);
        let misses = answers
            .iter()
            .zip(&poses)
            .flat_map(|(answers, pose)| answers.iter().map(|q| missed(&rows(&self.arm.robot.pose(q)), pose)));
        let misses: Vec<f64> = misses.collect();
        let theirs = times(poses.len(), |k| {
            black_box(solve(k));
        });
        let ratio = theirs.iter().sum::<f64>() / ours[..poses.len()].iter().sum::<f64>();
        Ok(json!({
            "title": self.arm.description.name, "name": name, "poses": poses.len(), "times": figure(&theirs, [None; 2]),
            "ratio": ratio, "answers": misses.len(), "valid": misses.iter().filter(|m| **m <= VALID).count(),
            "best": misses.into_iter().fold(f64::INFINITY, f64::min), "drawn_found": check.drawn_found,
        }))
    }
}

fn joints(found: impl Iterator<Item = Vec<f64>>) -> Vec<Joints> {
    found.map(|q| q.try_into().expect("six joints")).collect()
}
