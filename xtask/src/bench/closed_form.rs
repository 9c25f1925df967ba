//! CPU time of deriving the inverse model of every robot of the catalogue, lengths as symbols and as numbers.

use super::MISSED;
use super::derivation::Times;
use anyhow::{Context, Result};
use serde_json::Value;
use std::fmt::Write;

/// What a derivation may take, ms: with symbols, with numbers.
const BOUNDS: [f64; 2] = [1000.0, 200.0];

struct Row<'a> {
    name: &'a str,
    symbols: Times,
    /// `None` if a length has no value.
    numbers: Option<Times>,
    /// The largest number of solutions and the joints that are given, or `None` if there is no closed form.
    found: Option<(u64, &'a str)>,
}

/// The text for the page, of robots as they were measured.
///
/// # Errors
/// If a figure is not there.
pub fn section(robots: &[Value]) -> Result<String> {
    let row = |robot| row(robot).context("a robot with its figures");
    let rows = robots.iter().map(row).collect::<Result<Vec<_>>>()?;
    Ok(format!("{INTRODUCTION}\n{}\n\n{}", verdict(&rows), table(&rows)))
}

fn row(robot: &Value) -> Option<Row<'_>> {
    let closed = &robot["closed"];
    Some(Row {
        name: robot["name"].as_str()?,
        symbols: Times::read(&robot["symbols"])?,
        numbers: Times::read(&robot["numbers"]),
        found: closed["solutions"].as_u64().zip(closed["given"].as_str()),
    })
}

const INTRODUCTION: &str = "\
### Inverse models\n\n\
CPU time of `InverseModel::derive`, from the robot file to the compiled solver: with the lengths as symbols, and with their\n\
numbers put in. Median of 3 runs, each in a fresh thread; release build, one thread. For an arm without a closed form it is\n\
the time of the refusal. Given are joints of an arm that has too many, as the derivation chooses them.\n\n\
For comparison, from the project's goals and not measured in this run: Robotics Toolbox 1.5 3 to 25 s (300 s for the worst),\n\
IKBT 16 to 143 s, IKFast minutes to hours.\n";

fn table(rows: &[Row]) -> String {
    let width = rows.iter().map(|r| r.name.len()).max().unwrap_or(0);
    let mut out = String::new();
    let mut line = |cells: [&str; 5]| {
        let [name, symbols, numbers, solutions, given] = cells;
        let _ = writeln!(
            out,
            "| {name:<width$} | {symbols:>10} | {numbers:>10} | {solutions:>9} | {given:<12} |"
        );
    };
    line(["robot", "symbols ms", "numbers ms", "solutions", "given"]);
    line([&"-".repeat(width), "---------:", "---------:", "--------:", "------------"]);
    for row in rows {
        let cell = |t: &Times, bound: f64| {
            format!("{:.0}{}", t.median, if t.median > bound { format!(" {MISSED}") } else { String::new() })
        };
        let (solutions, given) = match &row.found {
            Some((n, given)) => (n.to_string(), *given),
            None => ("refused".into(), ""),
        };
        let numbers = row.numbers.as_ref().map_or(String::new(), |t| cell(t, BOUNDS[1]));
        line([row.name, &cell(&row.symbols, BOUNDS[0]), &numbers, &solutions, given]);
    }
    out
}

fn verdict(rows: &[Row]) -> String {
    let all = [
        rows.iter().map(|r| (r.name, r.symbols.median)).collect::<Vec<_>>(),
        rows.iter().filter_map(|r| Some((r.name, r.numbers.as_ref()?.median))).collect(),
    ];
    let words = ["symbols", "numbers"].into_iter().zip(all).zip(BOUNDS).map(|((what, list), bound)| {
        let slowest = list.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let (name, ms) = slowest.copied().unwrap_or_default();
        let above = list.iter().filter(|x| x.1 > bound).count();
        let above = if above == 0 { "none".into() } else { above.to_string() };
        format!("with {what} the slowest is {name} with {ms:.0} ms, {above} above {bound} ms")
    });
    let closed = rows.iter().filter(|r| r.found.is_some()).count();
    format!(
        "{closed} of {} robots have a closed form; {}.\n",
        rows.len(),
        words.collect::<Vec<_>>().join("; ")
    )
}
