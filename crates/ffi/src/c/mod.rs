//! What C sees: `cargo xtask c --write` makes the header of these files and `types.rs`, in their order in `xtask/src/c/header.rs`.

mod answer;
mod dynamics;
mod error;
mod kinematics;
mod objects;
mod robot;
mod solver;
