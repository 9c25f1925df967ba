//! CPU time of deriving the inverse model of every robot of the catalogue, lengths as symbols and as numbers.

use super::MISSED;
use super::derivation::{Times, times};
use crate::robot;
use anyhow::Result;
use denavit::catalogue;
use denavit::inverse::{InverseModel, Options};
use denavit_generate::with_values;
use std::fmt::Write;
use std::hint::black_box;

/// Measurements a figure.
const REPEATS: usize = 3;
/// What a derivation may take, ms: with symbols, with numbers.
const BOUNDS: [f64; 2] = [1000.0, 200.0];

struct Row {
    name: &'static str,
    symbols: Times,
    /// `None` if a length has no value.
    numbers: Option<Times>,
    /// The largest number of solutions and the joints that are given, or `None` if there is no closed form.
    found: Option<(usize, String)>,
}

/// Measures, prints the table, and gives the text for the page.
///
/// # Errors
/// If a robot of the catalogue cannot be read.
pub fn run() -> Result<String> {
    let mut rows = vec![];
    for name in catalogue::names() {
        let Some(symbols) = times(name, REPEATS, derive)? else { continue };
        let numbers = times(name, REPEATS, derive_fixed)?;
        let model = InverseModel::derive(&robot(name)?, &Options::default());
        let found = model.ok().map(|m| {
            let given = m.given.iter().map(|&j| m.chain.variables[j].name().to_string());
            (m.max_solutions(), given.collect::<Vec<_>>().join(", "))
        });
        rows.push(Row { name, symbols, numbers, found });
    }
    let text = format!("{INTRODUCTION}\n{}\n\n{}", verdict(&rows), table(&rows));
    println!("{text}");
    Ok(text)
}

const INTRODUCTION: &str = "\
### Inverse models\n\n\
CPU time of `InverseModel::derive`, from the robot file to the compiled solver: with the lengths as symbols, and with their\n\
numbers put in. Median of 3 runs, each in a fresh thread; release build, one thread. For an arm without a closed form it is\n\
the time of the refusal. Given are joints of an arm that has too many, as the derivation chooses them.\n\n\
For comparison, from the project's goals and not measured in this run: Robotics Toolbox 1.5 3 to 25 s (300 s for the worst),\n\
IKBT 16 to 143 s, IKFast minutes to hours.\n";

fn derive(name: &str) -> Result<bool> {
    let description = robot(name)?;
    let _ = black_box(InverseModel::derive(&description, &Options::default()));
    Ok(true)
}

fn derive_fixed(name: &str) -> Result<bool> {
    let Ok(description) = with_values(&robot(name)?) else { return Ok(false) };
    let _ = black_box(InverseModel::derive(&description, &Options::default()));
    Ok(true)
}

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
            Some((n, given)) => (n.to_string(), given.as_str()),
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
