//! What a change must pass: everything, the quick part of it, and what is asked of a release beside it.
//!
//! A step that has to install something first (a Python environment, say) does so on its own, when it runs.

use crate::languages::quietly;
use crate::runner::{REPORTS, nextest};
use crate::steps::{self, Step};
use crate::{cargo, command, path, program, succeed, target};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;

const fn step(name: &'static str, words: &'static [&'static str]) -> Step {
    Step { name, words }
}

/// What is known at once, and what everything else is built of.
const FIRST: &[Step] = &[
    step("format", &["step", "format"]),
    step("rules", &["tidy", "--rules"]),
    step("clippy", &["step", "clippy"]),
    // The program that is tested has the page in it.
    step("page, built", &["step", "page"]),
    step("build", &["step", "build"]),
];
/// What keeps the cores busy.
const FRONT: &[Step] = &[
    step("tests", &["step", "tests"]),
    step("doctests", &["step", "doctests"]),
    step("examples", &["step", "examples"]),
    step("documentation", &["step", "documentation"]),
    step("documents", &["documents"]),
];
/// What waits for installers, browsers and interpreters.
const ASIDE: &[Step] = &[
    step("sessions", &["tidy", "--sessions"]),
    step("errata", &["errata"]),
    step("operation counts", &["counts", "--check"]),
    step("page, driven", &["page"]),
    step("benchmark", &["step", "benchmark"]),
    step("languages", &["languages"]),
    step("c", &["c"]),
    step("python", &["python"]),
    step("site", &["site"]),
];
/// After an edit.
const QUICK: &[Step] = &[
    step("format", &["step", "format"]),
    step("rules", &["tidy", "--rules"]),
    step("tests", &["step", "changed"]),
    step("clippy", &["step", "lint-changed"]),
];
/// Before a release, behind all of the above.
const FULL: &[Step] = &[
    step("limits of size", &["web"]),
    step("page in full", &["page", "--timed"]),
    step("every robot", &["languages", "--every"]),
    step("firmware", &["firmware"]),
    step("certificates", &["certificates"]),
    step("counts of dynamics", &["counts", "dynamics", "--check"]),
    step("descriptions", &["descriptions"]),
    step("wheel", &["wheel"]),
    step("miri", &["miri"]),
    step("soak", &["soak"]),
    step("bench", &["bench"]),
];

/// Everything that a change must pass.
///
/// # Errors
/// The first step that fails.
pub fn run() -> Result<()> {
    steps::run(FIRST, FRONT, ASIDE)
}

/// What is known soon of crates that differ from the last commit, and of those that use them.
///
/// # Errors
/// The first step that fails.
pub fn quick() -> Result<()> {
    steps::run(QUICK, &[], &[])
}

/// Everything that a change must pass, and what takes hours.
///
/// # Errors
/// The first step that fails.
pub fn full() -> Result<()> {
    run()?;
    steps::run(FULL, &[], &[])
}

/// A step of its own.
///
/// # Errors
/// If it fails, or there is no such step.
pub fn one(name: &str) -> Result<()> {
    match name {
        "format" => run_cargo(&["fmt", "--all", "--check"]),
        "clippy" => run_cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]),
        "page" => crate::web::for_tests(),
        "lint-changed" => lint_changed(),
        "build" => match nextest() {
            Some(mut runner) => succeed(runner.args(["run", "--workspace", "--locked", "--no-run"])),
            None => run_cargo(&["test", "--workspace", "--locked", "--no-run"]),
        },
        "tests" => tests(),
        "changed" => changed_tests(),
        "doctests" => run_cargo(&["test", "--workspace", "--locked", "--doc", "--quiet"]),
        "examples" => examples(),
        "documentation" => documentation(),
        "benchmark" => benchmark(),
        _ => bail!("no such step: {name}"),
    }
}

fn run_cargo(arguments: &[&str]) -> Result<()> {
    succeed(cargo().args(arguments))
}

/// All tests, but what other steps run.
fn tests() -> Result<()> {
    crate::languages::install()?;
    match nextest() {
        Some(mut runner) => {
            runner.args(["run", "--workspace", "--locked", "-E", &format!("not test({REPORTS})")]);
            succeed(&mut runner)
        }
        None => run_cargo(&["test", "--workspace", "--locked", "--lib", "--bins", "--tests"]),
    }
}

/// The quick tests of the crates that differ from the last commit, and of those that use them; of all, if none does.
fn changed_tests() -> Result<()> {
    let Some(mut runner) = nextest() else {
        return run_cargo(&["test", "--workspace", "--locked", "--lib", "--bins", "--tests"]);
    };
    runner.args(["run", "--workspace", "--locked", "--profile", "quick"]);
    let changed: Vec<String> = changed()?.iter().map(|name| format!("rdeps(={name})")).collect();
    if !changed.is_empty() {
        runner.args(["-E", &changed.join(" | ")]);
    }
    succeed(&mut runner)
}

fn lint_changed() -> Result<()> {
    let changed = changed()?;
    let packages = changed.iter().flat_map(|name| ["-p", name]);
    let scope: Vec<&str> = if changed.is_empty() { vec!["--workspace"] } else { packages.collect() };
    run_cargo(&[&["clippy"], &scope[..], &["--all-targets", "--", "-D", "warnings"]].concat())
}

/// The packages with files that differ from the last commit.
fn changed() -> Result<BTreeSet<String>> {
    let output = command("git").args(["status", "--porcelain", "-z", "--untracked-files=all"]).output()?;
    let status = String::from_utf8(output.stdout)?;
    let files = status.split('\0').filter_map(|entry| entry.get(3..));
    let folders: BTreeSet<String> = files
        .filter_map(|file| match file.split('/').collect::<Vec<_>>()[..] {
            ["crates", name, _, ..] => Some(format!("crates/{name}")),
            ["xtask", _, ..] => Some("xtask".into()),
            _ => None,
        })
        .collect();
    let name = |folder: &String| {
        let manifest = std::fs::read_to_string(path(&format!("{folder}/Cargo.toml"))).ok()?;
        let manifest: toml::Table = manifest.parse().ok()?;
        Some(manifest.get("package")?.get("name")?.as_str()?.to_string())
    };
    Ok(folders.iter().filter_map(name).collect())
}

/// The package `bench`, which is no member of the workspace, compiles; beside the workspace, with which it shares crates of others.
fn benchmark() -> Result<()> {
    crate::languages::install()?;
    crate::bench::cmake()?;
    let mut check = cargo();
    check.args(["check", "--locked", "--manifest-path", "bench/Cargo.toml"]);
    succeed(check.env("CARGO_TARGET_DIR", target()))
}

/// The numbered examples end without a failed assertion.
fn examples() -> Result<()> {
    program()?;
    for entry in std::fs::read_dir(path("crates/robot/examples"))? {
        let file = entry?.path();
        let name = file.file_stem().and_then(|s| s.to_str()).context("a name")?;
        println!("{name}");
        quietly(&mut command(target().join("debug/examples").join(name)))?;
    }
    Ok(())
}

fn documentation() -> Result<()> {
    succeed(cargo().args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))
}
