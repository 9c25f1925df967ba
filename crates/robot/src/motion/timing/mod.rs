//! The fastest timing of a path under velocity and acceleration limits.
//!
//! TOPP-RA: Pham & Pham, *A new approach to time-optimal path parameterization based on reachability analysis*, IEEE
//! Transactions on Robotics 34 (3), 2018. With x = ṡ² and u = s̈ the accelerations q̈ = q' u + q'' x are linear, and
//! between grid points x is linear in s: xᵢ₊₁ = xᵢ + 2 Δᵢ uᵢ. A pass from the end finds at each grid point the speeds
//! from which the end can be reached, by linear programs in two variables; a pass from the start takes the highest
//! of them that it can reach.

mod between;
mod curved;
mod grid;
mod passes;
mod stage;
mod timed;
mod torques;

pub use grid::{Grid, MIN_INTERVALS};
pub(super) use grid::{divided, is_corner};
pub use timed::TimedPath;
pub use torques::TorqueLimits;
pub(super) use torques::fitting;

use super::error::{MotionError, finite};
use super::limits::Limits;
use super::path::JointPath;
use torques::Torques;

/// Where the limits are imposed on an interval between two grid points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Accelerations at its first point, velocities at its ends.
    Collocation,
    /// Accelerations and velocities at both ends: no jitter at zero-inertia points. Between the ends limits are
    /// exceeded by the order of Δ².
    Interpolation,
    /// Throughout: between the points accelerations are taken as cubics in s by their values and slopes at the ends
    /// (exact on a cubic spline), velocities likewise; where the control points of a cubic are within a limit, it is.
    /// What is exceeded in spite of that on other paths is measured, the limits of the interval are tightened, and the
    /// passes run again.
    Throughout,
}

/// The fastest timing of paths: the options, and [`time`](Self::time).
#[derive(Clone, Debug, PartialEq)]
pub struct TimeOptimal {
    /// The parameters at which speeds are computed.
    pub grid: Grid,
    /// Where limits are imposed.
    pub scheme: Scheme,
    /// The speed ṡ at the start (1/s times the unit of s).
    pub start_speed: f64,
    /// The speed ṡ at the end.
    pub end_speed: f64,
}

impl Default for TimeOptimal {
    /// From rest to rest, on 500 intervals and the knots of the path, with the limits held throughout.
    fn default() -> Self {
        Self { grid: Grid::Uniform(500), scheme: Scheme::Throughout, start_speed: 0.0, end_speed: 0.0 }
    }
}

impl TimeOptimal {
    /// The fastest timing of `path` within `limits` (jerk limits are not looked at: see
    /// [`JerkLimited`](crate::motion::JerkLimited)).
    ///
    /// At a corner, where q' jumps, it stops. Where q' = 0 it does not matter what the velocity limits are, and the
    /// accelerations bound the speed by q'' alone.
    ///
    /// # Errors
    /// If an input is not finite or does not fit; if an end speed is not possible, or no speed at some parameter
    /// leads to the end of the path ([`MotionError::NotControllable`] says at which).
    pub fn time<P: JointPath>(&self, path: P, limits: &Limits) -> Result<TimedPath<P>, MotionError> {
        self.time_within(path, limits, None)
    }

    /// The same within torque limits, too: at the ends of every interval, and with [`Scheme::Throughout`] as far as is measured
    /// between. Where the arm stands still it is to be within them all along the path, with Coulomb's friction against it.
    ///
    /// # Errors
    /// As [`time`](Self::time), and if the arm cannot carry itself somewhere ([`MotionError::Torque`]).
    pub fn time_within<P: JointPath>(
        &self,
        path: P,
        limits: &Limits,
        torque_limits: Option<&TorqueLimits>,
    ) -> Result<TimedPath<P>, MotionError> {
        fitting(path.dof(), limits, torque_limits)?;
        finite("speeds at the ends", &[self.start_speed, self.end_speed])?;
        for (s, speed) in [(0.0, self.start_speed), (path.end(), self.end_speed)] {
            if speed < 0.0 {
                return Err(MotionError::EndSpeed { s, speed, possible: [0.0, f64::INFINITY] });
            }
        }
        let turning = torque_limits.map(TorqueLimits::rubbed).unwrap_or_default();
        let sampled = grid::sample(&path, &self.grid, &turning)?;
        let torques = match torque_limits {
            Some(limits) => Some(Torques::new(limits, &path, &sampled)?),
            None => None,
        };
        let mut program = stage::program(&sampled, limits, self.scheme, torques.as_ref())?;
        let ends = [self.start_speed.powi(2), self.end_speed.powi(2)];
        let mut x = passes::solve(&program, ends)?;
        if self.scheme == Scheme::Throughout {
            between::hold(&path, (limits, torque_limits), &mut program, ends, &mut x)?;
        }
        TimedPath::new(path, program.s, x)
    }
}
