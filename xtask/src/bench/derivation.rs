//! CPU time of deriving the models of every robot of the catalogue: the package `bench` with the argument `derivation`;
//! beside it SymPy's `trigsimp` of the twelve entries for two robots.

use super::evaluation::measured;
use super::{closed_form, inverse};
use crate::{command, path, succeed};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;
use std::process::Command;

/// What a derivation may take, ms.
const BOUND: f64 = 50.0;
/// Robots for which SymPy is asked as well.
const WITH_SYMPY: &[&str] = &["staubli-rx90", "puma560"];
const SYMPY: &str = "1.14.0";

/// Median, least and largest of some times in ms.
pub struct Times {
    pub median: f64,
    least: f64,
    largest: f64,
}

impl Times {
    /// As they are measured; `None` if the work was refused.
    pub fn read(value: &Value) -> Option<Self> {
        let figure = |key: &str| value[key].as_f64();
        Some(Times { median: figure("median")?, least: figure("least")?, largest: figure("largest")? })
    }
}

struct Row<'a> {
    name: &'a str,
    ours: Times,
    /// `None` if the expansion is refused as too large.
    naive: Option<Times>,
    /// Seconds.
    sympy: Option<f64>,
}

/// Measures, prints the table, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run.
pub fn run() -> Result<String> {
    let python = python();
    if let Err(e) = &python {
        println!("no SymPy, so no ratio to it: {e:#}");
    }
    inverse::cmake()?;
    let measured = measured(&["derivation"])?;
    let robots = measured["robots"].as_array().context("a list of robots")?;
    let mut rows = vec![];
    for robot in robots {
        let name = robot["name"].as_str().context("a name")?;
        let sympy = match &python {
            Ok(program) if WITH_SYMPY.contains(&name) => Some(trigsimp(program, name)?),
            _ => None,
        };
        let ours = Times::read(&robot["forward"]).context("times")?;
        rows.push(Row { name, ours, naive: Times::read(&robot["naive"]), sympy });
    }
    let table = table(&rows);
    println!("{table}\n{}", verdict(&rows));
    let inverse = closed_form::section(robots)?;
    println!("{inverse}");
    Ok(format!("{}\n{inverse}", section(&rows, &table, &measured["repeats"][0])))
}

/// A Python with SymPy: the project's environment, the system's, or an environment made for it.
fn python() -> Result<String> {
    let own = path(".venv/bin/python").display().to_string();
    let check = format!("import sympy, tomllib; assert sympy.__version__ == '{SYMPY}'");
    let has_sympy =
        |python: &str| command(python).args(["-c", &check]).output().is_ok_and(|o| o.status.success());
    if let Some(python) = [own.as_str(), "python3"].into_iter().find(|p| has_sympy(p)) {
        return Ok(python.to_string());
    }
    succeed(command("python3").args(["-m", "venv", ".venv"]))?;
    succeed(Command::new(&own).args(["-m", "pip", "install", "--quiet", &format!("sympy=={SYMPY}")]))?;
    Ok(own)
}

/// CPU seconds of SymPy's product of the rows and `trigsimp` of its twelve entries.
fn trigsimp(python: &str, name: &str) -> Result<f64> {
    const SCRIPT: &str = "
import pathlib, sys, time
sys.path.insert(0, 'crates/robot/tests/peers')
sys.dont_write_bytecode = True
import sympy, sympy_counts
start = time.process_time()
for entry in sympy_counts.product(pathlib.Path(sys.argv[1])):
    sympy.trigsimp(entry)
print(time.process_time() - start)
";
    let file = format!("crates/robot/catalogue/{name}.toml");
    let output = command(python).args(["-c", SCRIPT, &file]).output()?;
    if !output.status.success() {
        bail!("SymPy on {name}: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(String::from_utf8(output.stdout)?.trim().parse()?)
}

fn table(rows: &[Row]) -> String {
    let width = rows.iter().map(|r| r.name.len()).max().unwrap_or(0);
    let mut out = String::new();
    let mut line = |cells: [&str; 6]| {
        let [name, median, spread, naive, share, sympy] = cells;
        let _ = writeln!(
            out,
            "| {name:<width$} | {median:>7} | {spread:>15} | {naive:>8} | {share:>6} | {sympy:>18} |"
        );
    };
    line(["robot", "CPU ms", "least – largest", "naive ms", "share", "SymPy s (ratio)"]);
    line([&"-".repeat(width), "------:", "--------------:", "-------:", "-----:", "-----------------:"]);
    for row in rows {
        let naive = row.naive.as_ref().map(|t| t.median);
        line([
            row.name,
            &format!("{:.2}", row.ours.median),
            &format!("{:.2} – {:.2}", row.ours.least, row.ours.largest),
            &naive.map_or("refused".into(), |ms| format!("{ms:.2}")),
            &naive.map_or(String::new(), |ms| format!("{:.0} %", 100.0 * ms / row.ours.median)),
            &row.sympy.map_or(String::new(), |s| format!("{s:.1} ({:.0})", s * 1e3 / row.ours.median)),
        ]);
    }
    out
}

fn verdict(rows: &[Row]) -> String {
    let Some(slowest) = rows.iter().max_by(|a, b| a.ours.median.total_cmp(&b.ours.median)) else {
        return "the catalogue is empty".into();
    };
    let above = rows.iter().filter(|r| r.ours.median > BOUND).count();
    format!(
        "{} robots; the slowest is {} with {:.1} ms; {} above the bound of {BOUND} ms.",
        rows.len(),
        slowest.name,
        slowest.ours.median,
        if above == 0 { "none".into() } else { above.to_string() }
    )
}

fn section(rows: &[Row], table: &str, repeats: &Value) -> String {
    format!(
        "CPU time of deriving the forward model of each robot of the catalogue: reading the robot file, the link\n\
         transforms, the simplified matrix, the search for the shortest algorithm, and the proof that it equals the\n\
         product. Median of {repeats} runs, each in a fresh thread that knows no formula yet; release build, one thread.\n\n\
         - **naive**: only the normal form of the same product over single joint angles; no merging of parallel axes, no\n\
         readable form, no search, no proof. What the rest costs is the difference; the share is naive to ours.\n\
         - **SymPy**: the product and `trigsimp` of its twelve entries (version {SYMPY}), CPU time, once; the ratio is SymPy to ours.\n\n\
         {}\n\n{table}",
        verdict(rows),
    )
}
