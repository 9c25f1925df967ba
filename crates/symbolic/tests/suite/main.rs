//! Tests of formulas, one program.

mod canonical;
mod factor;
mod parse;
mod print;
mod syntax;
