//! Limits of velocity, acceleration and jerk, joint by joint.

use super::error::{MotionError, finite, joints, positive};

/// A lowest and a highest value; zero is between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The lowest value: zero or negative.
    pub lower: f64,
    /// The highest value: zero or positive.
    pub upper: f64,
}

impl Range {
    /// From `-bound` to `bound`.
    pub fn symmetric(bound: f64) -> Self {
        Self { lower: -bound, upper: bound }
    }

    /// The greatest magnitude that is allowed in both directions.
    pub(crate) fn both_ways(self) -> f64 {
        self.upper.min(-self.lower)
    }

    /// 1 / lower and 1 / upper; infinite with the signs of the directions where they are zero.
    pub(super) fn inverse(self) -> [f64; 2] {
        [-1.0 / self.lower.abs(), 1.0 / self.upper.abs()]
    }

    /// How much of the limit `value` takes: at most 1 within the limits.
    pub fn share(self, value: f64) -> f64 {
        let limit = if value < 0.0 { self.lower } else { self.upper };
        if value == 0.0 { 0.0 } else { value.abs() / limit.abs() }
    }
}

/// What the joints can do: rad/s, rad/s², rad/s³ (or m/s, m/s², m/s³ for a prismatic joint), one entry a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    velocity: Vec<Range>,
    acceleration: Vec<Range>,
    jerk: Option<Vec<f64>>,
}

impl Limits {
    /// Limits that are the same in both directions.
    ///
    /// # Errors
    /// If a limit is not a positive finite number, or the lists differ in length.
    pub fn symmetric(velocity: &[f64], acceleration: &[f64]) -> Result<Self, MotionError> {
        positive("velocity limits", velocity)?;
        positive("acceleration limits", acceleration)?;
        let ranges = |list: &[f64]| list.iter().map(|&b| Range::symmetric(b)).collect();
        Self::new(ranges(velocity), ranges(acceleration))
    }

    /// Limits of velocities alone, the same in both directions: for timings that something else bounds.
    ///
    /// # Errors
    /// If a limit is not a positive finite number, or there is none.
    pub(crate) fn of_velocity(velocity: &[f64]) -> Result<Self, MotionError> {
        let limits = Self::symmetric(velocity, &vec![1.0; velocity.len()])?;
        let acceleration = vec![Range::symmetric(f64::INFINITY); velocity.len()];
        Ok(Self { acceleration, ..limits })
    }

    /// Limits that may differ between the directions.
    ///
    /// # Errors
    /// If a number is not finite, an interval is empty or does not contain zero, or the lists differ in length.
    pub fn new(velocity: Vec<Range>, acceleration: Vec<Range>) -> Result<Self, MotionError> {
        let (expected, found) = (velocity.len(), acceleration.len());
        if expected != found || expected == 0 {
            return Err(MotionError::Joints { what: "acceleration limits", expected, found });
        }
        for (what, ranges) in [("velocity", &velocity), ("acceleration", &acceleration)] {
            for (joint, range) in ranges.iter().enumerate() {
                finite("limits", &[range.lower, range.upper])?;
                if range.lower > 0.0 || range.upper < 0.0 || range.lower >= range.upper {
                    return Err(MotionError::Limits(what, joint));
                }
            }
        }
        Ok(Self { velocity, acceleration, jerk: None })
    }

    /// The same limits, and the jerk of each joint at most `jerk` in both directions.
    ///
    /// # Errors
    /// If a limit is not a positive finite number, or there is not one for each joint.
    pub fn with_jerk(self, jerk: &[f64]) -> Result<Self, MotionError> {
        joints("jerk limits", self.dof(), jerk)?;
        positive("jerk limits", jerk)?;
        Ok(Self { jerk: Some(jerk.to_vec()), ..self })
    }

    /// The number of joints.
    pub fn dof(&self) -> usize {
        self.velocity.len()
    }

    /// Velocities, one interval a joint.
    pub fn velocity(&self) -> &[Range] {
        &self.velocity
    }

    /// Accelerations, one interval a joint.
    pub fn acceleration(&self) -> &[Range] {
        &self.acceleration
    }

    /// Greatest jerks, where they are limited.
    pub fn jerk(&self) -> Option<&[f64]> {
        self.jerk.as_deref()
    }
}
