//! Options of `calibrate`.

use super::{PoseColumns, RobotArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// `calibrate`
///
/// With measurements: estimates the errors of the geometry with their deviations, says what these rows do not show, and writes
/// the arm with `-o`. With --choose: the poses to measure at. With neither: what the measurement can show of this arm at all.
/// A recording that has a slip (a sign, an order, degrees for radians) is refused: `denavit check` finds it, and --fix or
/// --recipe undoes it; so is one in which the hand is far off in some rows, without --robust. What is found and does not matter
/// is said: frames, zeros and lengths that are off, jumps of the pose, times that stand still, gains with --gains. Exit codes: 0 done, 1 rows do not show all that such measurements can, 3 it cannot be read or has a slip.
#[derive(Args)]
pub struct CalibrateArguments {
    /// The robot as it is written down
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The measurements, with columns of joints (.csv, .tsv, .jsonl, .npy, .npz, .parquet, the folder of a data set of LeRobot)
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// What is measured
    #[arg(long, value_enum, default_value_t = MeasureName::Pose)]
    pub measure: MeasureName,
    /// The point of the tool that is measured, in the tool's frame, as in `--point "20mm, 0, 110mm"` (positions, distances, planes)
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub point: Option<String>,
    /// Joints may move more or less than they say, each by a gain
    #[arg(long)]
    pub gains: bool,
    /// Deviations of the measurement that are known, of an angle, a length or both, as in `--noise "0.1mm, 0.02deg"`; found in the
    /// residuals otherwise, and with --choose those of a good tracker
    #[arg(long, value_name = "NOISE")]
    pub noise: Option<String>,
    /// Some rows may be grossly wrong: Tukey's biweight
    #[arg(long, requires = "file")]
    pub robust: bool,
    /// In how many parts rows are held out to judge by; 0 for none
    #[arg(long, value_name = "N", default_value_t = 5, requires = "file")]
    pub folds: usize,
    /// Choose so many configurations to measure at, within the joints' limits
    #[arg(long, value_name = "N", conflicts_with = "file")]
    pub choose: Option<usize>,
    /// Out of how many at random they are chosen
    #[arg(long, value_name = "N", default_value_t = 300, requires = "choose")]
    pub candidates: usize,
    /// Where the random numbers begin
    #[arg(long, value_name = "N", default_value_t = 1, requires = "choose")]
    pub seed: u64,
    /// Write the calibrated arm: a robot file (.toml), or a URDF (.urdf); with --choose the configurations (.csv)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Which columns are what.
    #[command(flatten)]
    pub columns: PoseColumns,
    /// The column of the distance to a fixed centre; without one the distance is always the same
    #[arg(long, value_name = "COLUMN")]
    pub distance: Option<String>,
    /// The distance that is always the same, if it is known
    #[arg(long, value_name = "LENGTH", conflicts_with = "distance")]
    pub bar: Option<String>,
    /// Distances are all off by one unknown number
    #[arg(long, requires = "distance")]
    pub offset: bool,
    /// The column that tells several planes or centres apart
    #[arg(long, value_name = "COLUMN", requires = "file")]
    pub group: Option<String>,
    /// A recipe of `check --recipe` that makes the columns the robot's
    #[arg(long, value_name = "FILE", requires = "file")]
    pub recipe: Option<PathBuf>,
    /// Take the columns as they are said, without looking for slips
    #[arg(long, conflicts_with = "recipe", requires = "file")]
    pub unchecked: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MeasureName {
    /// Position and orientation
    Pose,
    /// The position of a point of the tool
    Position,
    /// The orientation
    Orientation,
    /// The distance of a point of the tool to a fixed centre, as of a ball bar
    Distance,
    /// That a point of the tool touches a fixed plane
    Plane,
}
