//! What of their limits a motion takes: it is looked at once more, by itself.

use crate::dynamics::drive_torques;
use crate::motion::jerk_limited::SmoothTimedPath;
use crate::motion::{JointPath, JointState, Limits, TimedPath, TorqueLimits, Trajectory};

/// At so many instants, evenly in time.
const INSTANTS: usize = 10_000;
/// And at so many in each interval between points of a grid.
const WITHIN: usize = 4;
/// A part of a limit that is above it by rounding alone.
const AT_LIMIT: f64 = 1.0 + 1e-9;
/// So often a motion is slowed down until it is within its limits.
const ROUNDS: usize = 30;

/// The greatest parts of their limits that a motion takes, 1 at the limit, and how often that was looked at.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Held {
    /// Instants, from the start to the end: evenly, and where there is a grid in each of its intervals.
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

    /// The times of its grid, between which it is smooth, if it has one.
    fn grid(&self) -> &[f64];
}

impl<P: JointPath> TimedAlongPath for TimedPath<P> {
    fn jerk(&self, _: f64) -> Option<Vec<f64>> {
        None
    }

    fn grid(&self) -> &[f64] {
        self.times()
    }
}

impl<P: JointPath> TimedAlongPath for SmoothTimedPath<P> {
    fn jerk(&self, t: f64) -> Option<Vec<f64>> {
        Some(SmoothTimedPath::jerk(self, t))
    }

    fn grid(&self) -> &[f64] {
        &[]
    }
}

/// When a motion is looked at.
fn instants(motion: &dyn TimedAlongPath) -> Vec<f64> {
    let even = (0..=INSTANTS).map(|k| motion.duration() * k as f64 / INSTANTS as f64);
    let within = motion.grid().windows(2).flat_map(|ends| {
        // From its first point to just before its last.
        let at = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / WITHIN as f64;
        (0..WITHIN).map(at).chain([ends[1].next_down().max(ends[0])])
    });
    let mut all: Vec<f64> = even.chain(within).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// By how much a motion has to be slowed down to be within its limits, and what it takes of them then. Where slowing down does not
/// help, as it may not against viscous friction, it stays as it is.
pub(super) fn slowed(
    motion: &dyn TimedAlongPath,
    limits: &Limits,
    torques: Option<&TorqueLimits>,
) -> (f64, Held, Hardest) {
    let as_it_is = held(motion, 1.0, limits, torques);
    let (mut factor, mut found) = (1.0, as_it_is);
    for _ in 0..ROUNDS {
        let (part, hardest) = found;
        let kinematic =
            part.velocity.max(part.acceleration.unwrap_or(0.0).sqrt()).max(part.jerk.unwrap_or(0.0).cbrt());
        let dynamic = torques.map_or(Some(1.0), |torques| relief(motion, factor, hardest, torques));
        let is_within = kinematic <= AT_LIMIT && hardest.share <= AT_LIMIT;
        match dynamic {
            _ if is_within => return (factor, part, hardest),
            Some(dynamic) if kinematic.max(dynamic) > 1.0 => factor *= kinematic.max(dynamic),
            _ => break,
        }
        found = held(motion, factor, limits, torques);
    }
    (1.0, as_it_is.0, as_it_is.1)
}

/// By how much more a motion has to be slowed down for the torque that takes most to be within its limit at that instant.
fn relief(motion: &dyn TimedAlongPath, factor: f64, hardest: Hardest, torques: &TorqueLimits) -> Option<f64> {
    if hardest.share <= AT_LIMIT {
        return Some(1.0);
    }
    let JointState { q, qd, qdd } = motion.eval(hardest.t / factor);
    let share = |more: f64| {
        let by = factor * more;
        let (qd, qdd): (Vec<f64>, Vec<f64>) =
            (qd.iter().map(|v| v / by).collect(), qdd.iter().map(|a| a / (by * by)).collect());
        let torque = drive_torques(torques.arm(), &q, &qd, &qdd, None)[hardest.joint];
        torques.ranges()[hardest.joint].share(torque)
    };
    let (mut low, mut high) = (1.0, 2.0);
    if share(high) > 1.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if share(middle) > 1.0 { low = middle } else { high = middle }
    }
    Some(high)
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
    let instants = instants(motion);
    for &t in &instants {
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
        instants: instants.len(),
        velocity,
        acceleration: limits.acceleration().iter().all(|a| a.upper.is_finite()).then_some(acceleration),
        jerk: limits.jerk().map(|_| jerk),
        torque: torques.map(|_| hardest.share),
    };
    (held, hardest)
}
