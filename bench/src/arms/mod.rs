//! Inverse kinematics without a closed form: how long poses of every kind of arm take, each for itself.
//!
//! Before anything is timed, every answer is put into the forward model.

mod general;
mod numeric;
mod redundant;

use crate::inverse::{Rows, VALID};
use crate::measure::Spread;
use anyhow::Result;
use denavit::geometry::Transform;
use denavit::inverse::{Goal, JointSpace, variables};
use denavit::{Description, Robot};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Poses of each arm; fewer where a quick run is asked for.
const POSES: [usize; 2] = [10_000, 2_000];
/// What a joint may be beyond its limit, for rounding, radians.
const SLACK: f64 = 1e-9;

/// Measures all arms; prints one JSON object.
///
/// # Errors
/// If an arm cannot be read, or the configuration that a pose was made from is not among all its solutions.
pub fn run(is_quick: bool, mut random: impl FnMut() -> f64) -> Result<()> {
    let poses = POSES[usize::from(is_quick)];
    let general = general::measure(poses, &mut random)?;
    let redundant = redundant::measure(poses, &mut random)?;
    let numeric = numeric::measure(poses, &mut random)?;
    let following = redundant::following(&mut random)?;
    println!(
        "{}",
        json!({"poses": poses, "general": general, "redundant": redundant, "numeric": numeric, "following": following})
    );
    Ok(())
}

/// A robot with numbers and its joints.
struct Arm {
    description: Description,
    robot: Robot<f64>,
    space: JointSpace,
}

impl Arm {
    fn new(description: Description) -> Result<Self> {
        let robot = Robot::numeric(&description)?;
        let space = JointSpace::new(&description, &robot);
        Ok(Arm { description, robot, space })
    }

    /// A random configuration within the limits; an angle without limits is in (−π, π).
    fn configuration(&self, random: &mut impl FnMut() -> f64) -> Vec<f64> {
        let value = |limits: &Option<[f64; 2]>| {
            let [low, high] = limits.unwrap_or([-PI, PI]);
            low + (high - low) * (random() / TAU + 0.5)
        };
        self.space.limits.iter().map(value).collect()
    }

    /// The poses of random configurations within the limits.
    fn targets(&self, count: usize, random: &mut impl FnMut() -> f64) -> Vec<Transform<f64>> {
        (0..count).map(|_| self.robot.pose(&self.configuration(random))).collect()
    }

    /// How many answers are a configuration within the limits that meets its pose.
    fn solved(&self, poses: &[Transform<f64>], answers: &[Option<Vec<f64>>]) -> usize {
        let good = |(pose, q): (&Transform<f64>, &Option<Vec<f64>>)| {
            q.as_ref().is_some_and(|q| {
                self.is_within(q) && missed(&rows(&self.robot.pose(q)), &rows(pose)) <= VALID
            })
        };
        poses.iter().zip(answers).filter(|&p| good(p)).count()
    }

    fn is_within(&self, q: &[f64]) -> bool {
        let inside = |(x, limits): (&f64, &Option<[f64; 2]>)| {
            limits.is_none_or(|[low, high]| (low - SLACK..=high + SLACK).contains(x))
        };
        q.iter().zip(&self.space.limits).all(inside)
    }
}

fn rows(pose: &Transform<f64>) -> Rows {
    variables(Goal::Pose, pose, &[]).try_into().expect("three rows of four")
}

/// By how much a pose misses another at most, in metres or in an entry of the rotation.
fn missed(a: &Rows, b: &Rows) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A figure: the times of poses and what the project demands of their mean and their 99th hundredth, µs.
fn figure(times: &[f64], limits: [Option<f64>; 2]) -> Value {
    let Spread { mean, median, p99 } = Spread::of(times);
    json!({"mean": mean, "median": median, "p99": p99, "limits": limits})
}
