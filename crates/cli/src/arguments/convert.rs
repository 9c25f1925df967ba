//! The arguments of `convert`.

use super::{ConventionName, RobotArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `convert`
///
/// What is written is read back and held against the robot: proved the same, or the difference of the poses is said.
#[derive(Args)]
pub struct ConvertArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Into what
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub to: ConvertFormat,
    /// The convention of a robot file's table; that of the robot otherwise
    #[arg(long = "as", value_enum)]
    pub written_as: Option<ConventionName>,
    /// Where to write it (- for standard output)
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub output: PathBuf,
}

/// What `convert` writes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ConvertFormat {
    /// A robot file
    Toml,
    /// A URDF: joints in their places, no looks
    Urdf,
}
