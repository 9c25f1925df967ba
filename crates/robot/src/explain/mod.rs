//! Derivations as documents: a tree of headings, paragraphs and formulas that knows no notation.
//!
//! [`text`] is the tree for a terminal, [`math()`] a formula in any style.

mod document;
mod math;
mod text;

pub use document::{Block, Branch, Factor, Line, Math, Piece, Proof, Sign};
pub use math::math;
pub use text::{Mark, text};
