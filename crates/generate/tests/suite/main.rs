//! Tests of generated packages, one program.

mod general;
mod library;

#[path = "../../../robot/tests/suite/common/mod.rs"]
mod common;
