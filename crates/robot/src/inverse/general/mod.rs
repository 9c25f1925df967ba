//! Six joints without a closed form: all solutions by elimination, and what happens at singular poses.
//!
//! Of six axes by the crate `denavit-elimination`; of more, where one joint drives all but five of them, by `geared`. What
//! couples axes otherwise (three of them by two joints) is left to descents.

mod arm;
mod circle;
mod confirm;
mod geared;
mod ring;
mod solve;

pub use arm::SixAxes;
pub use arm::Unsuited;
pub use solve::GeneralSolver;
