//! Tests of the crate's public face.

mod columns;
mod common;
mod files;
mod formats;
mod resume;
