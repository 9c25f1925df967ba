//! Straight-line programs: one compiled form for every formula.
//!
//! - [`Graph`]: where formulas are traced into shared, value-numbered nodes.
//! - [`Program`]: the nodes that chosen outputs need, in order, with names for the shared ones.
//! - [`Count`]: what a program costs.
//!
//! This crate knows formulas, not where they come from.

mod code;
mod compose;
mod derivative;
mod domain;
mod evaluate;
mod graph;
pub mod kernel;
mod pairs;
mod program;
mod rebuild;
mod shorten;
pub mod solver;
mod text;

pub use code::{Code, Instruction, NONE, Opcode};
pub use compose::Composer;
pub use domain::{Dependency, Domain, Extended, Interval, Residue};
pub use evaluate::{Arithmetic, Batch, Block, Function, Isa, MissingValue, Real, Scalar, values};
pub use graph::{COUNTING_RULE, Count, Graph, Op, Stage, Value, Walk};
pub use pairs::{PairReason, PairRefusal};
pub use program::{Program, Step};
pub use text::TextError;
