//! Tests of machine code, one program.

mod conformance;
mod solver;

#[path = "../../../program/tests/suite/support/solvers.rs"]
mod solvers;
