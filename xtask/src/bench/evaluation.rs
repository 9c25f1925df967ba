//! Speed of evaluators and generated code beside peers: the package `bench`.

use crate::{cargo, path, target};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;
use std::process::Stdio;

/// Measures, prints the tables, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run.
pub fn run() -> Result<String> {
    let table = table(&measured(&[])?)?;
    println!("{table}");
    Ok(format!("{INTRODUCTION}{table}"))
}

const INTRODUCTION: &str = "\
The unit U is the time of six direct calls of the C library's `sincos` on angles in (-π, π), results stored, timed right\n\
before each entry. Figures are medians of the ratios to U over 25 rounds in which all entries take turns, and their\n\
quartiles; each time is the least of five runs. One thread unless the entry says otherwise. The pose is a UR5's, all sixteen\n\
entries of its matrix, link lengths as parameters. A limit is what the project demands of itself.\n\n\
Jacobian and pose are computed in one pass: 6 × 6 and 4 × 4 entries of a UR5, 6 × 7 and 4 × 4 of a Panda. For comparison,\n\
not measured in this run: Pinocchio 4.1 in C++ takes 315 and 339 ns for them on a core whose U is 72 ns: 4.4 and 4.7 U.\n\n\
The interpreters choose their instructions when they run; generated code is compiled for AVX2 (x86-64-v3) and for\n\
AVX-512 (x86-64-v4); everything else, the peers among it, for x86-64-v3.\n";

/// What the package `bench` prints.
pub fn measured(arguments: &[&str]) -> Result<Value> {
    let mut cargo = cargo();
    cargo.args(["run", "--release", "--quiet", "--manifest-path"]).arg(path("bench/Cargo.toml"));
    cargo.arg("--").args(arguments);
    cargo.env("CARGO_TARGET_DIR", target().join("bench")).stderr(Stdio::inherit());
    if cfg!(target_arch = "x86_64") {
        cargo.env("RUSTFLAGS", "-C target-cpu=x86-64-v3");
    }
    let output = cargo.output()?;
    if !output.status.success() {
        bail!("the benchmark failed");
    }
    // Peers may print, too: the last line is ours.
    let last = output.stdout.trim_ascii_end().rsplit(|b| *b == b'\n').next().unwrap_or_default();
    serde_json::from_slice(last).context("the benchmark prints JSON")
}

/// A table a group of what `bench` prints.
pub(super) fn table(measured: &Value) -> Result<String> {
    let figures = measured["figures"].as_array().context("a list of figures")?;
    let unit = measured["unit_ns"].as_f64().context("the unit")?;
    let mut text = format!("\nU = {unit:.1} ns.\n");
    let mut group = "";
    for figure in figures {
        let word = |key: &str| figure[key].as_str().unwrap_or_default();
        let number = |v: &Value| v.as_f64().unwrap_or(f64::NAN);
        if word("group") != group {
            group = figure["group"].as_str().unwrap_or_default();
            let _ = write!(text, "\n| {group} | U | quartiles | ns | limit |\n|---|---:|---:|---:|---:|\n");
        }
        let (ratio, ns) = (number(&figure["ratio"]), number(&figure["ns"]));
        let digits = if ratio < 10.0 { 3 } else { 0 };
        let limit = figure["limit"].as_f64();
        let verdict =
            limit.map_or(String::new(), |l| format!("{l}{}", if ratio > l { " **missed**" } else { "" }));
        let _ = writeln!(
            text,
            "| {} | {ratio:.digits$} | {:.digits$} – {:.digits$} | {ns:.1} | {verdict} |",
            word("name"),
            number(&figure["quartiles"][0]),
            number(&figure["quartiles"][1]),
        );
    }
    Ok(text)
}
