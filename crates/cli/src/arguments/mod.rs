//! The command line.

mod calibrate;
mod convert;
mod dynamics;
mod exercise;
mod generate;
mod identify;
#[cfg(feature = "parquet")]
mod map;
mod needed;
mod path;
mod recording;
mod report;
mod view;

use clap::{Args, Parser, Subcommand, ValueEnum};
use denavit::description::Convention;
use denavit::inverse::{Criterion, Goal};
use std::path::PathBuf;

pub use calibrate::{CalibrateArguments, MeasureName};
pub use convert::{ConvertArguments, ConvertFormat};
pub use dynamics::DynamicsArguments;
pub use exercise::{ExerciseArguments, ExerciseFormat};
pub use generate::{GenerateArguments, GoalName, LanguageName};
pub use identify::{CriterionOf, IdentifyArguments, PriorName};
#[cfg(feature = "parquet")]
pub use map::{Columns, CompressionName, MapArguments, Wanted};
pub use needed::arguments;
pub use path::{PathArguments, PathFormat};
pub use recording::{PoseColumns, RecordingArguments};
pub use report::{LevelName, PaceName, ReportArguments, ReportFormat, ReportLanguage, SectionName};
pub use view::ViewArguments;

/// Everything about a robot arm from its Denavit-Hartenberg table: exact, proved, in formulas and in numbers.
///
/// A ROBOT is a name from the catalogue (`denavit robots`), a robot file (.toml), a URDF (.urdf, .xacro), a model of MuJoCo
/// (.xml, .mjcf), a .par file of SYMORO, a table as it stands in a document (.md, .txt, .csv, .tsv, .tex, .typ), or a program that
/// makes a robot with a toolbox (.m, .py: Link, SerialLink, DHRobot, dhparams). Robot files of Stewart platforms, deltas and planar 3-RRR
/// robots say their `kind`, and are for `show`, `fk`, `ik` and `jacobian`.
/// Exit codes: 0 done, 1 the answer is no, 2 usage, 3 bad input, 4 not supported, 5 gave up.
#[derive(Parser)]
#[command(name = "denavit", version, max_term_width = 110)]
pub struct Arguments {
    /// Leave notes and warnings on standard error away; errors stay
    #[arg(long, global = true)]
    pub quiet: bool,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The verbs.
#[derive(Subcommand)]
pub enum Command {
    /// List the robots of the catalogue, and the trees, closed loops and parallel robots that come with the program
    Robots(RobotsArguments),
    /// Show a robot's table and what is special about its structure, or convert it to another convention
    Show(ShowArguments),
    /// Convert a robot into another format: a robot file, its axes, screws, a URDF, an MJCF, a .par file, a table; proved the same
    Convert(ConvertArguments),
    /// Compute poses: the tool, all frames, orientations in any set of angles
    Fk(FkArguments),
    /// Find all joint variables for a pose, or derive and explain the formulas for them
    Ik(IkArguments),
    /// Compute Jacobians, velocities, forces and how near a singularity is, or derive the formulas and the singularities
    Jacobian(JacobianArguments),
    /// Compute torques, inertia and accelerations of an arm with masses, or derive base parameters and the torques as formulas
    Dynamics(DynamicsArguments),
    /// Identify base parameters, friction and masses that can be from recorded motion and torques, or search a motion that shows them
    Identify(IdentifyArguments),
    /// Plan a path of the joints or the hand: followed on one branch, timed within limits, sampled
    Path(PathArguments),
    /// Compute over the rows of a file, Parquet, Arrow, CSV or NPZ: poses, Jacobians, torques, joints for poses
    #[cfg(feature = "parquet")]
    Map(Box<MapArguments>),
    /// Derive link transforms, the simplified forward model, and the shortest algorithm for it
    Derive(DeriveArguments),
    /// Write everything about a robot as a document: figures, table, models, solutions, singularities, workspace
    Report(ReportArguments),
    /// Make an exercise sheet with round numbers, its solution, and the task that `check` marks answers by
    Exercise(ExerciseArguments),
    /// Hold formulas that somebody printed against the robot: proved, or wrong and where the slip is; or recorded motion
    Check(CheckArguments),
    /// Find the geometry of an arm out of measurements, say what they can show of it, or choose the poses to measure at
    Calibrate(CalibrateArguments),
    /// Write source code in a chosen language, in a folder that builds and tests itself
    Generate(GenerateArguments),
    /// Open the page: a robot to turn, to drag and to understand, in the browser
    View(ViewArguments),
}

/// `robots`
#[derive(Args)]
pub struct RobotsArguments {
    /// Only robots whose name holds this text
    pub filter: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// The robot that a command is about.
#[derive(Args, Clone, Default)]
pub struct RobotArguments {
    /// A catalogue name, or the path of a robot file (.toml, .par), URDF, xacro, MJCF, table (.md, .csv, .tex, .typ) or program that makes a robot
    /// (.m, .py); - reads a robot file, URDF, MJCF or table from standard input
    pub robot: String,
    /// Give a parameter a value, as in `--set D3=450mm` (can be repeated)
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// The convention of a table whose document does not say it; of a URDF or MJCF the one its table is made in (standard)
    #[arg(long, value_enum)]
    pub convention: Option<ConventionName>,
    /// The unit of angles without unit in a table
    #[arg(long, value_enum)]
    pub angles: Option<AngleUnit>,
    /// The unit of lengths without unit in a table
    #[arg(long, value_enum)]
    pub lengths: Option<LengthUnit>,
    /// Which table of a document, counted from 1
    #[arg(long, value_name = "N")]
    pub table: Option<usize>,
    /// What the columns of a table mean, in order, as in `--columns "theta alpha a d"`
    #[arg(long, value_name = "LETTERS")]
    pub columns: Option<String>,
    /// The link of a URDF or MJCF, or the frame of a tree of rows, at which the chain begins; the root otherwise
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The link or frame at which the chain ends; the leaf with the most joints otherwise
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// How closed loops are assembled: the name of a mode in the robot file, or signs as `show` prints them, as in `--mode x` or
    /// `--mode "+-"`; the first that is named otherwise. Of a parallel robot: the one of its poses (`fk`) or solutions (`ik`) that is
    /// printed; all otherwise
    #[arg(long, value_name = "MODE", allow_hyphen_values = true)]
    pub mode: Option<String>,
    /// Take the decimals of angles in a URDF or MJCF as they are: 1.5708 is not read as 90°
    #[arg(long)]
    pub as_written: bool,
    /// Give an argument of a xacro file a value (can be repeated)
    #[arg(long, value_name = "NAME=VALUE")]
    pub arg: Vec<String>,
    /// The folder of a package that a xacro file asks for; those beside its own are found (can be repeated)
    #[arg(long, value_name = "NAME=FOLDER")]
    pub package: Vec<String>,
}

/// `show`
#[derive(Args)]
pub struct ShowArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Convert the table to this convention (the chain is proved unchanged)
    #[arg(long = "as", value_enum)]
    pub to: Option<ConventionName>,
    /// Print the robot file instead
    #[arg(long)]
    pub toml: bool,
    /// Print JSON
    #[arg(long, conflicts_with = "toml")]
    pub json: bool,
    /// Draw the arm with its frames and lengths into this SVG file (- for standard output)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["toml", "json"])]
    pub figure: Option<PathBuf>,
    /// Draw the line diagram of textbooks instead
    #[arg(long, requires = "figure")]
    pub scheme: bool,
    /// The configuration that is drawn, as for `fk`; one that shows the arm well otherwise
    #[arg(short, allow_hyphen_values = true, value_name = "CONFIGURATION", requires = "figure")]
    pub q: Option<String>,
}

/// `fk`
#[derive(Args)]
pub struct FkArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The joint variables, as in `-q "0, -90deg, pi/2, 0.1, 20mm, 0"`, some of them by name, as in `-q "elbow=30deg"`, the
    /// others at 0, or the name of a pose of the robot file; without unit radians and metres
    #[arg(short, long = "joints", value_name = "Q", allow_hyphen_values = true)]
    pub q: Option<String>,
    /// Read one JSON array of joint variables a line from a file (- for standard input), answer a line each
    #[arg(long, value_name = "FILE", conflicts_with = "q")]
    pub input: Option<PathBuf>,
    /// Frames to give as well: `all`, or some by number or by the name of a row, with commas; `all` of a tree without --tip are those of all its bodies
    #[arg(long, value_name = "all|N,NAME")]
    pub frames: Option<String>,
    /// The orientation too as: quaternion, axis-angle, rpy, or an Euler set such as zyz (with --symbolic rpy and Euler sets)
    #[arg(long, value_name = "SET")]
    pub orientation: Option<String>,
    /// Print the formulas instead of numbers
    #[arg(long, conflicts_with_all = ["q", "input", "frames"])]
    pub symbolic: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `ik`
#[derive(Args)]
pub struct IkArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The pose of the tool: `x, y, z, roll, pitch, yaw` (fixed axes; without unit metres and radians), or a matrix as
    /// JSON or by rows, as in `"[[1,0,0,0.4],[0,1,0,0],[0,0,1,0.3],[0,0,0,1]]"`
    #[arg(short, long, value_name = "POSE", allow_hyphen_values = true)]
    pub pose: Option<String>,
    /// What the values behind the position in --pose are: quaternion, axis-angle, rpy, or an Euler set such as zyz
    #[arg(long, value_name = "SET", default_value = "rpy", requires = "pose")]
    pub orientation: String,
    /// Take the pose from these joint variables, as in `fk`: shows the other configurations with the same pose
    #[arg(short, long = "joints", value_name = "Q", allow_hyphen_values = true, conflicts_with = "pose")]
    pub q: Option<String>,
    /// Read one JSON 4×4 matrix a line from a file (- for standard input), answer a line each
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pose", "q"])]
    pub input: Option<PathBuf>,
    /// Joint variables that are given beside the pose, with or without value, as in `--given q7=30deg` (names or
    /// numbers, separated by commas); an arm with too many joints has some chosen otherwise
    #[arg(long, value_name = "JOINTS")]
    pub given: Option<String>,
    /// What of the tool is to be met
    #[arg(long, value_enum, default_value_t = GoalName::Pose)]
    pub goal: GoalName,
    /// The position alone is to be met, the same as --goal position
    #[arg(long, conflicts_with = "goal")]
    pub position: bool,
    /// Give the solution nearest to these joint variables as well, moved by whole turns; solutions within the limits come
    /// first, however far
    #[arg(long, value_name = "Q", allow_hyphen_values = true)]
    pub near: Option<String>,
    /// Give the best solution by a criterion as well
    #[arg(long, value_name = "CRITERION", value_enum, conflicts_with_all = ["near", "follow"])]
    pub best: Option<CriterionName>,
    /// Only what the joint limits allow, moved there by whole turns; says how many solutions were left out
    #[arg(long)]
    pub limits: bool,
    /// One solution of each pose, within the limits if one is, near to --near: quick for arms with many
    #[arg(long)]
    pub one: bool,
    /// With --input: each pose takes the solution nearest to that of the line before (the first to --near, or to 0); says where
    /// that is another branch, or a joint goes back by a turn
    #[arg(long)]
    pub follow: bool,
    /// Take axes that are nearly parallel, perpendicular or meeting as exactly so, up to TOL (0 to 0.1; radians, and lengths by the
    /// arm's size); says what changed and what it costs
    #[arg(long, value_name = "TOL", num_args = 0..=1, default_missing_value = "0.01", require_equals = true)]
    pub idealise: Option<f64>,
    /// Print the derivation, step by step, as a textbook has it
    #[arg(long, conflicts_with_all = ["pose", "q", "input"])]
    pub explain: bool,
    /// Print the formulas alone
    #[arg(long, conflicts_with_all = ["pose", "q", "input", "explain"])]
    pub symbolic: bool,
    /// Write a certificate of what is proved: JSON for `check_certificate.py` (docs/certificates.md), or Coq if FILE ends in .v
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pose", "q", "input"])]
    pub certificate: Option<PathBuf>,
    /// How to print --explain and --symbolic
    #[arg(long, value_enum, default_value_t = Format::Terminal, conflicts_with_all = ["pose", "q", "input"])]
    pub format: Format,
    /// The language of the derivation's words
    #[arg(long, value_enum, default_value = "en", conflicts_with_all = ["pose", "q", "input", "json"])]
    pub language: ReportLanguage,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}

impl IkArguments {
    /// What of the tool is to be met.
    pub fn goal(&self) -> Goal {
        if self.position { Goal::Position } else { self.goal.into() }
    }
}

/// `check`
///
/// Reads single equations, matrices, products, chains of definitions, Jacobians, inverse formulas and numeric answers in
/// Markdown, LaTeX, plain text or TOML, and straight-line code in Python or MATLAB. With one argument, the robot is the
/// Denavit-Hartenberg table that stands in the document. Exit codes: 0 all is right, 1 something is wrong, follows from
/// what is wrong, or is right under a condition only, 3 something could not be read or decided, or was not judged (and
/// nothing is wrong).
///
/// A recording (.csv, .tsv, .jsonl, .npy, .npz, .parquet, or the folder of a data set of LeRobot, with columns of joints and poses) is
/// held against the robot's motion: units, orders, signs, zeros, formats, frames and delays in which it is other than the model. Exit codes: 0 nothing to remark, 1 findings,
/// 3 it cannot be read, is not understood, or does not move.
#[derive(Args)]
pub struct CheckArguments {
    /// The robot, or a task: a rubric that names its robot; may be left out where the document holds its table
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The document (.md, .tex, .typ, .txt, .toml, .py, .m, .c, .cpp, .js, .jl); several, or a folder, are those of a class. Or a recording
    /// of joints and poses (.csv, .tsv, .jsonl, .npy, .npz, .parquet, the folder of a data set of LeRobot)
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// What the left side of the first statement means: `T06`, `A3`, `R03`, `"T06 3,4"` for an entry
    #[arg(long, value_name = "NAME")]
    pub claim: Option<String>,
    /// How far a numeric answer may be off, in its own unit (default: one unit of its last digit)
    #[arg(long, value_name = "TOLERANCE")]
    pub tolerance: Option<f64>,
    /// Points for each claim, from a TOML file: prints a sheet for the teacher
    #[arg(long, value_name = "FILE")]
    pub rubric: Option<PathBuf>,
    /// List the claims that are right, too
    #[arg(short, long)]
    pub all: bool,
    /// Write a certificate of what is proved: JSON for `check_certificate.py` (docs/certificates.md), or Coq if FILE ends in .v
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// Write the document with its slips marked; of a class, all of them below the table of points
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write the table of a class for a spreadsheet
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Of a recording
    #[command(flatten)]
    pub recording: RecordingArguments,
    /// Print the list as Markdown
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// `jacobian`
#[derive(Args)]
pub struct JacobianArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The joint variables, as in `fk`
    #[arg(short, long = "joints", value_name = "Q", allow_hyphen_values = true)]
    pub q: Option<String>,
    /// Read one JSON array of joint variables a line from a file (- for standard input), answer a line each
    #[arg(long, value_name = "FILE", conflicts_with = "q")]
    pub input: Option<PathBuf>,
    /// Along whose axes: `base`, `tool`, the number of a frame, or `shortest` for the frame and point where the formulas
    /// are shortest
    #[arg(long, value_name = "FRAME", default_value = "base")]
    pub frame: String,
    /// Whose velocity: `tool`, or the number of a link's frame
    #[arg(long, value_name = "BODY", default_value = "tool")]
    pub of: String,
    /// At which point: the origin of a frame (`tool`, a number), or `x, y, z` from the origin of the body's own frame
    #[arg(long, value_name = "POINT", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// The analytic Jacobian: how fast these values change (quaternion, axis-angle, rpy, or an Euler set such as zyz)
    #[arg(long, value_name = "SET", requires = "q")]
    pub orientation: Option<String>,
    /// Joint velocities: gives the twist, and how the Jacobian changes
    #[arg(long, value_name = "RATES", allow_hyphen_values = true, requires = "q")]
    pub rates: Option<String>,
    /// A twist `vx, vy, vz, wx, wy, wz` (m/s and rad/s; `-` where any will do): gives the joint velocities for it,
    /// damped near singularities and within the robot file's limits
    #[arg(long, value_name = "TWIST", allow_hyphen_values = true, requires = "q")]
    pub twist: Option<String>,
    /// Below which singular value (lengths by the arm's size) velocities are damped, and by how much at most
    #[arg(long, value_name = "THRESHOLD,LARGEST", requires = "twist", allow_hyphen_values = true)]
    pub damping: Option<String>,
    /// Joint velocities that are wished as far as the twist leaves the joints free
    #[arg(long, value_name = "RATES", allow_hyphen_values = true, requires = "twist")]
    pub wish: Option<String>,
    /// A wrench `fx, fy, fz, mx, my, mz` that the body exerts (N and N m): gives the torques that hold it
    #[arg(long, value_name = "WRENCH", allow_hyphen_values = true, requires = "q")]
    pub wrench: Option<String>,
    /// The largest torques (N m; N for slides): says how far the wrench can grow
    #[arg(long, value_name = "TORQUES", requires = "wrench", allow_hyphen_values = true)]
    pub torques: Option<String>,
    /// The derivatives of the Jacobian by each joint as well
    #[arg(long, requires = "q")]
    pub hessian: bool,
    /// Print the formulas: the matrix, its algorithm and its operation count, proved
    #[arg(long, conflicts_with_all = ["q", "input"])]
    pub symbolic: bool,
    /// Print the matrix where it is shortest, its determinant in factors, and what happens at each singularity
    #[arg(long, conflicts_with_all = ["q", "input", "symbolic"])]
    pub explain: bool,
    /// Write a certificate of what is proved: JSON for `check_certificate.py` (docs/certificates.md), or Coq if FILE ends in .v
    #[arg(long, value_name = "FILE", conflicts_with_all = ["q", "input"])]
    pub certificate: Option<PathBuf>,
    /// With --explain: singularities of the position alone, as of a planar arm
    #[arg(long, requires = "explain")]
    pub position: bool,
    /// How to print --symbolic and --explain
    #[arg(long, value_enum, default_value_t = Format::Terminal, conflicts_with_all = ["q", "input"])]
    pub format: Format,
    /// The language of their words
    #[arg(long, value_enum, default_value = "en", conflicts_with_all = ["q", "input", "json"])]
    pub language: ReportLanguage,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}

/// What makes a solution good.
#[derive(Clone, Copy, ValueEnum)]
pub enum CriterionName {
    /// In the middle of the limits: the joint nearest to a limit is as far from it as can be
    Limits,
    /// Able to move in every direction: the smallest singular value of the Jacobian is as large as can be
    Singularities,
}

impl From<CriterionName> for Criterion {
    fn from(name: CriterionName) -> Self {
        match name {
            CriterionName::Limits => Criterion::FarthestFromLimits,
            CriterionName::Singularities => Criterion::FarthestFromSingularity,
        }
    }
}

/// `derive`
#[derive(Args)]
pub struct DeriveArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The frame in which to give the result: a number, `base` or `tool`
    #[arg(long, value_name = "FRAME", default_value = "base")]
    pub from: String,
    /// The frame whose pose to give: a number, `base` or `tool`
    #[arg(long, value_name = "FRAME", default_value = "tool")]
    pub to: String,
    /// Coordinates `x, y, z` of a point in the frame --to, numbers or names: gives them in the frame --from, too
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub point: Option<String>,
    /// The same of a free vector, which is turned and not shifted
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub vector: Option<String>,
    /// Parts for the algorithm to compute: x, y, z (columns), orientation, position; separated by commas
    #[arg(long, value_name = "PARTS", default_value = "all")]
    pub only: String,
    /// Write a certificate of what is proved: JSON for `check_certificate.py` (docs/certificates.md), or Coq if FILE ends in .v
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Terminal)]
    pub format: Format,
    /// The language of the words
    #[arg(long, value_enum, default_value = "en", conflicts_with = "json")]
    pub language: ReportLanguage,
    /// Print JSON (the same as --format json)
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}

/// Output formats of formulas.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned text
    #[value(alias = "text")]
    Terminal,
    /// LaTeX, to paste into a document
    Latex,
    /// Typst, to paste into a document
    Typst,
    /// A web page with MathML
    Html,
    /// Markdown with LaTeX formulas
    Markdown,
    /// JSON with formulas as plain text that parses back
    Json,
}

/// Conventions by name.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ConventionName {
    /// Rz(θ) Tz(d) Tx(a) Rx(α)
    #[value(aliases = ["classic", "sdh", "distal"])]
    Standard,
    /// Rx(α) Tx(a) Rz(θ) Tz(d), the modified one
    #[value(aliases = ["modified", "mdh", "proximal"])]
    Craig,
    /// Rx(α) Tx(d) Rz(θ) Tz(r)
    Khalil,
}

impl From<ConventionName> for Convention {
    fn from(name: ConventionName) -> Self {
        match name {
            ConventionName::Standard => Convention::Standard,
            ConventionName::Craig => Convention::Craig,
            ConventionName::Khalil => Convention::Khalil,
        }
    }
}

/// Units of angles.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum AngleUnit {
    /// Degrees
    Deg,
    /// Radians
    Rad,
}

/// Units of lengths.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LengthUnit {
    /// Millimetres
    Mm,
    /// Metres
    M,
}
