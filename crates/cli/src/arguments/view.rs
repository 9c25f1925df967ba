//! The arguments of `view`.

use super::RobotArguments;
use clap::Args;
use std::path::PathBuf;

/// `view`
///
/// Serves the page to this machine alone, under an address that nobody can guess, until Ctrl-C ends it. Nothing leaves
/// the machine: the page computes in the browser.
#[derive(Args)]
#[command(mut_arg("robot", |robot| robot.required(false)))]
pub struct ViewArguments {
    /// The robot, if the page is to begin with one
    #[command(flatten)]
    pub robot: Option<RobotArguments>,
    /// The port on 127.0.0.1; a free one otherwise
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Print the address, and open no browser
    #[arg(long)]
    pub no_open: bool,
    /// Serve the page of this folder instead of the one in the program
    #[arg(long, value_name = "FOLDER")]
    pub page: Option<PathBuf>,
    /// Print the address as JSON
    #[arg(long)]
    pub json: bool,
}
