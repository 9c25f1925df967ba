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
pub use chain::{Axis, Chain, Difference, Element, End, MAX_AXES, Motion, Unsuitable, settled};
pub use compile::{Compiled, Inputs, index, outermost, split};
pub(super) use conditions::NumericCondition;
pub use conditions::{Condition, Task};
pub use equations::{Entry, Goal, Source, Split, equations};
pub use known::{Known, Samples, Unknown, axis_unknown};
pub use model::{InverseModel, NotGiven, Options, Refusal, Stuck, Variant};
pub use plan::{Cost, Determinant, Elimination, Form, Norm, Origin, Row, Step};
