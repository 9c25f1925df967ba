//! Whether a configuration continues the one of the pose before, or is on another branch.

use crate::geometry::Transform;
use crate::inverse::{Goal, InverseKinematics, newton};
use crate::motion::hand::{HandPath, Line, Orientation};

/// That the joints do not go on from one configuration to the next as the hand goes on from pose to pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Jump {
    /// The joint that is farthest from where it would go on to, or from where it was.
    pub joint: usize,
    /// By how much it moves from pose to pose, radians or metres.
    pub by: f64,
    /// Whether it is the same branch, a joint gone back by whole turns.
    pub same_branch: bool,
    /// Why.
    pub why: Cause,
}

/// Why a configuration does not go on from the one before.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Cause {
    /// A joint would pass its limit.
    Limit {
        /// The joint, from 0.
        joint: usize,
        /// The limit.
        limit: f64,
    },
    /// The branch ends between the poses: after this part of the way there is nothing near the last configuration.
    End(f64),
    /// The branch goes on within the limits; this configuration is nearer.
    Nearer,
}

/// The longest way of a joint in a step, in its unit.
const LONGEST: f64 = 0.3;
/// The shortest step, of the way from pose to pose.
const SHORTEST: f64 = 1e-6;
/// Steps after which the branch counts as ended.
const STEPS: usize = 4_000;
/// What a configuration that has a pose may miss it by.
const SOLVED: f64 = 1e-9;
/// Configurations this near are one.
const SAME: f64 = 1e-6;

impl Jump {
    /// Between the solutions `from` and `to` of two poses, with the hand on the straight line between these.
    pub fn between(
        inverse: &InverseKinematics,
        [before, pose]: [&Transform<f64>; 2],
        [from, to]: [&[f64]; 2],
    ) -> Option<Self> {
        let space = &inverse.space;
        let raw = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).enumerate().map(|(j, (x, y))| (y - x) / space.unit(j)).collect()
        };
        let far = |way: &[f64]| way.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let found = continued(inverse, [before, pose], from, &|a, b| far(&raw(a, b)));
        let (off, same_branch, why) = match found {
            Ok(on) => {
                let size = inverse.size(pose);
                let way = |q: &[f64]| q.iter().zip(to).map(|(x, y)| y - x).collect();
                // A member of the same family: the arm can go there with its hand still.
                let there =
                    newton::slide(&inverse.robot, inverse.goal, pose, &on, (&inverse.given, way), size);
                if far(&raw(&there, to)) <= SAME {
                    return None;
                }
                (raw(&on, to), space.is_same(&on, to), cause(inverse, &on))
            }
            Err(s) => (raw(from, to), false, Cause::End(s)),
        };
        let joint = (0..off.len()).max_by(|&a, &b| off[a].abs().total_cmp(&off[b].abs()))?;
        Some(Jump { joint, by: to[joint] - from[joint], same_branch, why })
    }
}

/// Why a configuration that goes on from the last one was not taken.
fn cause(inverse: &InverseKinematics, on: &[f64]) -> Cause {
    let space = &inverse.space;
    let beyond = on.iter().zip(&space.limits).enumerate().find_map(|(joint, (&x, limits))| {
        let ([low, high], slack) = ((*limits)?, SOLVED * space.unit(joint));
        let limit = if x < low - slack { Some(low) } else { Some(high).filter(|h| x > h + slack) };
        Some(Cause::Limit { joint, limit: limit? })
    });
    beyond.unwrap_or(Cause::Nearer)
}

/// The configuration that goes on from another, as the hand goes from pose to pose; else up to which part of the way.
fn continued(
    inverse: &InverseKinematics,
    [before, pose]: [&Transform<f64>; 2],
    from: &[f64],
    distance: &dyn Fn(&[f64], &[f64]) -> f64,
) -> Result<Vec<f64>, f64> {
    let (robot, goal, size) = (&inverse.robot, inverse.goal, inverse.size(pose));
    let path = Line { from: *before, to: *pose, orientation: Orientation::Slerp };
    let directions = match goal {
        Goal::Pose => 6,
        Goal::PositionAndAxis => 5,
        Goal::Position => 3,
    };
    // An arm with fewer joints than directions has not all poses in between.
    let has_all = robot.joints - inverse.given.len() >= directions;
    let (mut q, mut s, mut step) = (from.to_vec(), 0.0, 1.0);
    for _ in 0..STEPS {
        let to = if s + step >= 1.0 { 1.0 } else { s + step };
        let there = if to < 1.0 { path.pose(to) } else { *pose };
        let next = newton::polish(robot, goal, &there, &q, &inverse.given, size);
        let is_far = |miss: f64| miss > SOLVED && (has_all || to >= 1.0);
        match next.filter(|(next, miss)| !is_far(*miss) && distance(&q, next) <= LONGEST) {
            Some((next, _)) if to >= 1.0 => return Ok(next),
            Some((next, _)) => (q, s, step) = (next, to, 1.5 * step),
            None if step < SHORTEST => return Err(s),
            None => step *= 0.5,
        }
    }
    Err(s)
}
