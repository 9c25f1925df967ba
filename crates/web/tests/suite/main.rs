//! Tests of the engine of the page, one program.

mod requests;
