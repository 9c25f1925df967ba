//! What takes too long for a test: fuzzing of the readers, inverse models on very many poses, Miri.

use crate::{command, path, python, succeed};
use anyhow::{Context, Result, bail};
use std::fs;
use std::process::{Command, Stdio};

/// A target and the folder with texts to start from.
const TARGETS: &[(&str, &str)] = &[
    ("formula", "fuzz/seeds/formula"),
    ("robot_file", "crates/robot/catalogue"),
    ("parallel", "crates/parallel/catalogue"),
    ("table", "fuzz/seeds/table"),
    ("par", "fuzz/seeds/par"),
    ("urdf", "crates/robot/tests/urdf"),
    ("xacro", "fuzz/seeds/xacro"),
    ("mjcf", "crates/robot/tests/mjcf"),
    ("document", "examples/documents"),
];
/// The soaks that are not fuzz targets: tests at their full size, and arms at random.
const SUITES: &str = "suites";
const ATTACK: &str = "attack";
const CLUSTERS: &str = "clusters";
/// Longest input in bytes.
const MAX_BYTES: u32 = 4096;
/// Seconds after which one input counts as a hang (the build is unoptimised for speed and instrumented).
const TIMEOUT: u32 = 20;
/// Memory in MiB.
const MEMORY: u32 = 2048;

/// Runs the targets named, or all of them, `seconds` each.
///
/// # Errors
/// If a target crashes (the input is left under `fuzz/artifacts`), or the tools are not there.
pub fn run(seconds: u32, wanted: &[&str]) -> Result<()> {
    let is_known = |w: &str| [SUITES, ATTACK, CLUSTERS].contains(&w) || TARGETS.iter().any(|t| t.0 == w);
    if let Some(unknown) = wanted.iter().find(|w| !is_known(w)) {
        let known: Vec<&str> = TARGETS.iter().map(|t| t.0).chain([SUITES, ATTACK, CLUSTERS]).collect();
        bail!("no fuzz target `{unknown}`; there are {}", known.join(", "));
    }
    if wanted.is_empty() || wanted.contains(&SUITES) {
        suites()?;
    }
    if wanted.is_empty() || wanted.contains(&ATTACK) {
        attack()?;
    }
    if wanted.is_empty() || wanted.contains(&CLUSTERS) {
        println!("\n━━ {CLUSTERS} ━━");
        python::clusters()?;
    }
    if !wanted.is_empty() && wanted.iter().all(|w| [SUITES, ATTACK, CLUSTERS].contains(w)) {
        return Ok(());
    }
    install()?;
    let mut crashed = vec![];
    for (target, seeds) in TARGETS.iter().filter(|t| wanted.is_empty() || wanted.contains(&t.0)) {
        println!("\n━━ {target}, {seconds} s ━━");
        let corpus = path(&format!("fuzz/corpus/{target}"));
        fs::create_dir_all(&corpus)?;
        let result = succeed(fuzz().args(["run", target]).arg(&corpus).arg(path(seeds)).arg("--").args([
            format!("-max_total_time={seconds}"),
            format!("-max_len={MAX_BYTES}"),
            format!("-timeout={TIMEOUT}"),
            format!("-rss_limit_mb={MEMORY}"),
            "-print_final_stats=1".into(),
        ]));
        if let Err(e) = result {
            eprintln!("{target}: {e:#}");
            crashed.push(*target);
        }
    }
    if !crashed.is_empty() {
        bail!("failed: {}; inputs are under fuzz/artifacts", crashed.join(", "));
    }
    Ok(())
}

/// The tests of inverse kinematics in full: 100,000 random configurations for each closed form, the whole grid of special
/// ones, a million for each arm by elimination, singular poses by thousands; hours.
fn suites() -> Result<()> {
    println!("\n━━ {SUITES} ━━");
    let soaks: [(&str, &[&str]); 10] = [
        (
            "denavit",
            &["coupled::", "inverse::", "singular::", "redundant::", "numeric::", "motion_jerk_torques::"],
        ),
        // Ten thousand derivations, each in a store of its own.
        ("denavit", &["scope::", "--include-ignored"]),
        ("denavit-elimination", &[]),
        // A thousand Stewart platforms, deltas and planar robots by the hundred thousand.
        ("denavit-parallel", &[]),
        // Files with IKFast's interface, at a hundred thousand poses each; generated code beside the library, at fifteen thousand.
        ("denavit-generate", &["ikfast::", "conformance::"]),
        // Documents that nobody should write; those that take minutes each are in no other test.
        ("denavit-check", &["hostile::", "--include-ignored"]),
        // A thousand sheets of each kind of exercises, marked.
        ("denavit-report", &["exercise_marks::"]),
        // Thousands of recordings with slips, alone and in pairs, and without any.
        ("denavit-recording", &[]),
        // A hundred arms, calibrated: how many parameters are within their deviations.
        ("denavit-calibration", &[]),
        // How many parameters are within their deviations, over hundreds of recordings.
        ("denavit-identification", &[]),
    ];
    for (package, tests) in soaks {
        let mut cargo = command("cargo");
        cargo.args(["test", "--release", "--no-fail-fast", "-p", package, "--test", "suite", "--"]);
        succeed(cargo.args(tests).arg("--nocapture").env("DENAVIT_SOAK", "1"))?;
    }
    Ok(())
}

/// Arms at random with everything that a robot file allows, each at many poses, and the code that is generated for some:
/// more than an hour.
fn attack() -> Result<()> {
    println!("\n━━ {ATTACK} ━━");
    for package in ["denavit-generate", "denavit"] {
        let mut cargo = command("cargo");
        cargo.args(["test", "--release", "-p", package, "--test", "suite", "--", "attack::", "--nocapture"]);
        succeed(cargo.env("DENAVIT_SOAK", "1"))?;
    }
    Ok(())
}

/// `cargo fuzz` of the nightly toolchain, which the instrumentation needs.
fn fuzz() -> Command {
    let mut command = command("rustup");
    command.args(["run", "nightly", "cargo", "fuzz"]);
    for inherited in ["CARGO", "RUSTC", "RUSTDOC"] {
        command.env_remove(inherited);
    }
    command
}

fn install() -> Result<()> {
    let answers =
        |c: &mut Command| c.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success());
    if !answers(command("rustup").args(["run", "nightly", "rustc", "--version"])) {
        bail!("fuzzing needs the nightly toolchain: `rustup toolchain install nightly --profile minimal`");
    }
    if !answers(fuzz().arg("--version")) {
        succeed(command("rustup").args(["run", "stable", "cargo", "install", "cargo-fuzz", "--locked"]))
            .context("cargo-fuzz is not installed")?;
    }
    Ok(())
}

/// The evaluators under Miri, which finds undefined behaviour in unsafe code; about half an hour.
///
/// # Errors
/// If it finds some, or the nightly toolchain has no Miri and cannot get it.
pub fn miri() -> Result<()> {
    let rustup = |arguments: &[&str]| {
        let mut command = command("rustup");
        command.args(arguments).env("MIRIFLAGS", "-Zmiri-deterministic-floats");
        for inherited in ["CARGO", "RUSTC", "RUSTDOC"] {
            command.env_remove(inherited);
        }
        succeed(&mut command)
    };
    rustup(&["component", "add", "--toolchain", "nightly", "miri", "rust-src"])?;
    let suite = ["-p", "denavit-program", "--test", "suite", "conformance::"];
    rustup(&[&["run", "nightly", "cargo", "miri", "test"], &suite[..]].concat())
}
