//! The arguments of `exercise`.

use super::{ReportLanguage, RobotArguments};
use clap::{Args, ValueEnum};
use denavit_report::{Difficulty, ExerciseKind};
use std::path::PathBuf;

/// `exercise`
///
/// The same seed makes the same sheet. Numbers are round, within the limits, and regular; lengths without values get some. What
/// stands in a solution is proved, and `denavit check` finds it so.
#[derive(Args)]
#[command(mut_arg("robot", |robot| robot.required(false)))]
pub struct ExerciseArguments {
    /// The robot; one is made up from the seed where none is named
    #[command(flatten)]
    pub robot: Option<RobotArguments>,
    /// What it is about
    #[arg(long, value_enum)]
    pub kind: KindName,
    /// Which sheet of its kind
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Of an arm that is made up: two joints, three, or three with offsets and more
    #[arg(long, value_enum, default_value = "medium")]
    pub difficulty: DifficultyName,
    /// Make N exercises, a folder each below --task or -o: 01, 02, …; arms that are made up have the same joints and other lengths
    #[arg(long, value_name = "N")]
    pub series: Option<usize>,
    /// Make an exercise for each line of this file but a row of heads, a folder of its name each
    #[arg(long, value_name = "FILE", conflicts_with = "series")]
    pub students: Option<PathBuf>,
    /// How many configurations or poses it has
    #[arg(long, default_value_t = 1)]
    pub count: usize,
    /// The format; that of the ending of -o otherwise, Markdown without it
    #[arg(long, value_enum)]
    pub format: Option<ExerciseFormat>,
    /// Write the solution in place of the tasks (with --format json beside them)
    #[arg(long)]
    pub solution: bool,
    /// The language of the words
    #[arg(long, value_enum, default_value = "en")]
    pub language: ReportLanguage,
    /// The file; its ending says the format: .md, .tex, .typ, .json, .xml (Moodle) or .ipynb (Jupyter). Of Markdown the drawing is written beside it
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write a folder with everything: exercise.md, solution.md, robot.toml and task.toml, by which `denavit check DIR/task.toml
    /// ANSWERS…` marks
    #[arg(long, value_name = "DIR", conflicts_with_all = ["output", "solution", "format"])]
    pub task: Option<PathBuf>,
}

/// How hard an arm is that is made up.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DifficultyName {
    /// Two joints
    Easy,
    /// Three joints
    Medium,
    /// Three joints with offsets, or four to six
    Hard,
}

impl From<DifficultyName> for Difficulty {
    fn from(name: DifficultyName) -> Self {
        match name {
            DifficultyName::Easy => Difficulty::Easy,
            DifficultyName::Medium => Difficulty::Medium,
            DifficultyName::Hard => Difficulty::Hard,
        }
    }
}

/// What an exercise is about.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum KindName {
    /// Link transforms, the pose of the tool as a formula and in numbers
    Fk,
    /// The Denavit-Hartenberg table of a drawing
    Dh,
    /// All configurations for a pose
    Ik,
    /// The Jacobian as a formula and in numbers, a velocity
    Jacobian,
    /// The determinant, and where the arm is singular
    Singularities,
    /// The link transforms alone, as formulas and in numbers
    Transforms,
    /// All configurations for a position of the tool
    Position,
    /// The torques of the joints for a force at the tool
    Statics,
    /// The equations of motion of an arm with up to three joints
    Torques,
    /// The timing of a motion between two configurations: cubic polynomials, trapezoidal profiles
    Path,
}

impl From<KindName> for ExerciseKind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::Fk => ExerciseKind::Forward,
            KindName::Dh => ExerciseKind::Table,
            KindName::Ik => ExerciseKind::Inverse,
            KindName::Jacobian => ExerciseKind::Jacobian,
            KindName::Singularities => ExerciseKind::Singularities,
            KindName::Transforms => ExerciseKind::Transforms,
            KindName::Position => ExerciseKind::Position,
            KindName::Statics => ExerciseKind::Statics,
            KindName::Torques => ExerciseKind::Torques,
            KindName::Path => ExerciseKind::Path,
        }
    }
}

/// The format of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExerciseFormat {
    /// Markdown with LaTeX formulas
    Markdown,
    /// LaTeX for amsmath, amssymb and tikz
    Latex,
    /// Typst markup
    Typst,
    /// JSON with both sheets as Markdown, the robot and the points
    Json,
    /// Moodle XML: gaps for numbers, an essay with its solution for formulas; of a series all in one file
    Moodle,
    /// A folder with a question of PrairieLearn; -o names it
    Prairielearn,
    /// A notebook for Jupyter, the source of an assignment for nbgrader
    Jupyter,
}
