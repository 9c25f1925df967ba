//! Tests of readers, one program.

mod document;
mod slip;
