//! Timings of a path.

use super::held::{Hardest, Held, TimedAlongPath, held, slowed};
use super::{PlanError, Timing, TimingLaw};
use crate::description::Description;
use crate::motion::timing::Grid;
use crate::motion::{
    InTime, JerkLimited, JointPath, JointState, Limits, Slowed, TimeOptimal, TorqueLimits, Trajectory,
};

/// A torque that is more than this part of its limit is beyond it; so much is measured between the points of a grid.
const BEYOND: f64 = 1.002;

/// Intervals of a timing within torques, which change more along them than velocities and accelerations do.
const WITHIN_TORQUES: usize = 4000;

/// A motion, and how it was timed.
pub(super) type Timed = (Box<dyn Trajectory>, Timing);

impl From<TimingLaw> for Timing {
    fn from(by: TimingLaw) -> Self {
        Timing { by, slowed_to: None, held: None }
    }
}

/// The fastest timing of a path, or one over the duration asked for.
pub(super) fn fastest<P: JointPath + 'static>(
    description: &Description,
    path: P,
    (limits, torques): (&Limits, Option<&TorqueLimits>),
    asked: Option<f64>,
) -> Result<Timed, PlanError> {
    let accelerations = limits.acceleration().iter().all(|a| a.upper.is_finite());
    let (found, law): (Box<dyn Trajectory>, TimingLaw);
    let looked_at;
    if limits.jerk().is_some() {
        let timed = JerkLimited::default().time_within(path, limits, torques)?;
        looked_at = Some(looked_at_in(&timed, limits, torques, asked));
        law = match torques {
            None => TimingLaw::JerkLimited,
            Some(_) => TimingLaw::WithinJerksAndTorques { accelerations },
        };
        found = Box::new(timed);
    } else {
        let mut options = TimeOptimal::default();
        if torques.is_some() {
            options.grid = Grid::Graded(WITHIN_TORQUES);
        }
        let timed = options.time_within(path, limits, torques)?;
        looked_at = torques.map(|torques| looked_at_in(&timed, limits, Some(torques), asked));
        law = match torques {
            None => TimingLaw::TimeOptimal,
            Some(torques) => TimingLaw::WithinTorques { accelerations, fastest: !torques.is_viscous() },
        };
        found = Box::new(timed);
    }
    if let (Some((_, _, hardest)), Some(_)) = (&looked_at, asked)
        && hardest.share > BEYOND
    {
        let joint = description.variables()[hardest.joint].symbol.name().to_string();
        return Err(PlanError::SlowTorque { joint, t: hardest.t, share: hardest.share });
    }
    let timing = Timing { held: looked_at.map(|(_, held, _)| held), ..law.into() };
    let found = match looked_at {
        Some((factor, ..)) if factor > 1.0 => Box::new(Slowed::new(found, factor)),
        _ => found,
    };
    over_duration((found, timing), asked)
}

/// By how much a motion is slowed down to be within its limits, and what it takes of them, over the duration asked for if that is longer.
fn looked_at_in(
    motion: &dyn TimedAlongPath,
    limits: &Limits,
    torques: Option<&TorqueLimits>,
    asked: Option<f64>,
) -> (f64, Held, Hardest) {
    let (factor, part, hardest) = slowed(motion, limits, torques);
    match slower(motion, asked) {
        longer if longer > factor => {
            let (part, hardest) = held(motion, longer, limits, torques);
            (factor, part, hardest)
        }
        _ => (factor, part, hardest),
    }
}

/// By how much a motion is slowed down to take as long as was asked for.
fn slower(motion: &dyn TimedAlongPath, asked: Option<f64>) -> f64 {
    let own = motion.duration();
    asked.filter(|_| own > 0.0).map_or(1.0, |asked| (asked / own).max(1.0))
}

/// A path by a quintic law: over the duration asked for, or the usual one, longer if velocities are limited.
pub(super) fn by_quintic<P: JointPath + Clone + 'static>(
    description: &Description,
    path: P,
    (usual, asked): (f64, Option<f64>),
    velocity: Option<&[f64]>,
) -> Result<Timed, PlanError> {
    let duration = asked.unwrap_or(usual);
    let timed = InTime::new(path.clone(), duration)?;
    let variables = description.variables();
    let name = |j: usize| variables[j].symbol.name();
    let fastest = timed.fastest();
    let Some(limits) = velocity else {
        let most = fastest.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        let by = TimingLaw::Quintic { duration, fastest: most.map(|(j, v)| (j, *v)) };
        return Ok((Box::new(timed), by.into()));
    };
    let over = fastest.iter().zip(limits).map(|(v, l)| v / l).enumerate();
    let (joint, ratio) = over.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
    match asked {
        Some(asked) if ratio > 1.0 + 1e-9 => Err(PlanError::TooFast {
            asked,
            joint: name(joint).to_string(),
            kind: variables[joint].kind,
            velocity: fastest[joint],
            limit: limits[joint],
            needed: asked * ratio,
        }),
        _ => {
            let needed = duration * ratio.max(if asked.is_some() { 1.0 } else { 1e-6 });
            let duration = if asked.is_some() { duration } else { needed.max(usual) };
            let by = TimingLaw::QuinticWithin { duration };
            Ok((Box::new(InTime::new(path, duration)?), by.into()))
        }
    }
}

/// A motion that takes longer, or as long as it does.
pub(super) fn over_duration((motion, timing): Timed, asked: Option<f64>) -> Result<Timed, PlanError> {
    let own = motion.duration();
    match asked {
        None => Ok((motion, timing)),
        Some(asked) if asked < own * (1.0 - 1e-9) => Err(PlanError::TooShort { asked, needed: own }),
        Some(asked) => {
            let factor = if own > 0.0 { asked / own } else { 1.0 };
            let timing = Timing { slowed_to: Some(asked), ..timing };
            Ok((Box::new(Slowed::new(motion, factor)), timing))
        }
    }
}

/// No motion at all.
pub(super) struct Still(pub Vec<f64>);

impl Trajectory for Still {
    fn dof(&self) -> usize {
        self.0.len()
    }

    fn duration(&self) -> f64 {
        0.0
    }

    fn eval(&self, _: f64) -> JointState {
        JointState::at_rest(&self.0)
    }
}
