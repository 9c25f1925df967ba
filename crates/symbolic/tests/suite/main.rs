//! Tests of formulas, one program.

mod broken;
mod canonical;
mod equality;
mod factor;
mod parse;
mod print;
mod readable;
mod real;
mod syntax;
