//! `generate`, and what of the tool an inverse function meets.

use super::RobotArguments;
use clap::{Args, ValueEnum};
use denavit::dynamics::Masses;
use denavit::inverse::Goal;
use denavit_emit::Language;
use std::path::PathBuf;

/// `generate`
#[derive(Args, Clone)]
pub struct GenerateArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The language
    #[arg(long, short, value_enum)]
    pub language: LanguageName,
    /// Functions, separated by commas: fk (pose of the tool), frames (all link frames), jacobian (of the tool),
    /// jacobian_fk (both in one pass; comes with `fk,jacobian`), ik (all joint variables for a pose; but for CUDA, ikfast
    /// and --float also ik_nearest and ik_all_within_limits); torque (inverse dynamics), inertia, bias, gravity,
    /// acceleration (direct dynamics), energy, torque_derivatives, acceleration_derivatives; torque_with_derivatives,
    /// acceleration_with_derivatives (both in one pass). Without it fk and, where there is one, ik; what is named is there,
    /// or nothing is written
    #[arg(long, short, value_name = "NAMES")]
    pub functions: Option<String>,
    /// For ik: joint variables to be given beside the pose, as in `--given q3` (names or numbers, separated by commas);
    /// an arm with too many joints has some chosen otherwise
    #[arg(long, value_name = "JOINTS")]
    pub given: Option<String>,
    /// For ik: what of the tool is to be met
    #[arg(long, value_enum, default_value_t = GoalName::Pose)]
    pub goal: GoalName,
    /// For dynamic functions: which numbers of the links they take as parameters. Without it none if the robot has masses, and
    /// those of its links otherwise
    #[arg(long, value_enum)]
    pub masses: Option<MassesName>,
    /// The SRDF that names the chain, with --group: a planning group of MoveIt's
    #[arg(long, value_name = "FILE", requires = "group", conflicts_with_all = ["base", "tip", "whole"])]
    pub srdf: Option<String>,
    /// The group of the SRDF
    #[arg(long, value_name = "NAME", requires = "srdf")]
    pub group: Option<String>,
    /// Dynamic functions of all joints of a tree of bodies (a URDF, an MJCF or a tree of rows), q1, q2, … in their order, and not of
    /// one chain through it: the root stands still
    #[arg(long, conflicts_with_all = ["given", "wrench", "payload", "base", "tip"])]
    pub whole: bool,
    /// For dynamic functions: take a wrench that the tool exerts (the force FX, FY, FZ and the moment CX, CY, CZ, along the axes of
    /// the base), behind the other variables
    #[arg(long)]
    pub wrench: bool,
    /// For dynamic functions: take what the tool carries as parameters, XXL … ML about the tool's origin
    #[arg(long)]
    pub payload: bool,
    /// The folder to write to
    #[arg(long, short, value_name = "DIR")]
    pub output: PathBuf,
    /// The name of files and functions; the robot's if not given
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Write the values of parameters into the code instead of taking them as arguments (IKFast's interface always does)
    #[arg(long)]
    pub fixed: bool,
    /// Single precision (C and CUDA)
    #[arg(long)]
    pub float: bool,
    /// Overwrite files that are there
    #[arg(long)]
    pub force: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// What of the tool is to be met.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum GoalName {
    /// Position and orientation
    Pose,
    /// The position alone
    Position,
    /// The position and the direction of the z axis
    PositionAxis,
}

impl From<GoalName> for Goal {
    fn from(name: GoalName) -> Self {
        match name {
            GoalName::Pose => Goal::Pose,
            GoalName::Position => Goal::Position,
            GoalName::PositionAxis => Goal::PositionAndAxis,
        }
    }
}

/// Which numbers of the links are parameters.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MassesName {
    /// None: the robot's own stand in the code
    Numbers,
    /// Ten a link, XX1 … M1, about the origin of its frame
    Links,
    /// Base parameters
    Base,
}

impl From<MassesName> for Masses {
    fn from(name: MassesName) -> Self {
        match name {
            MassesName::Numbers => Masses::Numbers,
            MassesName::Links => Masses::Links,
            MassesName::Base => Masses::Base,
        }
    }
}

/// Languages by name.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LanguageName {
    /// A crate without standard library
    Rust,
    /// C99 that compiles as C++ too
    C,
    /// NumPy
    Python,
    /// MATLAB and Octave
    #[value(alias = "octave")]
    Matlab,
    /// An ES module
    #[value(alias = "js")]
    Javascript,
    /// CUDA C++
    Cuda,
    /// A C++ file with IKFast's interface (ComputeIk, ComputeFk), for MoveIt, OpenRAVE, Tesseract
    Ikfast,
    /// A ROS 2 package with plug-ins for MoveIt 2 and ros2_control, of a chain of a URDF
    Ros2,
}

impl From<LanguageName> for Language {
    fn from(name: LanguageName) -> Self {
        match name {
            LanguageName::Rust => Language::Rust,
            // The package has the functions in C.
            LanguageName::C | LanguageName::Ros2 => Language::C,
            LanguageName::Python => Language::Python,
            LanguageName::Matlab => Language::Matlab,
            LanguageName::Javascript => Language::JavaScript,
            LanguageName::Cuda => Language::Cuda,
            LanguageName::Ikfast => Language::IkFast,
        }
    }
}
