//! Motions of all joints: time laws, paths through way-points, and the timing of paths under limits.
//!
//! - [`profile`]: time laws of one coordinate: cubic, quintic, trapezoidal, jerk-limited; and several joints that
//!   arrive together ([`profile::synchronised`]).
//! - [`path`]: geometric paths q(s) through way-points: splines, straight lines with blends ([`JointPath`]).
//! - [`timing`]: the fastest timing of a path under velocity, acceleration and torque limits ([`TimeOptimal`]).
//! - [`jerk_limited`]: a fast timing of a path under velocity, acceleration, jerk and torque limits ([`JerkLimited`]).
//! - [`hand`]: paths of the hand: lines, arcs, splines.
//! - [`follow`]: the joints along a path of the hand, and what stands in the way.
//! - [`plan`]: from a wish to a timed motion, by all of these.
//! - [`move_within_limits`]: the fastest motion from a state to a state under all three, with no path given.
//!
//! Joint positions are radians (metres for a prismatic joint), times seconds. Every motion is a [`Trajectory`].

mod error;
pub mod follow;
pub mod hand;
mod in_time;
pub mod jerk_limited;
mod limits;
pub mod path;
pub mod plan;
pub mod profile;
mod state_to_state;
pub mod timing;
mod trajectory;

pub use error::{End, Failure, MotionError, StateError};
pub use in_time::{InTime, Slowed};
pub use jerk_limited::JerkLimited;
pub use limits::{Limits, Range};
pub use path::JointPath;
pub use state_to_state::move_within_limits;
pub use timing::{TimeOptimal, TimedPath, TorqueLimits};
pub use trajectory::{JointState, Trajectory};

/// No more samples or grid points than this are made at once.
pub const MAX_SAMPLES: usize = 10_000_000;
