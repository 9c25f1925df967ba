//! Tests of programs and their evaluators, one program.

mod conformance;
mod derivatives;
mod domains;
mod kernel;
mod pairs;
mod residue;
mod roots;
mod shorten;
mod solver;
mod steps;
mod support;
mod text;
