//! Numbers from closed forms: every branch, and the families where a branch leaves an unknown open.

mod confirm;
mod families;
mod solve;

pub use solve::{InverseSolver, variables};
