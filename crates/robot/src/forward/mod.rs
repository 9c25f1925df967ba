//! Forward kinematics as formulas: link transforms, the simplified model, and the shortest algorithm for it.

mod algorithm;
mod chain;
mod frames;
mod model;

pub use crate::mechanism::Reference;
pub use algorithm::{Outputs, Proof, UnknownPart, entry_name};
pub use chain::Chain;
pub use frames::{frames_program, pose_program};
pub use model::{ForwardModel, link_transforms, prove, symbol_order};
