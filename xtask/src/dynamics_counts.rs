//! docs/dynamics-counts.md: what the torques of every arm of the catalogue cost, beside what OpenSYMORO derives and published figures.

use crate::{denavit, path, robots, scratch};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fmt::Write;
use std::fs;

const PAGE: &str = "docs/dynamics-counts.md";
/// What OpenSYMORO derives for the catalogue's arms.
const SYMORO: &str = "crates/robot/tests/peers/symoro_counts.json";
/// The least number of joints for which the general formula is meant.
const GENERAL: u64 = 3;

/// Figures in print for an arm of the catalogue.
const OTHERS: &[(&str, &str)] = &[(
    "staubli-rx90",
    "253 / 238 with rotors (published for SYMORO); its stored file 342 / 300 with all parameters, rotors, friction and a wrench, \
     282 / 222 bare with base parameters put in",
)];

/// Arms with two letters for lengths that are the same: one in the place of the other, as published counts have them.
const SAME: &[(&str, &str, &str)] = &[("franka-panda", "a4", "-a3")];

const INTRODUCTION: &str = "\
# Operation counts of dynamics

What the torques τ(q, q̇, q̈) of every arm of the catalogue cost: multiplications and additions of the program that `denavit dynamics
ARM --symbolic` prints, in base parameters, all masses and lengths symbols, gravity along −z of the base, without rotors and friction;
what depends on parameters alone is apart. Each is equal to Lagrange's equations: *proved* by identical canonical forms, or, where these are too
large or have divisors, compared *at random states*, exactly modulo a prime or in doubles ([more](dynamics.md#formulas)).

*General* is Khalil and Kleinfinger's count for any arm of n joints, all of them revolute: 92n − 127 multiplications and 81n − 117 additions
(1987), the recursion, customised, with base parameters, before anything is known of the arm. Published counts of the Panda take its
two equal lengths for one: so does its second line.

*SYMORO* is what OpenSYMORO derives for the same table in its own base parameters, without rotors and friction, counted by the same rule
([`make_symoro_counts.py`](../crates/robot/tests/peers/make_symoro_counts.py)); a – stands where its grouping stops with an error, or its
format has no words for the arm. *Published* are figures that somebody printed for the arm itself; of most arms none are known.

| arm | joints | base parameters | here | equal | SYMORO | general | published |
|---|--:|--:|--:|---|--:|--:|---|
";

/// Writes the page, or with `check` compares it.
///
/// # Errors
/// If an arm's torques are not Lagrange's, or with `check` if the page is not up to date.
pub fn run(check: bool) -> Result<()> {
    let mut text = INTRODUCTION.to_string();
    let symoro: Value = serde_json::from_str(&fs::read_to_string(path(SYMORO))?)?;
    let symoro = &symoro["robots"];
    for name in robots()? {
        text += &row(&name, &name, &symoro[&name])?;
        for (_, letter, other) in SAME.iter().filter(|s| s.0 == name) {
            let file = with_one_letter(&name, letter, other)?;
            text += &row(&format!("{name}, {letter} = {}", other.replace('-', "−")), &file, &Value::Null)?;
        }
    }
    text += "\nRenew with `cargo xtask counts dynamics`.\n";
    if !check {
        fs::write(path(PAGE), text)?;
        println!("wrote {PAGE}");
        return Ok(());
    }
    if fs::read_to_string(path(PAGE)).ok().as_deref() != Some(&text) {
        bail!("{PAGE} is not up to date; `cargo xtask counts dynamics` renews it");
    }
    println!("{PAGE} is up to date");
    Ok(())
}

/// A file of the arm with another formula in the place of a length, which is no parameter any more.
fn with_one_letter(name: &str, letter: &str, other: &str) -> Result<String> {
    let text = fs::read_to_string(path(&format!("crates/robot/catalogue/{name}.toml")))?;
    let head = format!("{letter} = ");
    let kept = text.lines().filter(|l| !l.starts_with(&head)).map(|l| format!("{l}\n"));
    let text = kept.collect::<String>().replace(&format!("\"{letter}\""), &format!("\"{other}\""));
    let file = scratch()?.join(format!("{name}-{letter}.toml"));
    fs::write(&file, text)?;
    Ok(file.to_string_lossy().into_owned())
}

fn row(name: &str, robot: &str, symoro: &Value) -> Result<String> {
    let printed = denavit(["dynamics", robot, "--symbolic", "--json"])?;
    let model: Value = serde_json::from_str(&printed).with_context(|| name.to_string())?;
    let number = |v: &Value| v.as_u64().with_context(|| format!("{name}: no number in {v}"));
    let count = &model["count"];
    let here = [number(&count["multiplications"])?, number(&count["additions"])?];
    let [mul, add] = here;
    let steps = model["steps"].as_array().with_context(|| format!("{name}: no steps"))?;
    let joints = steps.iter().filter(|s| s["output"] == true).count() as u64;
    let base =
        model["base_parameters"].as_array().with_context(|| format!("{name}: no base parameters"))?.len();
    let equal = match model["proof"].as_str().with_context(|| format!("{name}: no proof"))? {
        "proved" => "proved",
        "sampled" => "at random states",
        other => bail!("{name}: the torques are {other}"),
    };
    let general = match joints {
        n if n >= GENERAL => format!("{} / {}", 92 * n - 127, 81 * n - 117),
        _ => String::new(),
    };
    let symoro = match symoro["base"].as_array().map(Vec::as_slice) {
        Some([mul, add]) => {
            let theirs = [number(mul)?, number(add)?];
            if theirs[0] < here[0] || theirs[1] < here[1] {
                bail!("{name}: SYMORO has {theirs:?}, which is less than {here:?} in one");
            }
            format!("{} / {}", theirs[0], theirs[1])
        }
        _ => "–".to_string(),
    };
    let others = OTHERS.iter().find(|o| o.0 == name).map_or("none known", |o| o.1);
    let mut line = String::new();
    let _ = writeln!(
        line,
        "| {name} | {joints} | {base} | {mul} / {add} | {equal} | {symoro} | {general} | {others} |"
    );
    Ok(line)
}
