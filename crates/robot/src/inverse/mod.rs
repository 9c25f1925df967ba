//! Inverse kinematics: the joint variables for a pose of the hand.
//!
//! - [`derivation`]: closed forms. The chain is brought into a normal form
//!   ([`NormalChain`](derivation::NormalChain)); all its scalar equations are formed; a search takes the cheapest
//!   equation that holds one unknown until nothing is unknown ([`InverseModel::derive`]); the steps become a
//!   [`Solver`](denavit_program::solver::Solver).
//! - [`closed`]: numbers from closed forms, [`InverseSolver`].

mod answer;
mod branch;
pub mod closed;
pub mod derivation;
mod dispatch;
pub mod general;
mod lines;
mod members;
pub(crate) mod newton;
pub mod numeric;
pub mod redundant;
mod search;
pub mod self_motion;
mod track;

pub use crate::space::JointSpace;
pub use answer::{Answer, Doubt, Family, Obstacle, Solution};
pub use branch::{Branch, Choice, Label, Part};
pub use closed::{InverseSolver, variables};
pub use derivation::{Goal, InverseModel, InverseOptions, NotGiven, Refusal, Stuck, Task, Unsuitable};
pub use dispatch::{InverseKinematics, Nearest, Unprepared};
pub use members::{MAX_MEMBERS, Members};
pub use numeric::NumericSolver;
pub use redundant::{Component, Criterion, Manifold, NotSolved, RedundantSolver};
pub use self_motion::{CurveEnd, SelfMotion};
pub use track::{Course, Tracked};
