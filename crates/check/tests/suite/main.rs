//! Tests of verdicts, one program.

mod allowed;
mod configurations;
mod documents;
mod dynamics;
mod dynamics_meant;
mod functions;
mod given;
mod hostile;
mod inverse;
mod labelled;
mod languages;
mod marking;
mod meant_otherwise;
mod mutations;
mod named;
mod notation;
mod ordinary;
mod programs;
mod readings;
mod scripts;
mod spoken;
mod statements;
mod strangers;
mod tables;
mod tested;
mod told;
mod unheard;
mod unsupported;
mod wild;

#[path = "../../../robot/tests/suite/common/mod.rs"]
mod common;
