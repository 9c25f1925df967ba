//! Following a path of the hand with the joints: one branch, without jumps, and what stands in the way.
//!
//! Between two samples the joints go on a cubic with the positions and derivatives of both (Hermite), so that the path is
//! smooth; samples are set where the hand would otherwise leave its path by more than is allowed. A configuration is
//! continued by its own direction, not to the nearest solution: so it passes straight through a singular one where that
//! is possible.

mod between;
mod clearance;
mod events;
mod jump;
mod track;

pub use between::HermitePath;
pub use clearance::Clearance;
pub use events::{Event, EventKind};
pub use jump::{Cause, Jump};
pub use track::{Alternative, FollowOptions, Followed, Follower};
