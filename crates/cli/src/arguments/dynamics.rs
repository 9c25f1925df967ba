//! The arguments of `dynamics`.

use super::path::positive;
use super::{Format, ReportLanguage, RobotArguments};
use clap::Args;
use std::path::PathBuf;

/// `dynamics`
///
/// In numbers the robot's file gives the masses (a URDF, an MJCF, or a robot file: docs/robot-files.md). Formulas need none:
/// the links then have Khalil and Dombre's XX1 … M6.
#[derive(Args)]
pub struct DynamicsArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The joint variables, as in `fk`
    #[arg(short, long = "joints", value_name = "Q", allow_hyphen_values = true)]
    pub q: Option<String>,
    /// Read a state a line from a file (- for standard input), answer a line each: a JSON object with `q` and `qd`, `qdd` or `tau`,
    /// `wrench`; or the numbers of q, of q and q̇, or of q, q̇ and q̈, separated by commas
    #[arg(long, value_name = "FILE", conflicts_with_all = ["q", "simulate"])]
    pub input: Option<PathBuf>,
    /// The joints' velocities, one a joint; 0 otherwise
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    pub qd: Option<String>,
    /// The joints' accelerations: gives the torques for them; 0 otherwise
    #[arg(long, value_name = "ACCELERATIONS", allow_hyphen_values = true)]
    pub qdd: Option<String>,
    /// Torques in N m (N for slides), one a joint: gives the accelerations under them; with --simulate the motion
    #[arg(long, value_name = "TORQUES", allow_hyphen_values = true, conflicts_with = "qdd")]
    pub tau: Option<String>,
    /// Follow the motion for so many seconds from -q and --qd on, under --tau or --tau-file (without: free), with friction; the
    /// balance of energy is said
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true, requires = "q",
        conflicts_with = "qdd")]
    pub simulate: Option<f64>,
    /// Torques over time, a line of numbers each: the time and a torque a joint, linear between the lines (- for standard input)
    #[arg(long, value_name = "FILE.csv", requires = "simulate", conflicts_with = "tau")]
    pub tau_file: Option<String>,
    /// Seconds between samples
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true, requires = "simulate")]
    pub dt: Option<f64>,
    /// Symplectic steps of so many seconds, instead of steps by their error
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true, requires = "simulate")]
    pub step: Option<f64>,
    /// Write a plot of joints, velocities and energies over time
    #[arg(long, value_name = "FILE.svg", requires = "simulate")]
    pub plot: Option<PathBuf>,
    /// Print the samples of --simulate as CSV
    #[arg(long, requires = "simulate", conflicts_with_all = ["json", "format"])]
    pub csv: bool,
    /// What the tool carries: a mass, or mass, x, y, z of its centre in the frame of the tool, or these and its inertia about
    /// the centre, xx, xy, xz, yy, yz, zz
    #[arg(long, value_name = "MASS", allow_hyphen_values = true)]
    pub payload: Option<String>,
    /// Where wrenches, of --wrench or --input, are exerted, in place of the tool: a frame by its number or name; with --whole a link
    #[arg(long, value_name = "FRAME")]
    pub at: Option<String>,
    /// What the tool exerts on its surroundings: force and moment about its origin, `fx, fy, fz, mx, my, mz` along the axes of
    /// the base (N and N m)
    #[arg(long, value_name = "WRENCH", allow_hyphen_values = true)]
    pub wrench: Option<String>,
    /// The first derivatives of the torques by q, q̇ and q̈, or with --tau of the accelerations by q, q̇ and τ, too
    #[arg(long, requires = "q", conflicts_with_all = ["wrench", "simulate", "symbolic", "explain"])]
    pub derivatives: bool,
    /// All joints of a tree of bodies (a URDF, an MJCF or a tree of rows) and not one chain through it: the root stands still. -q, --qd,
    /// --qdd and --tau have a value a joint, branch after branch as `fk --frames all` has them; -q takes names, too, as in -q "elbow=0.5"
    #[arg(long, conflicts_with_all = ["payload", "explain", "base", "tip"])]
    pub whole: bool,
    /// The acceleration of gravity in the base: x, -x, y, -y, z, -z (of 9.81 m/s²), none, or three components (m/s² where
    /// none has a unit)
    #[arg(long, value_name = "DIRECTION", allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// Print formulas: base parameters, a program for the torques with its cost, and of arms with up to three joints A, C q̇ and Q;
    /// with --whole those of a tree
    #[arg(long, conflicts_with_all = ["q", "qd", "qdd", "tau", "wrench", "at", "simulate", "input", "payload"])]
    pub symbolic: bool,
    /// Parameters of links that are to stand for what is grouped with them, as in --keep "YY2, M4", in place of those that the rule
    /// of Gautier and Khalil keeps; for --symbolic and --explain
    #[arg(long, value_name = "PARAMETERS", conflicts_with_all = ["q", "input"])]
    pub keep: Option<String>,
    /// Parameters of links that are not to stand for others; what stands in their place is chosen
    #[arg(long, value_name = "PARAMETERS", conflicts_with_all = ["q", "input"])]
    pub drop: Option<String>,
    /// Explain the derivation: the bodies, the groupings, the recursion outward and inward with a name for every quantity, and on
    /// what the links' motions and the torques rest
    #[arg(long, conflicts_with_all = ["symbolic", "q", "qd", "qdd", "tau", "wrench", "at", "simulate", "input", "payload"])]
    pub explain: bool,
    /// How to print --symbolic and --explain
    #[arg(long, value_enum, default_value_t = Format::Terminal, conflicts_with_all = ["q", "input"])]
    pub format: Format,
    /// The language of the words of --symbolic and --explain
    #[arg(long, value_enum, default_value = "en", conflicts_with_all = ["q", "input"])]
    pub language: ReportLanguage,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}
