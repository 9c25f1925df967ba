//! The arguments of `dynamics`.

use super::{Format, ReportLanguage, RobotArguments};
use clap::Args;

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
    /// The joints' velocities, one a joint; 0 otherwise
    #[arg(long, value_name = "RATES", allow_hyphen_values = true, requires = "q")]
    pub qd: Option<String>,
    /// The joints' accelerations: gives the torques for them; 0 otherwise
    #[arg(long, value_name = "ACCELERATIONS", allow_hyphen_values = true, requires = "q")]
    pub qdd: Option<String>,
    /// Torques in N m (N for slides), one a joint: gives the accelerations under them
    #[arg(long, value_name = "TORQUES", allow_hyphen_values = true, requires = "q", conflicts_with = "qdd")]
    pub tau: Option<String>,
    /// What the tool exerts on its surroundings: force and moment about its origin, `fx, fy, fz, mx, my, mz` along the axes of
    /// the base (N and N m)
    #[arg(long, value_name = "WRENCH", allow_hyphen_values = true, requires = "q")]
    pub wrench: Option<String>,
    /// The acceleration of gravity in the base: x, -x, y, -y, z, -z (of 9.81 m/s²), none, or three components
    #[arg(long, value_name = "DIRECTION", allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// Print formulas: base parameters, a program for the torques with its cost, and of arms with up to three joints A, C q̇ and Q
    #[arg(long, conflicts_with = "q")]
    pub symbolic: bool,
    /// How to print --symbolic
    #[arg(long, value_enum, default_value_t = Format::Terminal, conflicts_with = "q")]
    pub format: Format,
    /// The language of the words of --symbolic
    #[arg(long, value_enum, default_value = "en", conflicts_with = "q")]
    pub language: ReportLanguage,
    /// Print JSON
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
}
