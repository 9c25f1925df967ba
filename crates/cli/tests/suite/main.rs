//! Tests of the command line, one program.

mod bounded;
mod calibrate;
mod certificate;
mod check;
mod class;
mod command_line;
mod common;
mod data_sets;
mod doors;
mod dynamics;
mod dynamics_said;
mod exercise;
mod generate;
mod identify;
mod ik;
mod languages;
mod linkages;
#[cfg(feature = "parquet")]
mod map;
mod motion;
mod parallel;
mod recordings;
mod stream;
mod trees;
mod view;
