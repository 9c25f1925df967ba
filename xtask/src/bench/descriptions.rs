//! CPU time of reading a URDF of a hundred links: the package `bench` with the argument `descriptions`.

use super::derivation::Times;
use super::evaluation::measured;
use super::{MISSED, inverse};
use anyhow::{Context, Result};
use std::fmt::Write;

/// What reading may take, ms.
const BOUND: f64 = 20.0;
const INTRODUCTION: &str = "\
CPU time of reading a URDF of a hundred links, each with inertia, limits and meshes: from the text to the tree with all that\n\
is to be said of it (read), and on to the table of the chain to the last link with its proof (table); beside it the crate\n\
`urdf-rs`, which gives the elements of the same text. Release build, one thread, medians of fresh threads.\n\n";

/// Measures, prints the table, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run.
pub fn run() -> Result<String> {
    inverse::cmake()?;
    let measured = measured(&["descriptions"])?;
    let mut table = String::from(
        "| file | joints that move | kB | read, ms | limit, ms | urdf-rs, ms | ratio | table, ms |\n\
         | ---- | ---------------: | -: | -------: | --------: | ----------: | ----: | --------: |\n",
    );
    for file in measured["files"].as_array().context("a list of files")? {
        let time = |key: &str| Times::read(&file[key]).context("times").map(|t| t.median);
        let (read, peer) = (time("read")?, time("urdf-rs")?);
        let _ = writeln!(
            table,
            "| {} | {} | {:.0} | {read:.2}{} | {BOUND} | {peer:.2} | {:.2} | {:.2} |",
            file["name"].as_str().context("a name")?,
            file["moving"],
            file["bytes"].as_f64().context("a size")? / 1e3,
            if read > BOUND { format!(" {MISSED}") } else { String::new() },
            read / peer,
            time("table")?,
        );
    }
    println!("{table}");
    Ok(format!("{INTRODUCTION}{table}"))
}
