//! Paths of the hand.

use super::known::Known;
use super::timed::{Still, Timed, by_quintic, fastest};
use super::{Course, PlanError, PlanOptions, Planned, TimingLaw};
use crate::description::Description;
use crate::mechanism::Robot;
use crate::motion::follow::{Alternative, FollowOptions, Followed, Follower};
use crate::motion::hand::HandPath;
use crate::motion::path::{Ends, cubic_spline_at};
use crate::motion::{JointPath, MotionError};
use std::cmp::Reverse;

/// Along a path from a configuration, or from the best.
pub(super) fn plan(
    description: &Description,
    robot: &Robot<f64>,
    follower: &mut Follower,
    (path, start): (&dyn HandPath, Option<Vec<f64>>),
    limits: &Known<'_>,
    options: &PlanOptions,
) -> Result<Planned, PlanError> {
    let follow = FollowOptions { max_deviation: options.max_deviation, ..FollowOptions::default() };
    let is_asked = options.alternatives || start.is_none();
    let mut alternatives =
        if is_asked { follower.alternatives(path, start.as_deref(), &follow) } else { vec![] };
    let start = match start {
        Some(q) => q,
        None => best(&alternatives).ok_or(PlanError::OutOfReach)?.start.clone(),
    };
    let mut followed = follower.follow(path, &start, &follow);
    if !followed.is_clean() && alternatives.is_empty() {
        alternatives = follower.alternatives(path, Some(&start), &follow);
    }
    let (trajectory, timing): Timed = if followed.reached <= 0.0 {
        (Box::new(Still(start)), TimingLaw::Still.into())
    } else {
        match &limits.all {
            Some(all) if all.jerk().is_some() => {
                let smooth = smooth(robot, path, &mut followed)?;
                fastest(description, smooth, (all, limits.torque), options.duration)?
            }
            Some(all) => {
                fastest(description, followed.joints.clone(), (all, limits.torque), options.duration)?
            }
            None => {
                let usual = (path.length() * followed.reached / options.speed).max(0.5);
                let durations = (usual, options.duration);
                by_quintic(description, followed.joints.clone(), durations, limits.velocity)?
            }
        }
    };
    let course = Course::Hand(path.stretches());
    Ok(Planned { trajectory, course, timing, followed: Some(followed), alternatives })
}

/// The branch that goes furthest, within the limits, past the fewest singular configurations; of equals the first.
fn best(alternatives: &[Alternative]) -> Option<&Alternative> {
    alternatives.iter().rev().max_by(|a, b| {
        let key = |x: &Alternative| (x.reached >= 1.0, x.within_limits, Reverse(x.singular));
        key(a).cmp(&key(b)).then(a.reached.total_cmp(&b.reached))
    })
}

/// A path without jumps of q'', through the same samples; how far the hand then leaves its path is measured again.
fn smooth(
    robot: &Robot<f64>,
    path: &dyn HandPath,
    followed: &mut Followed,
) -> Result<impl JointPath + 'static, MotionError> {
    let (s, samples) = (followed.joints.parameters(), followed.joints.samples());
    let last = s.len() - 1;
    let ends = Ends::Clamped(followed.joints.eval(0.0).dq, followed.joints.eval(s[last]).dq);
    let spline = cubic_spline_at(s, samples, &ends)?;
    let places = s.windows(2).flat_map(|w| (1..8).map(move |k| w[0] + (w[1] - w[0]) * f64::from(k) / 8.0));
    let away =
        places.map(|at| (robot.pose(&spline.eval(at).q).translation - path.pose(at).translation).norm());
    followed.deviation = away.fold(0.0, f64::max);
    Ok(spline)
}
