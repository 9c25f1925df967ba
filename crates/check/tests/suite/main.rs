//! Tests of verdicts, one program.

mod documents;
mod hostile;
mod inverse;
mod mutations;
mod statements;

#[path = "../../../robot/tests/suite/common/mod.rs"]
mod common;
