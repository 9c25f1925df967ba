//! The arguments of `path`.

use super::RobotArguments;
use clap::{Args, ValueEnum};
use denavit::motion::profile::Law;
use std::path::PathBuf;

/// `path`
#[derive(Args)]
pub struct PathArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Where the joints start, as in `fk`
    #[arg(short, long = "joints", value_name = "Q", allow_hyphen_values = true)]
    pub q: Option<String>,
    /// Where the hand starts, a pose as in `ik`; the best of all branches is taken
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, conflicts_with = "q")]
    pub from: Option<String>,
    /// A straight line of the hand to a pose, or by a displacement along the base's axes, as in `--line "+0.1,0,0"` (can
    /// be repeated: one after another)
    #[arg(long, value_name = "POSE", allow_hyphen_values = true)]
    pub line: Vec<String>,
    /// An arc of the hand through a point to a pose, as in `--arc "0.5,0.1,0.3 -> 0.5,0,0.4,0,180deg,0"` (can be repeated)
    #[arg(long, value_name = "POINT -> POSE", allow_hyphen_values = true, conflicts_with = "line")]
    pub arc: Vec<String>,
    /// A move of the joints (repeated: a smooth curve through all)
    #[arg(long, value_name = "Q", allow_hyphen_values = true, conflicts_with_all = ["line", "arc", "from"])]
    pub joint: Vec<String>,
    /// A smooth path through the way-points of a file (- for standard input), one JSON array of joint variables, or one 4×4
    /// matrix, a line
    #[arg(long, value_name = "FILE", conflicts_with_all = ["line", "arc", "joint", "from"])]
    pub via: Option<PathBuf>,
    /// What the values behind a position are: quaternion, axis-angle, rpy, or an Euler set such as zyz
    #[arg(long, value_name = "SET", default_value = "rpy")]
    pub orientation: String,
    /// Lines as screws: turning about and moving along one axis in space
    #[arg(long, requires = "line")]
    pub screw: bool,
    /// How far the hand may leave its path between samples of the joints, metres
    #[arg(long, value_name = "METRES", value_parser = positive, allow_hyphen_values = true)]
    pub max_deviation: Option<f64>,
    /// Seconds between samples
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub dt: Option<f64>,
    /// Seconds for the whole path, no less than the limits allow
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub duration: Option<f64>,
    /// The hand's speed on the average where no accelerations are known, m/s
    #[arg(long, value_name = "SPEED", value_parser = positive, conflicts_with = "duration", default_value_t = 0.25)]
    pub speed: f64,
    /// Largest joint velocities, as in `100deg/s`, without unit rad/s or m/s: one for all or one each (else the robot
    /// file's)
    #[arg(long, value_name = "LIMITS")]
    pub velocity: Option<String>,
    /// Largest joint accelerations, without unit rad/s² or m/s² (else the robot file's)
    #[arg(long, value_name = "LIMITS")]
    pub acceleration: Option<String>,
    /// Largest joint jerks, without unit rad/s³ or m/s³; velocities are needed, too, and accelerations or torques
    #[arg(long, value_name = "LIMITS")]
    pub jerk: Option<String>,
    /// Largest drive torques, in N m (N for slides), of a robot with masses: one for all or one each, or `file` for the efforts of a
    /// URDF; velocities are needed, too, and jerks and accelerations may be limited besides
    #[arg(long, value_name = "LIMITS", conflicts_with = "law")]
    pub torque: Option<String>,
    /// The time law of a move from one configuration to another; needs velocities and accelerations
    #[arg(long, value_enum, requires = "joint")]
    pub law: Option<LawName>,
    /// Between several joint configurations go straight, and round each corner at this distance (Euclidean, radians and
    /// metres), instead of a smooth curve through them
    #[arg(long, value_name = "DISTANCE", value_parser = positive, conflicts_with_all = ["line", "arc"])]
    pub blend: Option<f64>,
    /// Say what comes of every configuration in which the path can start
    #[arg(long)]
    pub alternatives: bool,
    /// Write a plot of joints, velocities and manipulability
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// What to print
    #[arg(long, value_enum, default_value_t = PathFormat::Text)]
    pub format: PathFormat,
    /// Print JSON (the same as --format json)
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}

/// What a path is printed as.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PathFormat {
    /// A summary and a short table
    Text,
    /// A line a sample, with a header
    Csv,
    /// A JSON object a sample
    Ndjson,
    /// One JSON object
    Json,
}

/// Time laws by name.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LawName {
    /// Third degree
    Cubic,
    /// Fifth degree: no acceleration at the ends
    Quintic,
    /// The fastest under limits of velocity and acceleration
    Trapezoidal,
    /// The fastest under limits of velocity, acceleration and jerk
    JerkLimited,
}

impl From<LawName> for Law {
    fn from(name: LawName) -> Self {
        match name {
            LawName::Cubic => Law::Cubic,
            LawName::Quintic => Law::Quintic,
            LawName::Trapezoidal => Law::Trapezoidal,
            LawName::JerkLimited => Law::DoubleS,
        }
    }
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("a positive number is needed".into()),
    }
}
