//! Speed of inverse kinematics without a closed form: the package `bench` with the argument `arms`.

use super::MISSED;
use super::evaluation::measured;
use super::inverse::cmake;
use anyhow::{Context, Result};
use serde_json::Value;
use std::fmt::Write;

/// Measures, prints the tables, and gives the section of the page.
///
/// # Errors
/// If the package `bench` does not build or run, or solutions are not found.
pub fn run(is_quick: bool) -> Result<String> {
    cmake()?;
    let measured = measured(if is_quick { &["arms", "--quick"] } else { &["arms"] })?;
    let poses = measured["poses"].as_u64().context("a number of poses")?;
    let mut text = INTRODUCTION.replace("@poses@", &poses.to_string());
    text += &general(&measured["general"])?;
    text += &redundant(&measured["redundant"])?;
    text += &following(&measured["following"])?;
    text += &numeric(&measured["numeric"])?;
    println!("{text}");
    Ok(text)
}

const INTRODUCTION: &str = "\
Poses of @poses@ random configurations of each arm, on one core. Each pose is timed for itself: its time is the least of five\n\
rounds over all poses. p99 is what 99 of 100 poses take at most. Before anything is timed every answer is put into the\n\
forward model; answers that miss the pose by more than 1e-6 do not count. Solvers choose their instructions when they\n\
run; the peers are compiled for x86-64-v3.\n";

const GENERAL: &str = "\
\n### Six joints in general\n\n\
All solutions by elimination, each with its residual, of configurations anywhere in (-π, π); where there is a closed form, it\n\
is left aside. Every configuration that a pose was made from is among the solutions, or there is no table. Second split:\n\
poses that one elimination did not settle. Complete: poses whose answer is certified to lack no solution.\n\n\
| | mean µs | median µs | p99 µs | solutions a pose | second split | complete | largest error | limit of the mean | limit of p99 |\n\
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";

const PEERS: &str = "\
\nThe crate `ik-geo` 0.1.2 on the first @poses@ poses of the arm \"@title@\": its solver for any arm, and the one for arms of\n\
which two axes meet, which this one's last two do. Both search.\n\n\
| | mean µs | of ours on these poses | answers a pose | valid to 1e-6 | the best misses by | configurations found |\n\
|---|---:|---:|---:|---:|---:|---:|\n";

const REDUNDANT: &str = "\
\n### A joint too many\n\n\
One configuration within the limits, for poses of configurations within the limits, without a start. All must be solved.\n\n\
| | parameter | solved | mean µs | median µs | p99 µs | limit of the mean |\n\
|---|---|---:|---:|---:|---:|---:|\n";

const FOLLOWING: &str = "\
\nPoses of paths between configurations within the limits, one after the other: the configuration within the limits that is\n\
nearest to the last one. Jumps: poses without one nearby. Of all: times as long takes what has all arcs of the self-motion\n\
computed and the nearest of their members chosen, in the same run.\n\n\
| | poses | jumps | largest error | mean µs | median µs | p99 µs | of all | limit of the mean |\n\
|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";

const NUMERIC: &str = "\
\n### Descent\n\n\
One configuration within the limits to 1e-9, for poses of configurations within the limits, from a random configuration, the\n\
same for everybody; then from as many others as it takes, so that all must be solved, or not (one start). `k` is its\n\
`JacobianIkSolver` to 1e-6 with the half steps, at most 100, of its examples; times include failures.\n\n\
For comparison, on a Zen 4 core of 3.65 GHz and not measured in this run: Robotics Toolbox 1.5 70 µs for the UR5 (p99 465 µs)\n\
and 166 µs for the Panda (99.94 % solved); OptIK 0.5 186 µs and 279 µs; TRAC-IK 563 µs and 807 µs (99 % solved).\n";

fn general(measured: &Value) -> Result<String> {
    let mut text = GENERAL.to_string();
    for arm in measured["arms"].as_array().context("a list of arms")? {
        let _ = writeln!(
            text,
            "| {} | {} | {:.2} | {} | {} | {:.1e} | {} | {} |",
            title(arm)?,
            times(arm),
            number(&arm["solutions"]),
            percent(&arm["second"]),
            percent(&arm["complete"]),
            number(&arm["worst"]),
            limit(arm, "mean", 0),
            limit(arm, "p99", 1),
        );
    }
    let peers = measured["peers"].as_array().context("a list of peers")?;
    let first = peers.first().context("a peer")?;
    let (poses, title) = (&first["poses"], title(first)?);
    text += &PEERS.replace("@poses@", &poses.to_string()).replace("@title@", title);
    for peer in peers {
        let best = peer["best"].as_f64().map_or(String::new(), |best| format!("{best:.1e}"));
        let _ = writeln!(
            text,
            "| {} | {:.0} | {:.0} | {:.2} | {} | {best} | {} |",
            peer["name"].as_str().unwrap_or_default(),
            number(&peer["times"]["mean"]),
            number(&peer["ratio"]),
            number(&peer["answers"]) / number(poses),
            peer["valid"],
            peer["drawn_found"],
        );
    }
    Ok(text)
}

fn redundant(measured: &Value) -> Result<String> {
    let mut text = REDUNDANT.to_string();
    for arm in measured.as_array().context("a list of arms")? {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            title(arm)?,
            arm["parameter"].as_str().unwrap_or_default(),
            all(&arm["solved"]),
            times(arm),
            limit(arm, "mean", 0),
        );
    }
    Ok(text)
}

fn following(measured: &Value) -> Result<String> {
    let mut text = FOLLOWING.to_string();
    for arm in measured.as_array().context("a list of arms")? {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {:.0e} | {} | {:.0} | {} |",
            title(arm)?,
            arm["poses"],
            arm["jumps"],
            number(&arm["worst"]),
            times(arm),
            number(&arm["ratio"]),
            limit(arm, "mean", 0),
        );
    }
    Ok(text)
}

fn numeric(measured: &Value) -> Result<String> {
    let mut text = NUMERIC.to_string();
    for arm in measured.as_array().context("a list of arms")? {
        let _ = write!(
            text,
            "\n| {} | solved | mean µs | median µs | p99 µs | mean, of k | limit of the mean |\n|---|---:|---:|---:|---:|---:|---:|\n",
            title(arm)?
        );
        let rows = arm["rows"].as_array().context("rows")?;
        let unit = number(&rows.first().context("the peer")?["times"]["mean"]);
        for row in rows {
            let must = row["must"].as_bool().unwrap_or_default();
            let _ = writeln!(
                text,
                "| {} | {} | {} | {:.3} | {} |",
                row["name"].as_str().unwrap_or_default(),
                if must { all(&row["solved"]) } else { percent(&row["solved"]) },
                times(row),
                number(&row["times"]["mean"]) / unit,
                limit(row, "mean", 0),
            );
        }
    }
    Ok(text)
}

fn title(arm: &Value) -> Result<&str> {
    arm["title"].as_str().context("a title")
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or(f64::NAN)
}

/// Three cells.
fn times(row: &Value) -> String {
    let cells = ["mean", "median", "p99"].map(|key| format!("{:.1}", number(&row["times"][key])));
    cells.join(" | ")
}

/// The limit number `k`, of a figure of that name; nothing if there is none.
fn limit(row: &Value, figure: &str, k: usize) -> String {
    let Some(limit) = row["times"]["limits"][k].as_f64() else { return String::new() };
    if number(&row["times"][figure]) > limit { format!("{limit} {MISSED}") } else { limit.to_string() }
}

fn percent(share: &Value) -> String {
    format!("{:.2} %", 100.0 * number(share))
}

/// A share that must be the whole.
fn all(share: &Value) -> String {
    if number(share) < 1.0 { format!("{} {MISSED}", percent(share)) } else { "100 %".into() }
}
