//! The derivation of closed forms, over formulas: from the chain to steps, their conditions and their solver.

mod algebra;
mod candidates;
mod chain;
pub(super) mod compile;
mod conditions;
mod equations;
mod known;
mod model;
mod plan;
mod search;

pub use algebra::{Algebra, Kind, MOST_WORK};
pub(super) use chain::settled;
pub use chain::{Axis, Chain, Difference, Element, End, Motion, Unsuitable};
pub use compile::{Compiled, Inputs};
pub(super) use conditions::NumericCondition;
pub use conditions::{Condition, Task};
pub(super) use equations::equations;
pub use equations::{Entry, Goal, Source, Split};
pub use known::Unknown;
pub(super) use known::{Known, Samples, axis_unknown};
pub use model::{InverseModel, Options, Refusal, Stuck, Variant, branch_words};
pub use plan::{Cost, Determinant, Elimination, Form, Norm, Origin, Row, Step};
