//! Tests of the engine of the page, one program.

mod ask;
mod recorded;
mod requests;
mod tree;
