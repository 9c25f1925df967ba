//! Files of columns: `map --fk` beside reading and writing the same columns alone, by an example of `denavit-map`.

use super::MISSED;
use crate::cargo;
use anyhow::{Context, Result, ensure};
use serde_json::Value;

/// What of the speed of reading and writing alone is left at least.
const SHARE: f64 = 0.7;
/// MB of memory at most.
const MEMORY: f64 = 500.0;

/// Measures and gives the section of the page.
///
/// # Errors
/// If the example does not build or run.
pub fn run(is_quick: bool) -> Result<String> {
    let rows = if is_quick { "1000000" } else { "10000000" };
    let mut example = cargo();
    example.args([
        "run",
        "--quiet",
        "--profile",
        "dist",
        "-p",
        "denavit-map",
        "--example",
        "copy",
        "--",
        rows,
    ]);
    let output = example.output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr).trim());
    let found: Value = serde_json::from_slice(&output.stdout)?;
    let number = |key: &str| found[key].as_f64().with_context(|| key.to_string());
    let (share, memory) = (number("share")?, number("memory")?);
    let missed = |is_missed: bool| if is_missed { format!(" {MISSED}") } else { String::new() };
    let section = format!(
        "`denavit map ur5 --fk in.parquet -o out.parquet`: {:.0} million rows of six joints, positions and matrices behind them, {} \
         threads, Parquet with Snappy. Beside it the same file read and written with results that were computed before.\n\n\
         | | million rows/s | of reading and writing alone | memory |\n|---|---|---|---|\n\
         | reading and writing alone | {:.1} | 100 % | |\n\
         | `map --fk` | {:.1} | {:.0} % (at least {:.0} %){} | {memory:.0} MB (at most {MEMORY:.0} MB){} |\n",
        number("rows")? / 1e6,
        found["threads"],
        number("copy")?,
        number("map")?,
        100.0 * share,
        100.0 * SHARE,
        missed(share < SHARE),
        missed(memory > MEMORY),
    );
    println!("{section}");
    Ok(section)
}
