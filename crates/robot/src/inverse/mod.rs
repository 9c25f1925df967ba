//! Closed-form inverse kinematics: derived, explained, compiled.
//!
//! The chain is brought into a normal form ([`Chain`]); all its scalar equations are formed; a search takes the cheapest
//! equation that holds one unknown until nothing is unknown ([`InverseModel::derive`]); the steps become a
//! [`Solver`](denavit_program::solver::Solver), which finds every branch.

mod algebra;
mod candidates;
mod chain;
mod compile;
mod conditions;
mod equations;
pub mod explain;
mod families;
mod known;
mod model;
mod newton;
mod plan;
mod search;
mod solve;

pub use algebra::{Algebra, Kind};
pub use chain::{Axis, Chain, Difference, Element, End, Motion, Unsuitable};
pub use compile::{Compiled, Inputs};
pub use conditions::{Condition, Task};
pub use equations::{Entry, Goal, Source, Split};
pub use known::Unknown;
pub use model::{InverseModel, Options, Refusal, Stuck, Variant};
pub use plan::{Cost, Determinant, Elimination, Form, Norm, Origin, Row, Step};
pub use solve::{Answer, Family, InverseSolver, Obstacle, Solution, variables};
