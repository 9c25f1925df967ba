//! A motion at regular times.

use super::Planned;
use crate::description::Description;
use crate::geometry::Transform;
use crate::mechanism::Robot;
use crate::motion::{JointState, MotionError};
use crate::space::JointSpace;
use crate::velocity::{Viewpoint, Whole, geometric};

/// Samples a motion has at most where no time between them is given.
const USUAL: f64 = 200.0;

/// A state with what belongs to it.
#[derive(Clone, PartialEq, Debug)]
pub struct Sample {
    /// Seconds.
    pub t: f64,
    /// The joints.
    pub state: JointState,
    /// The tool in the base.
    pub pose: Transform<f64>,
    /// √det(J Jᵀ), lengths by the arm's size.
    pub manipulability: f64,
}

/// The motion in samples.
#[derive(Clone, PartialEq, Debug)]
pub struct Sampled {
    /// Seconds between samples; the last one is the end.
    pub dt: f64,
    /// In their order.
    pub samples: Vec<Sample>,
}

impl Planned {
    /// Every `dt` seconds; in at most two hundred samples a millisecond or more apart if nothing is said.
    ///
    /// # Errors
    /// If `dt` is not positive or there are too many samples.
    pub fn sampled(
        &self,
        description: &Description,
        robot: &Robot<f64>,
        dt: Option<f64>,
    ) -> Result<Sampled, MotionError> {
        let space = JointSpace::new(description, robot);
        let size = if space.reach > 0.0 { space.reach } else { 1.0 };
        let duration = self.trajectory.duration();
        let dt = dt.unwrap_or_else(|| if duration > 0.0 { (duration / USUAL).max(0.001) } else { 0.01 });
        let states = self.trajectory.resample(dt)?;
        let sample = |(t, state): (f64, JointState)| {
            let jacobian = geometric(robot, &state.q, &Viewpoint::tool());
            let manipulability = Whole::new(&jacobian, &space.is_angle, size).manipulability;
            Sample { t, pose: robot.pose(&state.q), state, manipulability }
        };
        Ok(Sampled { dt, samples: states.into_iter().map(sample).collect() })
    }
}
