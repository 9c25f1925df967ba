//! The arguments of `identify`.

use super::RobotArguments;
use super::path::positive;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `identify`
///
/// A recording has a time, joint variables and torques, and may have velocities and accelerations. Columns are known by their names and
/// units, as in `t, q1 [deg], …, tau1 [N m], …`, or told. Exit codes: 0 done, 1 the recording is suspect: a sign, a unit, a gravity that no
/// arm has, 3 it cannot be read. With --excite a motion is searched that shows the parameters, and no recording is read.
#[derive(Args)]
pub struct IdentifyArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The recordings (.csv, .tsv, .jsonl, .npy, .npz, .parquet, the folder of a data set of LeRobot); several are taken together
    #[arg(value_name = "DATA", required_unless_present = "excite", conflicts_with = "excite")]
    pub data: Vec<PathBuf>,
    /// The column of the time
    #[arg(long, value_name = "COLUMN", conflicts_with = "excite")]
    pub time: Option<String>,
    /// Rows a second: no column is taken for the time
    #[arg(long, value_name = "HZ", value_parser = positive, conflicts_with_all = ["time", "excite"])]
    pub rate: Option<f64>,
    /// The columns of the joints: names with commas, or `first..last`
    #[arg(long, value_name = "COLUMNS", conflicts_with = "excite")]
    pub joints: Option<String>,
    /// The columns of the velocities; `none`: from the positions
    #[arg(long, value_name = "COLUMNS", conflicts_with = "excite")]
    pub velocities: Option<String>,
    /// The columns of the accelerations; `none`: from the velocities or positions
    #[arg(long, value_name = "COLUMNS", conflicts_with = "excite")]
    pub accelerations: Option<String>,
    /// The columns of the torques, or of the currents with --gains
    #[arg(long, value_name = "COLUMNS", conflicts_with = "excite")]
    pub torques: Option<String>,
    /// What the columns of torques are multiplied with, as torque by current: one for all or one each
    #[arg(long, value_name = "GAINS", allow_hyphen_values = true, conflicts_with = "excite")]
    pub gains: Option<String>,
    /// Joints whose columns do not say their unit are in degrees
    #[arg(long, conflicts_with = "excite")]
    pub degrees: bool,
    /// The frequency of the filter of the positions, Hz, or `none`; where motion and noise meet, twice that, otherwise
    #[arg(long, value_name = "HZ|none", conflicts_with = "excite")]
    pub cutoff: Option<String>,
    /// The acceleration of gravity in the base, as in `dynamics`
    #[arg(long, value_name = "DIRECTION", allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// What of the joints is sought: some of viscous, coulomb, offset, with commas, or none
    #[arg(long, value_name = "PARTS", default_value = "viscous,coulomb,offset")]
    pub friction: String,
    /// All joints of a tree of bodies (a URDF, an MJCF or a tree of rows) at once, the root at rest; without -o
    #[arg(long, conflicts_with_all = ["excite", "output", "base", "tip"])]
    pub whole: bool,
    /// Inertias of rotors, too; as far as torques tell them from the links'
    #[arg(long)]
    pub rotors: bool,
    /// Rows that are far off count less (Huber)
    #[arg(long, conflicts_with = "excite")]
    pub robust: bool,
    /// Leave out parameters that are not told from 0, by an F-test at 5 %
    #[arg(long, conflicts_with = "excite")]
    pub reduce: bool,
    /// What masses are to be near to where torques do not tell: those of the robot's file, or even links
    #[arg(long, value_enum, conflicts_with = "excite")]
    pub prior: Option<PriorName>,
    /// Write the robot with masses that can be and have these torques (TOML); with --excite the motion (CSV)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Search a motion that shows the parameters: a Fourier series within limits, from rest to rest
    #[arg(long, help_heading = "Excitation")]
    pub excite: bool,
    /// Seconds of the motion
    #[arg(long, value_name = "SECONDS", value_parser = positive, requires = "excite", default_value_t = 10.0, help_heading = "Excitation")]
    pub duration: f64,
    /// Harmonics of the series, 3 to 50
    #[arg(long, value_name = "N", requires = "excite", default_value_t = 5, value_parser = clap::value_parser!(u8).range(3..=50), help_heading = "Excitation")]
    pub harmonics: u8,
    /// Seconds between the rows that are written
    #[arg(long, value_name = "SECONDS", value_parser = positive, requires = "excite", default_value_t = 0.01, help_heading = "Excitation")]
    pub dt: f64,
    /// Where the random numbers begin: the same seed gives the same motion
    #[arg(long, value_name = "N", requires = "excite", default_value_t = 1, help_heading = "Excitation")]
    pub seed: u64,
    /// How many motions are tried
    #[arg(long, value_name = "N", requires = "excite", default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=10_000_000), help_heading = "Excitation")]
    pub trials: u32,
    /// What is to be best
    #[arg(long, value_enum, requires = "excite", default_value_t = CriterionOf::Determinant, help_heading = "Excitation")]
    pub criterion: CriterionOf,
    /// Where the joints may be, as in `-90deg..90deg`: one for all or one each (else the robot file's)
    #[arg(
        long,
        value_name = "RANGES",
        requires = "excite",
        allow_hyphen_values = true,
        help_heading = "Excitation"
    )]
    pub range: Option<String>,
    /// Largest joint velocities, as in `path` (else the robot file's)
    #[arg(long, value_name = "LIMITS", requires = "excite", help_heading = "Excitation")]
    pub velocity: Option<String>,
    /// Largest joint accelerations, as in `path` (else the robot file's)
    #[arg(long, value_name = "LIMITS", requires = "excite", help_heading = "Excitation")]
    pub acceleration: Option<String>,
    /// Largest torques of a robot with masses, as in `path`
    #[arg(long, value_name = "LIMITS", requires = "excite", help_heading = "Excitation")]
    pub torque: Option<String>,
}

/// What masses are near to.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PriorName {
    /// The masses of the robot's file
    File,
    /// Links of even mass between their joints
    Neutral,
}

/// What is to be best.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CriterionOf {
    /// The determinant of WᵀW is to be large
    Determinant,
    /// The condition number of W is to be small
    Condition,
}
