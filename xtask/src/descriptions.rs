//! All URDF and xacro files of three public packages, beside Pinocchio and the reference xacro.

use crate::languages::{python, quietly};
use crate::{command, program, scratch, succeed};
use anyhow::{Context, Result};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The wheel whose data hold robots; the program in it is for one version of Python, and is not used.
const PYBULLET: &str = "pybullet==3.2.7";

/// Reads them; installs what is missing first.
///
/// # Errors
/// If something cannot be installed, more than one in a hundred of the sound files is not read, or something is not as it should be.
pub fn run() -> Result<()> {
    let python = python(&["pin", "example-robot-data", "rtb-data", "xacro"])?;
    let wheel = wheel(&python)?;
    succeed(command(python).arg("xtask/descriptions/read_all.py").arg(program()?).arg(wheel))
}

/// The wheel of pybullet, fetched if it is missing.
fn wheel(python: &PathBuf) -> Result<PathBuf> {
    let folder = scratch()?.join("wheels");
    let found = || -> Option<PathBuf> {
        let files = fs::read_dir(&folder).ok()?.filter_map(|f| Some(f.ok()?.path()));
        files.into_iter().find(|f| f.extension().is_some_and(|e| e == "whl"))
    };
    if found().is_none() {
        let kind = ["--only-binary=:all:", "--python-version=3.11", "--platform=manylinux2014_x86_64"];
        let fetch = ["-m", "pip", "download", "--quiet", "--no-deps", PYBULLET, "--dest"];
        quietly(Command::new(python).args(fetch).arg(&folder).args(kind))?;
    }
    found().context("no wheel of pybullet")
}
