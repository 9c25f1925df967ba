//! Moves of the joints.

use super::known::Known;
use super::timed::{Timed, by_quintic, fastest, over_duration};
use super::{Course, PlanError, PlanOptions, Planned, TimingLaw};
use crate::description::Description;
use crate::motion::path::{Blend, Ends, PiecewisePath, blended, cubic_spline};
use crate::motion::profile::{Law, synchronised};
use crate::motion::{JointState, Limits, MotionError, move_within_limits};
use crate::space::JointSpace;

/// Through configurations, one entry a joint each.
pub(super) fn plan(
    description: &Description,
    points: &[Vec<f64>],
    limits: &Known<'_>,
    options: &PlanOptions,
) -> Result<Planned, PlanError> {
    let course = match points.len() {
        2 => Course::Move,
        n if options.blend.is_some() => Course::Straight(n),
        n => Course::Spline(n),
    };
    let path = || through(points, options.blend);
    let (trajectory, timing) = match (&limits.all, points) {
        (None, _) => by_quintic(description, path()?, (1.0, options.duration), limits.velocity)?,
        (Some(all), [a, b]) if limits.torque.is_none() => {
            over_duration(between([a, b], all, options.law)?, options.duration)?
        }
        (Some(all), _) => fastest(description, path()?, (all, limits.torque), options.duration)?,
    };
    if let Some(j) = outside(description, points) {
        let joint = description.variables()[j].symbol.name().to_string();
        return Err(PlanError::OutsideLimits { joint });
    }
    Ok(Planned { trajectory, course, timing, followed: None, alternatives: vec![] })
}

/// A move from rest to rest by a law, the fastest that the limits know otherwise.
fn between([a, b]: [&[f64]; 2], limits: &Limits, law: Option<Law>) -> Result<Timed, PlanError> {
    let has_jerk = limits.jerk().is_some();
    let law = law.unwrap_or(if has_jerk { Law::DoubleS } else { Law::Trapezoidal });
    if has_jerk && matches!(law, Law::Cubic | Law::Trapezoidal) {
        return Err(PlanError::LawJumps(law));
    }
    if law == Law::DoubleS && has_jerk {
        let found = move_within_limits(&JointState::at_rest(a), &JointState::at_rest(b), limits)?;
        return Ok((Box::new(found), TimingLaw::Fastest.into()));
    }
    let found = synchronised(a, b, limits, law)?;
    Ok((Box::new(found), TimingLaw::Together(law).into()))
}

/// A smooth curve through way-points, or straight lines between them with rounded corners.
fn through(points: &[Vec<f64>], blend: Option<f64>) -> Result<PiecewisePath, MotionError> {
    match blend {
        Some(distance) if points.len() > 2 => {
            blended(points, &vec![distance; points.len() - 2], Blend::Quintic)
        }
        _ => cubic_spline(points, &Ends::Natural),
    }
}

/// The first joint that is outside of its limits in a way-point.
fn outside(description: &Description, points: &[Vec<f64>]) -> Option<usize> {
    let space = JointSpace::without_lengths(description);
    (0..space.limits.len()).find(|&j| {
        let out = |x: f64| space.limits[j].is_some_and(|[low, high]| x < low - 1e-9 || x > high + 1e-9);
        points.iter().any(|p| out(p[j]))
    })
}
