//! The arguments of `convert`.

use super::{ConventionName, RobotArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `convert`
///
/// What of the robot has no place in the format is said. What is written is read back and held against the robot: proved the same, or the difference of the poses is said. Exit code 1 if
/// it is another robot: if poses differ by more than doubles round by.
#[derive(Args)]
pub struct ConvertArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Into what
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub to: ConvertFormat,
    /// The convention of what is written; that of the robot otherwise
    #[arg(long = "as", value_enum)]
    pub written_as: Option<ConventionName>,
    /// All of a tree: as bodies and joints (urdf, mjcf), or as one table with a column a(j) for the row that each stands on (markdown,
    /// latex, csv); par and tree write all of it anyway
    #[arg(long, conflicts_with_all = ["base", "tip"])]
    pub whole: bool,
    /// Print JSON: the text, what is left out, and how it is the robot
    #[arg(long)]
    pub json: bool,
    /// Where to write it (- for standard output)
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
}

/// What `convert` writes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ConvertFormat {
    /// A robot file
    Toml,
    /// A URDF: joints in their places, simple solids
    Urdf,
    /// A model of MuJoCo's: joints in their places, simple solids
    Mjcf,
    /// A robot file with the axes at rest: a point and a direction each, and the tip
    Axes,
    /// A robot file with the product of exponentials: screws (ω, v) in the base, and M
    Poe,
    /// The same with the screws in the tip
    BodyPoe,
    /// A .par file of SYMORO: rows in Khalil's notation, all of a tree if no --tip is named
    Par,
    /// A robot file with the rows of a whole tree in Khalil's notation
    Tree,
    /// The table for Markdown, base and tool as rows
    Markdown,
    /// The table for LaTeX
    Latex,
    /// The table as fields between commas
    Csv,
}
