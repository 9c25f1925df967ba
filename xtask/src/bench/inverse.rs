//! Speed of inverse kinematics beside peers: the package `bench` with the argument `inverse`.

use super::evaluation::measured;
use crate::languages::apt;
use crate::starts;
use anyhow::{Context, Result};
use serde_json::Value;
use std::fmt::Write;

/// Measures, prints the tables, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run, or somebody's answers differ.
pub fn run() -> Result<String> {
    cmake()?;
    let measured = measured(&["inverse"])?;
    let mut text = INTRODUCTION.replace("@poses@", &measured["poses"].to_string());
    for arm in measured["arms"].as_array().context("a list of arms")? {
        text += &table(arm)?;
    }
    println!("{text}");
    Ok(text)
}

const INTRODUCTION: &str = "\
All solutions of @poses@ poses of random configurations, each with its residual, the same poses for everybody, on one core.\n\
The unit is the time of the crate `ik-geo` on the same poses, timed right before each entry; figures are medians of the\n\
ratios over 25 rounds in which all entries take turns, and their quartiles; each time is the least of five runs. Ours\n\
include the residual of every solution, which `ik-geo` does not compute; `rs-opw-kinematics` checks its own.\n\n\
Before anything is timed every answer is put into the forward model; answers that miss the pose by more than 1e-6 do not\n\
count. All must find the configuration that a pose was made from, and as many distinct solutions for each pose as the others.\n\n\
The interpreter chooses its instructions when it runs; generated code is compiled for AVX2 (x86-64-v3) and AVX-512\n\
(x86-64-v4), everything else, the peers among it, for x86-64-v3. Link lengths are parameters. Rows of a block are eight\n\
poses side by side.\n";

fn table(arm: &Value) -> Result<String> {
    let number = |v: &Value| v.as_f64().unwrap_or(f64::NAN);
    let mut text = format!("\n### {}\n\n", arm["title"].as_str().context("a title")?);
    let _ = writeln!(text, "`ik-geo`: {:.0} ns a pose.\n", number(&arm["unit_ns"]));
    text.push_str("| | of ik-geo | quartiles | ns a pose | solutions a pose | largest error | limit |\n");
    text.push_str("|---|---:|---:|---:|---:|---:|---:|\n");
    let (figures, checks) = (arm["figures"].as_array(), arm["checks"].as_array());
    for (f, c) in figures.context("figures")?.iter().zip(checks.context("checks")?) {
        let ratio = number(&f["ratio"]);
        let missed = |l: f64| if ratio > l { format!("{l} {}", super::MISSED) } else { l.to_string() };
        let _ = writeln!(
            text,
            "| {} | {ratio:.3} | {:.3} – {:.3} | {:.0} | {:.3} | {:.1e} | {} |",
            f["name"].as_str().unwrap_or_default(),
            number(&f["quartiles"][0]),
            number(&f["quartiles"][1]),
            number(&f["ns"]),
            number(&c["solutions"]),
            number(&c["worst"]),
            f["limit"].as_f64().map_or(String::new(), missed),
        );
    }
    Ok(text)
}

/// Installs CMake, which `ik-geo` needs, if it is missing.
///
/// # Errors
/// If it cannot be installed.
pub fn cmake() -> Result<()> {
    if starts("cmake") {
        return Ok(());
    }
    println!("installing cmake");
    apt(&["install", "-y", "-qq", "--no-install-recommends", "cmake"])
        .context("ik-geo is built with CMake: install it")
}
