//! Tests of the engine of the page, one program.

mod ask;
mod requests;
mod tree;
