//! CPU time from the start of the program to all solutions of one pose: the program itself, built as it is handed out.

use super::MISSED;
use crate::{cargo, command, path, succeed, target};
use anyhow::{Context, Result, ensure};
use std::fmt::Write;

/// Runs of each; the least counts.
const RUNS: usize = 7;
/// What a first answer may take, ms.
const BOUND: f64 = 100.0;
/// Arms: of the catalogue, and of ordinary life (calibrated, out of a URDF) among the cases of the tests.
const ARMS: &[(&str, usize)] = &[
    ("puma560", 6),
    ("ur5", 6),
    ("fanuc-crx10ia-l", 6),
    ("ur5cal.toml", 6),
    ("so101.toml", 5),
    ("kuka-iiwa-14", 7),
    ("franka-panda", 7),
    ("kinova-gen3", 7),
    ("rethink-sawyer", 7),
    ("rethink-baxter-left", 7),
    ("iiwa14urdf.toml", 7),
    ("gen3_7.toml", 7),
    ("anthropomorphic-8r", 8),
    ("tiago.toml", 8),
];
const INTRODUCTION: &str = "\
`denavit ik ARM -q …`: CPU time of the whole process, the least of @runs@ runs, of the program as it is handed out (`--profile dist`).
What is asked is one pose of each arm, all solutions or families. Beside it the time of `denavit --version`, which is the start alone, and the ratio to that of `ik puma560`.

| | CPU, ms | of puma560 | limit |
|---|---:|---:|---:|
";

/// Measures, prints the table, and gives the section of the page.
///
/// # Errors
/// If the program does not build or answer.
pub fn run() -> Result<String> {
    succeed(cargo().args(["build", "--quiet", "--locked", "--profile", "dist", "--package", "denavit-cli"]))?;
    let program = target().join("dist/denavit");
    let program = program.to_string_lossy();
    let mut rows = vec![("`--version`".to_string(), cpu(&program, "--version")?, false)];
    for &(arm, joints) in ARMS {
        let q: Vec<String> = (0..joints).map(|j| format!("{:.2}", 0.1 + 0.13 * j as f64)).collect();
        let file = if arm.ends_with(".toml") {
            path(&format!("crates/robot/tests/cases/{arm}")).to_string_lossy().into_owned()
        } else {
            arm.into()
        };
        let words = format!("ik '{file}' -q {}", q.join(","));
        rows.push((arm.trim_end_matches(".toml").into(), cpu(&program, &words)?, true));
    }
    let unit = rows.iter().find(|r| r.0 == "puma560").map_or(f64::NAN, |r| r.1);
    let mut text = INTRODUCTION.replace("@runs@", &RUNS.to_string());
    for (name, time, is_bounded) in rows {
        let limit = match (is_bounded, time <= BOUND) {
            (false, _) => String::new(),
            (true, true) => format!("{BOUND:.0}"),
            (true, false) => format!("{BOUND:.0} {MISSED}"),
        };
        writeln!(text, "| {name} | {time:.0} | {:.2} | {limit} |", time / unit)?;
    }
    println!("{text}");
    Ok(text)
}

/// The least CPU time of a call, ms: what the shell says of its children.
fn cpu(program: &str, words: &str) -> Result<f64> {
    let script = format!("TIMEFORMAT='%3U %3S'; time '{program}' {words} > /dev/null 2>&1");
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let output = command("bash").args(["-c", &script]).output().context("bash")?;
        ensure!(output.status.success(), "denavit {words} fails");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let times: Vec<f64> = told.split_whitespace().filter_map(|x| x.parse().ok()).collect();
        ensure!(times.len() == 2, "bash says of its time: {told}");
        least = least.min(1e3 * times.iter().sum::<f64>());
    }
    Ok(least)
}
