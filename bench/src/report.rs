//! CPU time of a report of every robot of the catalogue, from the text of the robot file to the bytes of the page of HTML. The
//! reference of the same run: the formulas alone (forward model, inverse model, singularities), which the report derives, too.

use crate::measure::processor_times;
use crate::read;
use anyhow::{Context, Result};
use denavit::catalogue;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::inverse::{self, InverseModel};
use denavit::velocity::Singularities;
use denavit_report::{ReportOptions, render, report};
use serde_json::json;
use std::fs;
use std::hint::black_box;
use std::path::Path;

/// Measurements a figure.
const REPEATS: usize = 3;

/// Measures, and writes the documents for Typst into a folder that is there; prints one JSON object.
///
/// # Errors
/// If a robot of the catalogue cannot be read, or a document cannot be written.
pub fn run(folder: &Path) -> Result<()> {
    let mut robots = vec![];
    for name in catalogue::names() {
        let median = |work| processor_times(name, REPEATS, work)?.context("never refused").map(|t| t.median);
        robots.push(json!({"name": name, "formulas": median(formulas)?, "page": median(page)?}));
        let markup = render::typst(&report(&read(name)?, &ReportOptions::default()));
        fs::write(folder.join(format!("{name}.typ")), markup)?;
    }
    println!("{}", json!({"robots": robots}));
    Ok(())
}

fn formulas(name: &str) -> Result<bool> {
    let description = read(name)?;
    black_box(ForwardModel::of_tool(&description, Outputs::ALL));
    // A refusal is an answer, too.
    let _ = black_box(InverseModel::derive(&description, &inverse::InverseOptions::default()));
    let _ = black_box(Singularities::derive(&description, Reference::Tool));
    Ok(true)
}

fn page(name: &str) -> Result<bool> {
    black_box(render::html(&report(&read(name)?, &ReportOptions::default())));
    Ok(true)
}
