//! CPU time of a report of every robot of the catalogue: as a page of HTML, and as a PDF by Typst.
//!
//! Measured: from the text of the robot file to the bytes of the page; for PDF the time of the Typst package behind it. The
//! reference in the same run: the formulas alone (forward model, inverse model, singularities), which the report derives, too.

use super::MISSED;
use super::derivation::times;
use crate::languages::python;
use crate::{command, path, robot};
use anyhow::{Context, Result, bail};
use denavit::catalogue;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::inverse::{InverseModel, Options};
use denavit::velocity::Singularities;
use denavit_report::{render, report};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::hint::black_box;

/// Measurements a figure.
const REPEATS: usize = 3;
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
    name: &'static str,
    formulas: f64,
    page: f64,
    pdf: f64,
}

/// Measures, prints the table, and gives the section of the page.
///
/// # Errors
/// If a robot of the catalogue cannot be read, or there is no Typst.
pub fn run() -> Result<String> {
    let folder = path("target/bench-report");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let median = |name: &'static str, work: fn(&str) -> Result<bool>| -> Result<f64> {
        Ok(times(name, REPEATS, work)?.context("never refused")?.median)
    };
    let mut rows = vec![];
    for name in catalogue::names() {
        let (formulas, page) = (median(name, formulas)?, median(name, page)?);
        let markup = render::typst(&report(&robot(name)?, &denavit_report::Options::default()));
        fs::write(folder.join(format!("{name}.typ")), markup)?;
        rows.push(Row { name, formulas, page, pdf: f64::NAN });
    }
    let python = python(&["typst"])?;
    let output = command(python).args(["-c", COMPILE]).arg(&folder).output()?;
    if !output.status.success() {
        bail!("Typst: {}", String::from_utf8_lossy(&output.stderr));
    }
    let text = String::from_utf8(output.stdout)?;
    let behind: BTreeMap<&str, f64> = text
        .lines()
        .filter_map(|l| {
            let (name, time) = l.split_once(' ')?;
            Some((name, time.parse().ok()?))
        })
        .collect();
    for row in &mut rows {
        row.pdf = row.page + behind.get(row.name).context(row.name)?;
    }
    rows.sort_by(|a, b| b.pdf.total_cmp(&a.pdf));
    let section = section(&rows);
    println!("{section}");
    Ok(section)
}

fn formulas(name: &str) -> Result<bool> {
    let description = robot(name)?;
    black_box(ForwardModel::of_tool(&description, Outputs::ALL));
    // A refusal is an answer, too.
    let _ = black_box(InverseModel::derive(&description, &Options::default()));
    let _ = black_box(Singularities::derive(&description, Reference::Tool));
    Ok(true)
}

fn page(name: &str) -> Result<bool> {
    let document = report(&robot(name)?, &denavit_report::Options::default());
    black_box(render::html(&document));
    Ok(true)
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
