//! Joint-space motions in time, whatever they are made of.

use super::MAX_SAMPLES;
use super::error::{MotionError, positive};

/// Positions, velocities and accelerations of all joints (rad, rad/s, rad/s²; m for a prismatic joint).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointState {
    /// Positions, one a joint.
    pub q: Vec<f64>,
    /// Velocities, one a joint.
    pub qd: Vec<f64>,
    /// Accelerations, one a joint.
    pub qdd: Vec<f64>,
}

impl JointState {
    /// At rest in `q`.
    pub fn at_rest(q: &[f64]) -> Self {
        Self { q: q.to_vec(), qd: vec![0.0; q.len()], qdd: vec![0.0; q.len()] }
    }
}

/// A motion of all joints from the time 0 to its duration.
pub trait Trajectory: Send + Sync {
    /// The number of joints.
    fn dof(&self) -> usize;

    /// Seconds from the start to the end.
    fn duration(&self) -> f64;

    /// The state at `t` seconds; before the start and after the end, the state there.
    fn eval(&self, t: f64) -> JointState;

    /// States at the times 0, `dt`, 2 `dt`, … and at the end, each with its time.
    ///
    /// # Errors
    /// If `dt` is not a positive finite number, or there are more than [`MAX_SAMPLES`].
    fn resample(&self, dt: f64) -> Result<Vec<(f64, JointState)>, MotionError> {
        positive("the time between samples", &[dt])?;
        let steps = self.duration() / dt;
        if steps > MAX_SAMPLES as f64 {
            return Err(MotionError::TooMany("samples", steps));
        }
        // A last step that differs from a whole one by rounding alone is the end itself.
        let whole = (steps - 1e-9).ceil().max(0.0) as usize;
        let times = (0..whole).map(|k| k as f64 * dt).chain([self.duration()]);
        Ok(times.map(|t| (t, self.eval(t))).collect())
    }
}
