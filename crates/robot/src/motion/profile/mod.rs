//! Time laws of one coordinate: position, velocity, acceleration and jerk as functions of time.
//!
//! Biagiotti & Melchiorri, *Trajectory Planning for Automatic Machines and Robots* (2008), chapters 2 and 3.

mod double_s;
mod phases;
mod polynomial;
mod synchronised;
mod trapezoidal;

pub use double_s::double_s;
pub use phases::{Phase, Phases};
pub use polynomial::Polynomial;
pub(super) use polynomial::hermite;
pub use synchronised::{JointMove, Law, TimeLaw, synchronised};
pub use trapezoidal::trapezoidal;

/// A coordinate and its derivatives at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Position (rad or m).
    pub position: f64,
    /// Velocity (rad/s or m/s).
    pub velocity: f64,
    /// Acceleration (rad/s² or m/s²).
    pub acceleration: f64,
    /// Jerk (rad/s³ or m/s³).
    pub jerk: f64,
}

/// A time law.
pub trait Profile {
    /// Seconds from the start to the end.
    fn duration(&self) -> f64;

    /// The coordinate at `t` seconds; before the start and after the end, as it is there.
    fn at(&self, t: f64) -> Sample;
}
