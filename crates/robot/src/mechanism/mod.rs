//! The arm as a mechanism.
//!
//! - [`robot`]: the chain to compute with, over numbers or formulas.
//! - [`axes`]: its normal form, the moving axes with the constants between them.
//! - [`compare`]: how far one description is another, [`compare_chains`]: how far one tree is.
//! - [`walk`]: one pass along it: where frames and axes are, and how the joints move them.

pub mod axes;
mod chains;
mod compared;
pub(crate) mod elements;
mod extent;
mod merged;
pub mod robot;
pub mod walk;

pub use axes::{Lengths, MovingAxes, MovingAxis};
pub use chains::{Chains, Tree, compare_chains};
pub use compared::{COMPARED, Comparison, compare};
pub use robot::{Affine, Link, MissingValue, Robot};
pub use walk::{Line, Mover, Reference, Twist, Walk};
