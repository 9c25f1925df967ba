//! Derivations as documents: a tree of headings, paragraphs and formulas that knows no notation.
//!
//! [`text`] is the tree for a terminal, [`math()`] a formula in any style, [`laid`] one in lines that fit a
//! page, [`Language`] that of the words.

mod document;
mod language;
mod lines;
mod math;
mod quantity;
mod terms;
mod text;

pub use denavit_symbolic::print::BrokenLine;
pub use document::{Block, Branch, Factor, Line, Math, Piece, Proof, Sign};
pub use language::{Language, Words};
pub use lines::{Laid, aligned, laid, matrix_width};
pub use math::math;
pub use quantity::{decimals, rate, reading};
pub use terms::{count, refusal};
pub use text::{Mark, plain, text};
