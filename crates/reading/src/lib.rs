//! Formulas and programs as people print them.
//!
//! - [`document`]: the statements of a document, by its text alone: Markdown, LaTeX, TOML, plain text.
//! - [`typst`]: a document of Typst as one of Markdown.
//! - [`code`]: straight-line programs in Python and MATLAB, read without running them.
//! - [`slip`]: the slip in a printed formula, and what was probably meant.
//!
//! This crate knows texts and formulas, not what they are about.

pub mod code;
pub mod document;
pub mod slip;
pub mod typst;
