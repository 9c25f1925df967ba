//! Speed of evaluators and generated code beside peers: the package `bench`, built for each level of instructions.

use crate::{cargo, path};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;

/// Measures on every level that this processor has, prints the tables, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run.
pub fn run() -> Result<String> {
    let mut text = String::from(INTRODUCTION);
    for level in levels() {
        let measured = measure(level)?;
        let table = table(level, &measured)?;
        println!("{table}");
        text += &table;
    }
    Ok(text)
}

const INTRODUCTION: &str = "\
The unit U is the time of six direct calls of the C library's `sincos` on angles in (-π, π), results stored, timed right\n\
before each entry. Figures are medians of the ratios to U over 25 rounds in which all entries take turns, and their\n\
quartiles; each time is the least of five runs. One thread unless the entry says otherwise. The pose is a UR5's, all sixteen\n\
entries of its matrix, link lengths as parameters. A limit is what the project demands of itself.\n\n\
The whole benchmark is compiled twice, for AVX2 (x86-64-v3) and for AVX-512 (x86-64-v4), the peers with it; the\n\
interpreters choose their instructions when they run, and show all they find.\n";

/// Levels of x86-64 that the processor has; the generated code and the peers are compiled for them.
fn levels() -> Vec<&'static str> {
    let mut levels = vec![];
    #[cfg(target_arch = "x86_64")]
    {
        if std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma") {
            levels.push("x86-64-v3");
        }
        if std::is_x86_feature_detected!("avx512f") && std::is_x86_feature_detected!("avx512vl") {
            levels.push("x86-64-v4");
        }
    }
    if levels.is_empty() {
        levels.push("native");
    }
    levels
}

fn measure(level: &str) -> Result<Value> {
    let output = cargo()
        .args(["run", "--release", "--quiet", "--manifest-path"])
        .arg(path("bench/Cargo.toml"))
        .env("CARGO_TARGET_DIR", path(&format!("target/bench-{level}")))
        .env("RUSTFLAGS", format!("-C target-cpu={level}"))
        .env("DENAVIT_BENCH_LEVEL", level)
        .stderr(std::process::Stdio::inherit())
        .output()?;
    if !output.status.success() {
        bail!("the benchmark for {level} failed");
    }
    serde_json::from_slice(&output.stdout).context("the benchmark prints JSON")
}

fn table(level: &str, measured: &Value) -> Result<String> {
    let figures = measured["figures"].as_array().context("a list of figures")?;
    let unit = measured["unit_ns"].as_f64().context("the unit")?;
    let mut text = format!("\n### Compiled for {level}\n\nU = {unit:.1} ns.\n");
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
