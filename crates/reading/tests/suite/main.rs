//! Tests of readers, one program.

mod code;
mod document;
mod slip;
mod typst;
