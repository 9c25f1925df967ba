//! CPU time of a report of every robot of the catalogue: the package `bench` with the argument `report`; behind it the time of
//! the Typst package, which makes a PDF of it.

use super::evaluation::measured;
use super::{MISSED, inverse};
use crate::languages::python;
use crate::{command, path};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// What a page and a PDF may take, ms.
const BOUNDS: [f64; 2] = [2_000.0, 5_000.0];
/// Rows of the table: the slowest.
const SHOWN: usize = 8;
/// Compiles every document of a folder and prints the CPU time of each, ms.
const COMPILE: &str = "\
import pathlib, sys, time, typst
for path in sorted(pathlib.Path(sys.argv[1]).glob('*.typ')):
    start = time.process_time()
    typst.compile(str(path))
    print(path.stem, 1e3 * (time.process_time() - start))
";

struct Row {
    name: String,
    formulas: f64,
    page: f64,
    pdf: f64,
}

/// Measures, prints the table, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run, or there is no Typst.
pub fn run() -> Result<String> {
    inverse::cmake()?;
    let folder = path("target/bench-report");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let measured = measured(&["report", &folder.to_string_lossy()])?;
    let behind = compiled(&folder)?;
    let row = |robot: &Value| {
        let (name, page) = (robot["name"].as_str()?, robot["page"].as_f64()?);
        let pdf = page + behind.get(name)?;
        Some(Row { name: name.into(), formulas: robot["formulas"].as_f64()?, page, pdf })
    };
    let robots = measured["robots"].as_array().context("a list of robots")?;
    let mut rows = robots.iter().map(row).collect::<Option<Vec<Row>>>().context("figures of each robot")?;
    rows.sort_by(|a, b| b.pdf.total_cmp(&a.pdf));
    let section = section(&rows);
    println!("{section}");
    Ok(section)
}

/// What Typst takes for each document of a folder, CPU ms.
fn compiled(folder: &Path) -> Result<BTreeMap<String, f64>> {
    let python = python(&["typst"])?;
    let output = command(python).args(["-c", COMPILE]).arg(folder).output()?;
    if !output.status.success() {
        bail!("Typst: {}", String::from_utf8_lossy(&output.stderr));
    }
    let line = |l: &str| {
        let (name, time) = l.split_once(' ')?;
        Some((name.to_string(), time.parse().ok()?))
    };
    Ok(String::from_utf8(output.stdout)?.lines().filter_map(line).collect())
}

fn section(rows: &[Row]) -> String {
    let mean = |of: fn(&Row) -> f64| rows.iter().map(of).sum::<f64>() / rows.len() as f64;
    let most = |of: fn(&Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
    let verdict = |most: f64, bound: f64| if most <= bound { "met" } else { MISSED };
    let mut out = String::from(
        "A report with all its sections, CPU time; `formulas` is the forward model, the inverse model and the singularities alone, \
         the reference of the same run. The slowest:\n\n\
         | robot | formulas, ms | HTML, ms | ratio | PDF, ms |\n|---|--:|--:|--:|--:|\n",
    );
    for r in rows.iter().take(SHOWN) {
        let _ = writeln!(
            out,
            "| {} | {:.0} | {:.0} | {:.1} | {:.0} |",
            r.name,
            r.formulas,
            r.page,
            r.page / r.formulas,
            r.pdf
        );
    }
    let (page, pdf) = (most(|r| r.page), most(|r| r.pdf));
    let _ = writeln!(
        out,
        "\nAll {} robots: HTML {:.0} ms in the mean, {page:.0} ms at most (limit {:.0}: {}); PDF {:.0} ms in the mean, \
         {pdf:.0} ms at most (limit {:.0}: {}).",
        rows.len(),
        mean(|r| r.page),
        BOUNDS[0],
        verdict(page, BOUNDS[0]),
        mean(|r| r.pdf),
        BOUNDS[1],
        verdict(pdf, BOUNDS[1]),
    );
    out
}
