//! What of their limits a motion takes: it is looked at once more, by itself.

use crate::dynamics::drive_torques;
use crate::motion::jerk_limited::SmoothTimedPath;
use crate::motion::{JointPath, JointState, Limits, TimedPath, TorqueLimits, Trajectory};

/// At so many instants, evenly in time.
const INSTANTS: usize = 10_000;

/// The greatest parts of their limits that a motion takes, 1 at the limit, and how often that was looked at.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Held {
    /// Instants, from the start to the end, evenly.
    pub instants: usize,
    /// Velocities.
    pub velocity: f64,
    /// Accelerations, if they are limited.
    pub acceleration: Option<f64>,
    /// Jerks, if they are limited.
    pub jerk: Option<f64>,
    /// Torques, if they are limited.
    pub torque: Option<f64>,
}

/// The torque that takes most of its limit.
#[derive(Clone, Copy, Default)]
pub(super) struct Hardest {
    pub joint: usize,
    /// Seconds.
    pub t: f64,
    pub share: f64,
}

/// A path with its timing.
pub(super) trait TimedAlongPath: Trajectory {
    /// The jerk at a time, if it has one.
    fn jerk(&self, t: f64) -> Option<Vec<f64>>;
}

impl<P: JointPath> TimedAlongPath for TimedPath<P> {
    fn jerk(&self, _: f64) -> Option<Vec<f64>> {
        None
    }
}

impl<P: JointPath> TimedAlongPath for SmoothTimedPath<P> {
    fn jerk(&self, t: f64) -> Option<Vec<f64>> {
        Some(SmoothTimedPath::jerk(self, t))
    }
}

/// What the motion takes of its limits when it is slowed down by a factor.
pub(super) fn held(
    motion: &dyn TimedAlongPath,
    factor: f64,
    limits: &Limits,
    torques: Option<&TorqueLimits>,
) -> (Held, Hardest) {
    let greatest = |shares: &mut dyn Iterator<Item = f64>| shares.fold(0.0, f64::max);
    let (mut velocity, mut acceleration, mut jerk) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut hardest = Hardest::default();
    for k in 0..=INSTANTS {
        let t = motion.duration() * k as f64 / INSTANTS as f64;
        let JointState { q, mut qd, mut qdd } = motion.eval(t);
        qd.iter_mut().for_each(|v| *v /= factor);
        qdd.iter_mut().for_each(|a| *a /= factor * factor);
        velocity = velocity.max(greatest(&mut limits.velocity().iter().zip(&qd).map(|(r, &v)| r.share(v))));
        acceleration =
            acceleration.max(greatest(&mut limits.acceleration().iter().zip(&qdd).map(|(r, &a)| r.share(a))));
        if let (Some(limits), Some(jerks)) = (limits.jerk(), motion.jerk(t)) {
            jerk =
                jerk.max(greatest(&mut limits.iter().zip(&jerks).map(|(l, j)| j.abs() / factor.powi(3) / l)));
        }
        if let Some(torques) = torques {
            let needed = drive_torques(torques.arm(), &q, &qd, &qdd, None);
            for (joint, (range, torque)) in torques.ranges().iter().zip(needed).enumerate() {
                let share = range.share(torque);
                if share > hardest.share {
                    hardest = Hardest { joint, t: t * factor, share };
                }
            }
        }
    }
    let held = Held {
        instants: INSTANTS + 1,
        velocity,
        acceleration: limits.acceleration().iter().all(|a| a.upper.is_finite()).then_some(acceleration),
        jerk: limits.jerk().map(|_| jerk),
        torque: torques.map(|_| hardest.share),
    };
    (held, hardest)
}
