//! All that a change must pass, in order; the first failure ends it.
//!
//! A step that has to install something first (a Python environment, say) does so on its own, when it runs.

use crate::web::TARGET;
use crate::{cargo, counts, documents, errata, languages, path, succeed, tidy, web};
use anyhow::{Context, Result};
use std::time::{Duration, Instant};

/// What a step that did not fail has to say.
enum Outcome {
    Passed,
    Skipped(String),
}

type Step = (&'static str, fn() -> Result<Outcome>);

const STEPS: &[Step] = &[
    ("format", || run(&["fmt", "--all", "--check"])),
    ("clippy", || run(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])),
    ("tidy", || tidy::run().map(|()| Outcome::Passed)),
    ("page", page),
    ("tests", || run(&["test", "--workspace", "--locked"])),
    ("examples", examples),
    ("languages", || languages::run().map(|()| Outcome::Passed)),
    ("benchmark", benchmark),
    ("documentation", documentation),
    ("documents", || documents::run().map(|()| Outcome::Passed)),
    ("errata", || errata::run(false).map(|()| Outcome::Passed)),
    ("operation counts", || counts::run(true).map(|()| Outcome::Passed)),
];

/// Runs all steps.
///
/// # Errors
/// The first step that fails.
pub fn run_all() -> Result<()> {
    let mut summary: Vec<(&str, String, Duration)> = vec![];
    let mut failure = None;
    for (name, step) in STEPS {
        println!("\n━━ {name} ━━");
        let start = Instant::now();
        let result = match step() {
            Ok(Outcome::Passed) => "passed".into(),
            Ok(Outcome::Skipped(why)) => {
                println!("skipped: {why}");
                format!("skipped: {why}")
            }
            Err(e) => {
                let line = format!("FAILED: {e:#}");
                failure = Some(e.context(format!("{name} failed")));
                line.lines().next().unwrap_or_default().to_string()
            }
        };
        summary.push((name, result, start.elapsed()));
        if failure.is_some() {
            break;
        }
    }
    println!("\n━━ summary ━━");
    for (name, result, elapsed) in &summary {
        println!("{name:<18} {:>6.1} s  {result}", elapsed.as_secs_f64());
    }
    for (name, _) in &STEPS[summary.len()..] {
        println!("{name:<18} {:>8}  not run", "");
    }
    failure.map_or(Ok(()), Err)
}

fn run(arguments: &[&str]) -> Result<Outcome> {
    succeed(cargo().args(arguments))?;
    Ok(Outcome::Passed)
}

/// The package `bench`, which is no member of the workspace, compiles.
fn benchmark() -> Result<Outcome> {
    crate::bench::cmake()?;
    let mut check = cargo();
    check.args(["check", "--locked", "--manifest-path", "bench/Cargo.toml"]);
    succeed(check.env("CARGO_TARGET_DIR", path("target/bench")))?;
    Ok(Outcome::Passed)
}

/// The numbered examples end without a failed assertion.
fn examples() -> Result<Outcome> {
    for entry in std::fs::read_dir(path("crates/robot/examples"))? {
        let file = entry?.path();
        let name = file.file_stem().and_then(|s| s.to_str()).context("a name")?;
        succeed(cargo().args(["run", "--quiet", "--locked", "-p", "denavit", "--example", name]))?;
    }
    Ok(Outcome::Passed)
}

fn documentation() -> Result<Outcome> {
    succeed(cargo().args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings"))?;
    Ok(Outcome::Passed)
}

/// The page builds within its limits, and does in a browser what it should; the program that is tested behind it has it in.
fn page() -> Result<Outcome> {
    if !web::has_target()? {
        let why = format!("the target is not installed (`rustup target add {TARGET}`)");
        return Ok(Outcome::Skipped(why));
    }
    web::run(false)?;
    web::drive()?;
    Ok(Outcome::Passed)
}
