//! Exact expressions in lengths, angles, and the sines and cosines of angle sums.
#![doc = "\n"]
pub mod angle;
pub mod expr;
pub mod rational;

pub use angle::Angle;
pub use expr::{Expr, Node, Symbol};
pub use rational::Rational;
