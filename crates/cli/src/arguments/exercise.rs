//! The arguments of `exercise`.

use super::{ReportLanguage, RobotArguments};
use clap::{Args, ValueEnum};
use denavit_report::ExerciseKind;
use std::path::PathBuf;

/// `exercise`
///
/// The same seed makes the same sheet. Numbers are round, within the limits, and regular; lengths without values get some. What
/// stands in a solution is proved, and `denavit check` finds it so.
#[derive(Args)]
pub struct ExerciseArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// What it is about
    #[arg(long, value_enum)]
    pub kind: KindName,
    /// Which sheet of its kind
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
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
    /// The file; its ending says the format: .md, .tex, .typ or .json. Of Markdown the drawing is written beside it
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write a folder with everything: exercise.md, solution.md, robot.toml and task.toml, by which `denavit check DIR/task.toml
    /// ANSWERS…` marks
    #[arg(long, value_name = "DIR", conflicts_with_all = ["output", "solution", "format"])]
    pub task: Option<PathBuf>,
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
}

impl From<KindName> for ExerciseKind {
    fn from(name: KindName) -> Self {
        match name {
            KindName::Fk => ExerciseKind::Forward,
            KindName::Dh => ExerciseKind::Table,
            KindName::Ik => ExerciseKind::Inverse,
            KindName::Jacobian => ExerciseKind::Jacobian,
            KindName::Singularities => ExerciseKind::Singularities,
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
}
