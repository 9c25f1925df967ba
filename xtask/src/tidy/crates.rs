//! Which crate may use which others: the arrows between the project's packages.

use super::Report;
use crate::{cargo, path};
use anyhow::{Result, bail};
use serde_json::Value;
use std::fs;

const SYMBOLIC: &str = "denavit-symbolic";
const READING: &str = "denavit-reading";
const PROGRAM: &str = "denavit-program";
const EMIT: &str = "denavit-emit";
const ELIMINATION: &str = "denavit-elimination";
const ROBOT: &str = "denavit";
const PARALLEL: &str = "denavit-parallel";
const CHECK: &str = "denavit-check";
const CERTIFICATE: &str = "denavit-certificate";
const GENERATE: &str = "denavit-generate";
const RECORDING: &str = "denavit-recording";
const MAP: &str = "denavit-map";
const IDENTIFICATION: &str = "denavit-identification";
const CALIBRATION: &str = "denavit-calibration";
const TABLES: &str = "denavit-tables";
const REPORT: &str = "denavit-report";
const WIRE: &str = "denavit-wire";
const LOAD: &str = "denavit-load";
const JIT: &str = "denavit-jit";

/// What a crate builds on, whatever it is for: none is a door, none is left of another without being named.
const BELOW_DOORS: &[&str] = &[
    SYMBOLIC,
    READING,
    PROGRAM,
    EMIT,
    ELIMINATION,
    ROBOT,
    PARALLEL,
    CHECK,
    CERTIFICATE,
    GENERATE,
    RECORDING,
    IDENTIFICATION,
    CALIBRATION,
    TABLES,
    REPORT,
    WIRE,
    LOAD,
    MAP,
];

/// Folders and packages, and the project's packages that each may use; tests may use more.
const ALLOWED: &[(&str, &str, &[&str])] = &[
    ("crates/symbolic", SYMBOLIC, &[]),
    ("crates/reading", READING, &[SYMBOLIC]),
    ("crates/program", PROGRAM, &[SYMBOLIC]),
    ("crates/emit", EMIT, &[SYMBOLIC, PROGRAM]),
    ("crates/elimination", ELIMINATION, &[]),
    ("crates/jit", JIT, &[SYMBOLIC, PROGRAM]),
    ("crates/robot", ROBOT, &[SYMBOLIC, PROGRAM, ELIMINATION]),
    ("crates/parallel", PARALLEL, &[ROBOT]),
    ("crates/check", CHECK, &[SYMBOLIC, READING, PROGRAM, ROBOT]),
    ("crates/certificate", CERTIFICATE, &[SYMBOLIC, PROGRAM, ROBOT, CHECK]),
    ("crates/generate", GENERATE, &[SYMBOLIC, PROGRAM, EMIT, ELIMINATION, ROBOT]),
    ("crates/recording", RECORDING, &[SYMBOLIC, ROBOT]),
    ("crates/identification", IDENTIFICATION, &[SYMBOLIC, ROBOT, RECORDING]),
    ("crates/calibration", CALIBRATION, &[SYMBOLIC, ROBOT, RECORDING]),
    ("crates/tables", TABLES, &[]),
    ("crates/report", REPORT, &[SYMBOLIC, READING, PROGRAM, ROBOT, CHECK]),
    (
        "crates/wire",
        WIRE,
        &[
            SYMBOLIC,
            READING,
            PROGRAM,
            EMIT,
            ROBOT,
            PARALLEL,
            CHECK,
            GENERATE,
            RECORDING,
            CALIBRATION,
            IDENTIFICATION,
            REPORT,
        ],
    ),
    ("crates/load", LOAD, &[SYMBOLIC, READING, ROBOT, PARALLEL]),
    ("crates/map", MAP, &[SYMBOLIC, PROGRAM, ROBOT, WIRE]),
    ("crates/cli", "denavit-cli", BELOW_DOORS),
    ("crates/web", "denavit-web", BELOW_DOORS),
    (
        "crates/python",
        "denavit-python",
        &[
            SYMBOLIC,
            READING,
            PROGRAM,
            EMIT,
            ELIMINATION,
            ROBOT,
            PARALLEL,
            CHECK,
            CERTIFICATE,
            GENERATE,
            RECORDING,
            CALIBRATION,
            IDENTIFICATION,
            TABLES,
            REPORT,
            WIRE,
            LOAD,
            JIT,
            MAP,
        ],
    ),
    ("crates/ffi", "denavit-ffi", BELOW_DOORS),
    // It runs the program.
    ("xtask", "xtask", &[]),
];

/// No package uses one that it may not.
///
/// # Errors
/// If cargo does not say who uses whom.
pub fn layers(report: &mut Report) -> Result<()> {
    let output = cargo().args(["metadata", "--format-version", "1", "--no-deps"]).output()?;
    if !output.status.success() {
        bail!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let known = |name: &Value| ALLOWED.iter().find(|a| Some(a.1) == name.as_str());
    for package in metadata["packages"].as_array().into_iter().flatten() {
        let Some((folder, own, allowed)) = known(&package["name"]) else {
            let name = package["name"].as_str().unwrap_or_default();
            report.add("Cargo.toml", 1, format!("`{name}` has no place among the crates (tidy's `ALLOWED`)"));
            continue;
        };
        let manifest = format!("{folder}/Cargo.toml");
        let text = fs::read_to_string(path(&manifest))?;
        for dependency in package["dependencies"].as_array().into_iter().flatten() {
            let Some((_, name, _)) = known(&dependency["name"]) else { continue };
            if dependency["kind"].as_str() != Some("dev") && !allowed.contains(name) {
                let line = text.lines().position(|l| l.starts_with(name)).map_or(1, |i| i + 1);
                report.add(&manifest, line, format!("{own} uses {name}, which it may not"));
            }
        }
    }
    Ok(())
}
