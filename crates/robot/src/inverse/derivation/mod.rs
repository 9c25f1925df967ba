//! The derivation of closed forms, over formulas: from the chain to steps, their conditions and their solver.

mod algebra;
mod candidates;
mod chain;
pub(super) mod compile;
mod conditions;
mod drivers;
mod equations;
mod forms;
mod inputs;
mod known;
mod model;
mod naming;
mod plan;
mod rounding;
mod screen;
mod screws;
mod search;
mod sign;
mod tangent;
mod terms;

pub use algebra::{Algebra, Kind, MOST_WORK};
pub use chain::{Axis, Difference, Element, End, MAX_AXES, Motion, NormalChain, Unsuitable};
pub use compile::Compiled;
pub(super) use conditions::NumericCondition;
pub use conditions::{Condition, Task};
pub use drivers::{Drivers, Lattice};
pub use equations::{Entry, Equations, Goal, Length, Source, Split, equations};
pub use inputs::Inputs;
pub use known::{Known, Samples, Unknown, axis_unknown};
pub(super) use model::Extent;
pub use model::{InverseModel, InverseOptions, NotGiven, Refusal, Stuck, Variant};
pub use naming::index;
pub use plan::{Cost, Determinant, Elimination, Form, Norm, Origin, Row, Step};
pub use screws::settled;
pub use terms::{outermost, split};
