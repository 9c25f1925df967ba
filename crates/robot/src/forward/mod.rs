//! Forward kinematics as formulas: link transforms, the simplified model, and the shortest algorithm for it.

mod algorithm;
mod chain;
mod model;

pub use algorithm::{Outputs, Proof};
pub use chain::Chain;
pub use model::{ForwardModel, Reference, link_transforms, symbol_order};
