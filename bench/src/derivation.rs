//! CPU time of deriving the forward model and the inverse model of every robot of the catalogue.
//!
//! Measured: reading the robot file, the link transforms, the simplified matrix, the search for the shortest algorithm, and
//! the proof; each time in a fresh thread, so that no formula is known from the run before. The reference of the same run is
//! the bare normal form of the same product over single joint angles. Inverse models have their lengths as symbols and as
//! numbers.

use crate::measure::{Processor, processor_times};
use crate::read;
use anyhow::{Context, Result};
use denavit::catalogue;
use denavit::forward::{ForwardModel, Outputs, link_transforms, symbol_order};
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::robot::Robot;
use denavit_generate::with_values;
use denavit_symbolic::{Angle, Expr, Ring};
use serde_json::{Value, json};
use std::hint::black_box;

/// Measurements a figure: forward, inverse.
const REPEATS: [usize; 2] = [9, 3];

/// Measures; prints one JSON object.
///
/// # Errors
/// If a robot of the catalogue cannot be read.
pub fn run() -> Result<()> {
    let robots = catalogue::names().into_iter().map(robot).collect::<Result<Vec<Value>>>()?;
    println!("{}", json!({"robots": robots, "repeats": REPEATS}));
    Ok(())
}

fn robot(name: &'static str) -> Result<Value> {
    let [forward, inverse] = REPEATS;
    let ours = processor_times(name, forward, derive)?.context("a derivation is never refused")?;
    let naive = processor_times(name, forward, expand)?;
    let symbols = processor_times(name, inverse, invert)?.context("a refusal is an answer, too")?;
    let numbers = processor_times(name, inverse, invert_fixed)?;
    let closed = InverseModel::derive(&read(name)?, &InverseOptions::default()).ok().map(|m| {
        let given = m.given.iter().map(|&j| m.chain.variables[j].name().to_string());
        json!({"solutions": m.max_solutions(), "given": given.collect::<Vec<_>>().join(", ")})
    });
    Ok(json!({
        "name": name, "forward": ours.json(), "naive": naive.as_ref().map(Processor::json),
        "symbols": symbols.json(), "numbers": numbers.as_ref().map(Processor::json), "closed": closed,
    }))
}

/// From the text of the robot file to the proof.
fn derive(name: &str) -> Result<bool> {
    let description = read(name)?;
    black_box(link_transforms(&description));
    black_box(ForwardModel::of_tool(&description, Outputs::ALL));
    Ok(true)
}

/// The naive reference: the product of the link transforms in normal form over the single joint angles. False if
/// that is too large.
fn expand(name: &str) -> Result<bool> {
    let description = read(name)?;
    let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
    let pose = Robot::symbolic(&description).pose(&q).matrix();
    let entries: Vec<Expr> = pose.into_iter().flatten().collect();
    let angles: Vec<Angle> = q.into_iter().map(Angle::of).collect();
    let mut ring = Ring::with_basis(&angles, &entries, &symbol_order(&description));
    Ok(entries.into_iter().all(|e| black_box(ring.normal(e)).is_ok()))
}

/// From the text of the robot file to the compiled solver; for an arm without a closed form, to the refusal.
fn invert(name: &str) -> Result<bool> {
    let _ = black_box(InverseModel::derive(&read(name)?, &InverseOptions::default()));
    Ok(true)
}

/// The same with the numbers of lengths put in; false if a length has none.
fn invert_fixed(name: &str) -> Result<bool> {
    let Ok(description) = with_values(&read(name)?) else { return Ok(false) };
    let _ = black_box(InverseModel::derive(&description, &InverseOptions::default()));
    Ok(true)
}
