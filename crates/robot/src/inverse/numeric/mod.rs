//! Inverse kinematics by descent: for arms that no closed form and no elimination serves, for parts of poses, for
//! several frames at once, and for wishes beside what must be.
//!
//! - [`Task`]: a frame that is to be somewhere, wholly or in part; [`Preference`]: how to use what tasks leave free.
//! - [`NumericSolver`]: damped Gauss–Newton steps within limits, from starts in a fixed order ([`NumericSolver::solve`]).
//! - [`Outcome`]: a solution or the nearest configuration, and whether the target is out of reach.
//!
//! Residuals are rotation vectors in radians and displacements by the arm's size; all vectors are given in the base.
//! Nothing is random: the same call gives the same bits, whatever was asked before and on how many threads.

mod descent;
mod freedom;
mod limits;
mod linear;
mod motion;
mod outcome;
mod polish;
mod reach;
mod solver;
mod step;
mod task;

pub(in crate::inverse) use linear::{add_product, solve6};
pub use outcome::{NumericOptions, Outcome, Status};
pub use solver::NumericSolver;
pub use task::{Axes, Frame, Level, Preference, Residual, Task, TaskKind};
