//! The arguments of `map`.

use super::RobotArguments;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `map`
///
/// Reads .parquet, .arrow (.feather), .csv, .tsv and .npz, part by part on several threads, in constant memory, and writes one of
/// these: the columns that are there, and behind them what is computed of each row. Inputs are found by name: joint variables in
/// columns `q1` … or as the robot's file names them, or in one column of lists, `q`; velocities `qd`, accelerations `qdd`; poses in
/// `x`, `y`, `z` and columns of the orientation. A row in which an input is null or no finite number has nulls, and is counted. The
/// result takes its name when all of it is there. See docs/batch.md.
#[derive(Args)]
pub struct MapArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The file that is read: .parquet, .arrow (.feather), .csv, .tsv or .npz
    #[arg(value_name = "FILE")]
    pub input: PathBuf,
    /// The file that is written, of one of these kinds by its ending: columns that are there, and behind them what is computed
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// What is computed of each row.
    #[command(flatten)]
    pub wanted: Wanted,
    /// Which columns hold what.
    #[command(flatten)]
    pub columns: Columns,
    /// How files are read and written.
    #[command(flatten)]
    pub files: Files,
    /// Print what was done as JSON
    #[arg(long)]
    pub json: bool,
}

/// What is computed.
#[derive(Args)]
#[command(next_help_heading = "What is computed")]
pub struct Wanted {
    /// The pose of the tool, or of --frame: `x`, `y`, `z` and its orientation
    #[arg(long)]
    pub fk: bool,
    /// The Jacobian of the tool, or of --frame, along the axes of the base: `vx_q1` … `wz_qn`, in metres and radians
    #[arg(long)]
    pub jacobian: bool,
    /// The tool's manipulability and condition, lengths by the arm's size, as `jacobian` prints them
    #[arg(long)]
    pub manipulability: bool,
    /// Torques for velocities and accelerations: `tau_q1` …, N m and N
    #[arg(long)]
    pub torque: bool,
    /// All joints for a pose, as one list a row, `ik`, with `ik_count`, `ik_families`, `ik_complete` and `ik_status`
    #[arg(long, conflicts_with = "nearest")]
    pub ik: bool,
    /// The joints for a pose that are nearest to those of --near: `ik_q1` …
    #[arg(long)]
    pub nearest: bool,
    /// With --ik: solutions in so many places of their own, `ik1_q1` …, instead of a list (CSV and NPZ: 8)
    #[arg(long, value_name = "N", requires = "ik", value_parser = clap::value_parser!(u16).range(1..=64))]
    pub slots: Option<u16>,
    /// With --ik or --nearest: only what the joint limits allow
    #[arg(long)]
    pub limits: bool,
    /// Frames of --fk and --jacobian: numbers or names, with commas
    #[arg(long, value_name = "N,NAME")]
    pub frame: Option<String>,
    /// How orientations are written and read: matrix, quaternion, rotation-vector, axis-angle, rpy, or an Euler set such as zyz
    #[arg(long, value_name = "SET", default_value = "matrix")]
    pub orientation: String,
}

/// Which columns hold what.
#[derive(Args)]
#[command(next_help_heading = "Columns")]
pub struct Columns {
    /// The joint variables: names with commas, `first..last`, or one column of lists (`q1` … or the names of the robot's file, or `q`)
    #[arg(long, value_name = "COLUMNS")]
    pub joints: Option<String>,
    /// Their velocities (`qd1` …, or `qd`)
    #[arg(long, value_name = "COLUMNS")]
    pub velocities: Option<String>,
    /// Their accelerations (`qdd1` …, or `qdd`)
    #[arg(long, value_name = "COLUMNS")]
    pub accelerations: Option<String>,
    /// The position of a pose (`x`, `y`, `z`)
    #[arg(long, value_name = "COLUMNS")]
    pub position: Option<String>,
    /// The orientation of a pose (`r11` …, `qx` …, `rx` … as --orientation says)
    #[arg(long, value_name = "COLUMNS")]
    pub rotation: Option<String>,
    /// The joints to which a solution is to be near (those of --joints)
    #[arg(long, value_name = "COLUMNS")]
    pub near: Option<String>,
    /// Units of columns that do not say theirs, and of those that are written: rad or deg, m or mm, as in `deg,mm`
    #[arg(long, value_name = "UNITS", default_value = "rad,m")]
    pub units: String,
    /// Columns that go through, with commas, or `none` (all)
    #[arg(long, value_name = "COLUMNS")]
    pub keep: Option<String>,
    /// What stands in front of the names of columns that are computed
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub prefix: String,
}

/// How files are read and written.
#[derive(Args)]
#[command(next_help_heading = "Files")]
pub struct Files {
    /// Refuse a file in which this column, the time, goes back
    #[arg(long, value_name = "COLUMN")]
    pub ordered: Option<String>,
    /// Refuse a file with rows that have no result, with the first of them
    #[arg(long)]
    pub strict: bool,
    /// Keep parts in a folder beside the result until all are there, and go on with those that are (Parquet to Parquet)
    #[arg(long)]
    pub resume: bool,
    /// How many threads work (as many as there are cores, up to 8)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// How Parquet is packed
    #[arg(long, value_enum, default_value_t = CompressionName::Snappy)]
    pub compression: CompressionName,
}

/// How Parquet is packed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CompressionName {
    /// Quick
    Snappy,
    /// Small
    Gzip,
    /// Not at all
    None,
}
