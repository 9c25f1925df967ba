//! Tests of the JSON of all doors, one program.

mod answers;
mod parallel;
mod shapes;
