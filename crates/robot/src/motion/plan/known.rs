//! What is known of how fast the joints can be.

use super::PlanError;
use crate::description::{Description, Row};
use crate::motion::error::joints;
use crate::motion::{Limits, MotionError, TorqueLimits};
use denavit_symbolic::{Expr, Symbol};

/// Limits of the joints as far as they are known, the same in both directions, one entry a joint; a quantity that is not
/// known of all joints is nothing.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct KnownLimits {
    /// Velocities, rad/s or m/s.
    pub velocity: Option<Vec<f64>>,
    /// Accelerations, rad/s² or m/s².
    pub acceleration: Option<Vec<f64>>,
    /// Jerks, rad/s³ or m/s³.
    pub jerk: Option<Vec<f64>>,
    /// Torques, N m or N, of an arm with masses.
    pub torque: Option<TorqueLimits>,
}

impl KnownLimits {
    /// Those that a description states: velocities and accelerations.
    pub fn of(description: &Description) -> Self {
        let value = |s: Symbol| description.value(s);
        let all = |cell: &dyn Fn(&Row) -> Option<Expr>| -> Option<Vec<f64>> {
            let rows = description.rows.iter().filter(|r| r.variable.is_some());
            rows.map(|r| cell(r)?.eval(value).ok()).collect()
        };
        KnownLimits {
            velocity: all(&|r| r.velocity),
            acceleration: all(&|r| r.acceleration),
            jerk: None,
            torque: None,
        }
    }

    /// These, and where they say nothing the others.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        KnownLimits {
            velocity: self.velocity.or(others.velocity),
            acceleration: self.acceleration.or(others.acceleration),
            jerk: self.jerk.or(others.jerk),
            torque: self.torque.or(others.torque),
        }
    }

    /// For an arm with `n` joints.
    pub(super) fn of_joints(&self, n: usize) -> Result<Known<'_>, PlanError> {
        for (what, list) in [
            ("velocity limits", &self.velocity),
            ("acceleration limits", &self.acceleration),
            ("jerk limits", &self.jerk),
        ] {
            list.iter().try_for_each(|l| joints(what, n, l)).map_err(PlanError::Limits)?;
        }
        let (velocity, jerk) = (self.velocity.as_deref(), self.jerk.as_deref());
        let torque = self.torque.as_ref();
        if let Some(found) = torque.map(TorqueLimits::dof).filter(|&found| found != n) {
            let what = "torque limits";
            return Err(PlanError::Limits(MotionError::Joints { what, expected: n, found }));
        }
        let all = match (velocity, self.acceleration.as_ref(), torque) {
            (Some(v), Some(a), _) if n > 0 => Some(Limits::symmetric(v, a)),
            // Torques bound accelerations.
            (Some(v), None, Some(_)) if n > 0 => Some(Limits::of_velocity(v)),
            _ => None,
        };
        let all = all.map(|limits| match jerk {
            Some(jerk) => limits.and_then(|l| l.with_jerk(jerk)),
            None => limits,
        });
        let all = all.transpose().map_err(PlanError::Limits)?;
        Ok(Known { velocity, jerk, torque, all })
    }
}

/// Known limits that fit the arm.
pub(super) struct Known<'a> {
    pub velocity: Option<&'a [f64]>,
    pub jerk: Option<&'a [f64]>,
    pub torque: Option<&'a TorqueLimits>,
    /// Velocities and accelerations, perhaps jerks, if velocities and accelerations are known; no accelerations with torques.
    pub all: Option<Limits>,
}
