//! Exact expressions in lengths, angles, and the sines and cosines of angle sums.
//!
//! - [`Expr`]: a handle into a hash-consed graph, written with `+ − × ÷`, powers, roots, sines and arctangents.
//! - [`equal`]: decides whether two formulas are the same function, exactly.
//! - [`Ring`]: the canonical form behind it; [`readable`]: the form that a person would write.
//! - [`factor`]: a formula as a product, and where a factor is 0.
//! - [`real`]: constants to compute a geometry with, exact or to 60 digits.
//! - [`scoped`]: a store of expressions for one piece of work, dropped behind it.
//!
//! This crate knows formulas, not where they come from.

pub mod ball;
mod divisor;
pub mod equality;
pub mod expr;
pub mod factor;
pub mod greek;
pub mod parse;
pub mod poly;
pub mod print;
pub mod rational;
pub mod readable;
pub mod real;
pub mod ring;
pub mod rules;
pub mod vocabulary;

pub use equality::{Equality, equal};
pub use expr::{Angle, Expr, Node, Symbol, scoped, store_size};
pub use greek::name as greek_name;
pub use rational::Rational;
pub use ring::{Refusal, Ring};
