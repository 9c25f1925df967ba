//! What C sees: `cargo xtask c --write` makes the header of these files, in their order in `xtask/src/c/header.rs`.

mod answer;
mod dynamics;
mod error;
pub mod kinematics;
mod robot;
mod solver;
pub mod types;
