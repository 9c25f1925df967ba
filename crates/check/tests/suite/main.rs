//! Tests of verdicts, one program.

mod documents;
mod hostile;
mod inverse;
mod marking;
mod mutations;
mod readings;
mod statements;

#[path = "../../../robot/tests/suite/common/mod.rs"]
mod common;
