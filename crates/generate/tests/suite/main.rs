//! Tests of generated packages, one program.

mod attack;
mod certificate;
mod conformance;
mod general;
mod general_javascript;
mod ikfast;
mod library;
mod packages;
mod ros2;
mod stack;

#[path = "../../../robot/tests/suite/common/mod.rs"]
mod common;
