//! The Python package beside the library itself and other packages: `bench/python/bench.py`, both as they are handed out.

use super::MISSED;
use crate::languages::python as environment;
use crate::python::assembled;
use crate::{cargo, command, scratch, succeed, target};
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::fmt::Write;
use std::process::Command;

/// What the script compares with.
const PACKAGES: &[&str] = &["numpy", "pin", "roboticstoolbox-python", "EAIK", "ssik", "ikpy"];
/// What many rows may take from Python, by what they take in the library.
const RATIO: f64 = 1.2;
/// What one call may take above the program itself, and the import beyond NumPy's, seconds.
const CALL: f64 = 2e-6;
const IMPORT: f64 = 0.05;
const INTRODUCTION: &str = "\
A UR5 from Python, best of five rounds; `library` is the same work in Rust on the same memory layout (`crates/python/examples/beside.rs`), in the same
run. Peers are held to the same poses and, for all solutions, to their number (the part of 200 poses where it is the same stands beside). What is not said to
use all cores uses one.

";

/// Measures, prints the tables, and gives the section of the page.
///
/// # Errors
/// If something does not build, run, or agree.
pub fn run() -> Result<String> {
    let package = ["--package", "denavit-python"];
    let build = ["build", "--quiet", "--locked", "--profile", "dist"];
    succeed(cargo().args(build).args(package).arg("--lib"))?;
    succeed(cargo().args(build).args(package).args(["--example", "beside"]))?;
    let python = environment(PACKAGES)?;
    let folder = assembled("dist", &scratch()?.join("python"))?;
    let library = printed(&mut command(target().join("dist/examples/beside")))?;
    let all = printed(command(&python).arg("bench/python/bench.py").env("PYTHONPATH", folder))?;
    let number = |of: &Value, key: &str| of[key].as_f64().with_context(|| format!("no `{key}`"));
    let own = &all["denavit"];
    let mut text = INTRODUCTION.to_string();
    text += "| | Python, µs | library, µs | limit |\n|---|---:|---:|---:|\n";
    let limit = |is_met: bool, words: String| if is_met { words } else { format!("{words} {MISSED}") };
    let single = number(&library, "fk_single")?;
    for (title, key) in [
        ("`fk` of one array", "fk_single"),
        ("`fk` of one list", "fk_list"),
        ("`compile(\"fk\")` of one array", "fk_compiled"),
    ] {
        let time = number(own, key)?;
        let limit = limit(time - single <= CALL, format!("{:.0} above", 1e6 * CALL));
        writeln!(text, "| {title} | {:.2} | {:.2} | {limit} |", 1e6 * time, 1e6 * single)?;
    }
    for (title, key) in [
        ("a row of `fk` of 10⁶", "fk_one_core"),
        ("the same on all cores", "fk"),
        ("a pose of `ik_batch`", "ik_one_core"),
    ] {
        let (time, beside) = (number(own, key)?, number(&library, key)?);
        let limit = limit(time <= RATIO * beside, format!("× {RATIO}"));
        writeln!(text, "| {title} | {:.3} | {:.3} | {limit} |", 1e6 * time, 1e6 * beside)?;
    }
    for (title, key) in
        [("`ik` of one pose", "ik_single"), ("a pose of `compile(\"ik\")`", "branches_one_core")]
    {
        writeln!(text, "| {title} | {:.2} | | |", 1e6 * number(own, key)?)?;
    }
    let import = number(own, "import")?;
    let limit = limit(import <= IMPORT, format!("{:.0} ms", 1e3 * IMPORT));
    writeln!(text, "| `import denavit` beyond NumPy | {:.0} | | {limit} |", 1e6 * import)?;
    text +=
        "\n| peer | version | one pose, µs | all solutions, µs | same number |\n|---|---|---:|---:|---:|\n";
    for (name, peer) in all["peers"].as_object().context("no peers")? {
        let micros = |key: &str| peer[key].as_f64().map_or(String::new(), |t| format!("{:.2}", 1e6 * t));
        let same =
            peer["same_counts"].as_f64().map_or(String::new(), |part| format!("{:.0} %", 100.0 * part));
        let version = peer["version"].as_str().unwrap_or_default();
        writeln!(
            text,
            "| {name} | {version} | {} | {} | {same} |",
            micros("fk_single"),
            micros("ik_single")
        )?;
    }
    println!("{text}");
    Ok(text)
}

/// The JSON object that a command prints.
fn printed(command: &mut Command) -> Result<Value> {
    let output = command.output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    serde_json::from_str(text.lines().last().unwrap_or_default()).context("no JSON")
}
