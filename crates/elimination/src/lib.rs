//! All configurations of any six-joint arm at a pose, by elimination.
//!
//! The loop equation of the arm is cut in two (Raghavan and Roth 1990, 1993), two joints are eliminated linearly, and
//! the determinant that remains is a trigonometric polynomial of degree 8 in one joint's angle: its 16 complex roots
//! hold every configuration. It is sampled on the circle, so that no root is at infinity; each real root gives the other
//! joints, and Newton's method on the pose the last digits. Discs around the roots certify that nothing is missing.
//! At poses where this determinant vanishes identically (the last axis parallel to the first, say), a wider matrix serves.
//!
//! What computes in lanes is compiled part by part for each set of instructions ([`Isa`]), inlined there, so that it uses
//! them; not so for WebAssembly, where size counts.
//!
//! In reading order: [`Arm`], [`Plan::new`] (offline), [`Plan::solve`] (online), [`Answer`].

// Matrices: equations with row and column read better than iterators over both.
#![allow(clippy::needless_range_loop)]

mod answer;
mod arm;
mod candidate;
mod certificate;
mod chart;
mod charts;
mod determinant;
mod eigen;
mod eliminate;
mod extract;
mod forms;
mod fourier;
mod instructions;
mod lanes;
mod measure;
mod native;
mod newton;
mod plan;
mod products;
mod remaining;
mod rigid;
mod roots;
mod slides;
mod solve;
pub mod source;
mod split;
mod tables;
mod triple;
mod wide;
mod wide_roots;
mod work;

pub use answer::{Answer, Certificate, Solution};
pub use arm::{Arm, Joint};
pub use native::Isa;
pub use plan::{Plan, Ranking, Unsuitable};
pub use rigid::Rigid;
pub use split::Split;
pub use tables::Tables;
