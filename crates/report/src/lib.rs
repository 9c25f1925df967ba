//! Documents about a robot: what `denavit` derives, as a document that one would hand in.
//!
//! [`report`] makes a [`Document`], a tree that knows no format ([`document`]); [`explain`] the derivations in it; all words
//! are those of [`words`]. [`render`] writes it as Typst, LaTeX, Markdown and HTML. [`figure`] draws the arm. [`exercise`] makes sheets of tasks with
//! their solutions. Nothing
//! here opens a file; nothing computes what the robot crate should.

mod cell;
mod derivation;
pub mod document;
mod exercise;
pub mod explain;
mod explained;
pub mod figure;
mod product;
pub mod render;
mod sections;
mod tree;
pub mod typeset;
pub mod words;

pub use cell::{cell, decimals};
pub use derivation::Derivation;
pub use document::{Document, Figure, Part, Section, Table};
pub use exercise::{
    ArmOptions, Difficulty, Exercise, ExerciseOptions, MAX_COUNT, NoExercise, exercise, exercise_of_arm,
    moodle, notebook, prairielearn,
};
pub use sections::{Errata, Level, ReportOptions, Topic, compared, report, reports};
pub use words::ExerciseKind;
