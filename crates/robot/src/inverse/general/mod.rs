//! Six joints without a closed form: all solutions by elimination, and what happens at singular poses.

mod arm;
mod confirm;
mod solve;

pub use arm::SixAxes;
pub use arm::Unsuited;
pub use solve::GeneralSolver;
