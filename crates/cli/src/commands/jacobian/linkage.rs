//! `jacobian` of closed loops that are no serial chain: how passive joints and the tip move with the driven ones.

use crate::arguments::JacobianArguments;
use crate::commands::fk::linkage::{assemblies, at, configuration, passives, warn};
use crate::failure::Failure;
use crate::load;
use crate::terminal::{Align, HEADING, matrix, number, styled};
use denavit::closure::{Assembly, Loops, Place};
use denavit::description::Linkage;
use denavit::velocity::singular_values;
use denavit_wire::Schema;
use denavit_wire::linkage::ClosedRates;
use std::io::Write;

/// Singular values below this, by the largest, count as 0, and so do all that are less than it by a millimetre and a milliradian.
const RANK: f64 = 1e-9;

/// Answers for a linkage: for the mode that is asked for, or for all.
///
/// # Errors
/// If something is asked that is for serial chains, the configuration cannot be read, or nothing closes.
pub fn run(arguments: &JacobianArguments, linkage: &Linkage) -> Result<(), Failure> {
    let given = [
        (arguments.input.is_some(), "--input"),
        (arguments.frame != "base", "--frame"),
        (arguments.of != "tool", "--of"),
        (arguments.at.is_some(), "--at"),
        (arguments.orientation.is_some(), "--orientation"),
        (arguments.rates.is_some(), "--rates"),
        (arguments.twist.is_some(), "--twist"),
        (arguments.wrench.is_some(), "--wrench"),
        (arguments.hessian, "--hessian"),
        (arguments.symbolic, "--symbolic"),
        (arguments.explain, "--explain"),
        (arguments.certificate.is_some(), "--certificate"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Unsupported(format!("{option} for closed loops that are no serial chain")));
    }
    let loops = load::loops(&arguments.robot, linkage)?;
    let q = configuration(linkage, arguments.q.as_deref())?;
    let (name, place) =
        loops.place(arguments.robot.tip.as_deref()).map_err(|why| Failure::Usage(why.to_string()))?;
    let all = assemblies(&loops, arguments.robot.mode.as_deref(), &q)?.all;
    warn(linkage, &q, &all);
    let mut out = anstream::stdout();
    if arguments.json {
        for a in &all {
            let rates = loops.rates(&place, &q, &a.passive);
            let rank = rates.frame.as_ref().map(|j| rank(j));
            let rows = rates.frame.map(|j| (0..6).map(|i| j.iter().map(|c| c[i]).collect()).collect());
            let answer = ClosedRates {
                frame: &name,
                free: rates.free,
                jacobian: rows,
                joints: &q,
                mode: a.mode.to_string(),
                passive: &a.passive,
                passive_rates: rates.passive,
                rank,
                robot: &linkage.tree.name,
                schema: Schema,
            };
            writeln!(out, "{}", denavit_wire::text(&answer))?;
        }
        return Ok(());
    }
    write!(
        out,
        "{} at {}\n\n{}",
        styled(&linkage.tree.name, HEADING),
        at(linkage, &q),
        passives(linkage, &all)
    )?;
    for a in &all {
        write!(out, "\n{}", one(linkage, &loops, &place, &name, &q, a))?;
    }
    Ok(())
}

fn rank(columns: &[[f64; 6]]) -> usize {
    let values = singular_values(columns.to_vec());
    let first = values.first().copied().unwrap_or(0.0);
    values.iter().filter(|v| **v > RANK * first.max(1e-3)).count()
}

/// One assembly: G, J, and what is singular.
fn one(linkage: &Linkage, loops: &Loops, place: &Place, name: &str, q: &[f64], a: &Assembly) -> String {
    let rates = loops.rates(place, q, &a.passive);
    let mode = match a.mode.to_string().as_str() {
        "" => String::new(),
        signs => format!("mode {signs}: "),
    };
    let (Some(g), Some(j)) = (&rates.passive, &rates.frame) else {
        let passive = linkage.passive();
        let names: Vec<String> =
            rates.free_joints.iter().map(|&k| passive[k].symbol.name().to_string()).collect();
        let (motions, s) = if rates.free == 1 { ("one motion", "s") } else { ("motions", "") };
        return format!(
            "  {mode}a parallel singularity: with the driven joints at rest {motions} of passive joints remain{s} ({}); assembly modes\n  \
             meet here, and no G and no Jacobian is there\n",
            names.join(", ")
        );
    };
    let entries = |rows: Vec<Vec<f64>>| -> Vec<Vec<String>> {
        rows.iter().map(|r| r.iter().map(|&x| number(x, 1e-14)).collect()).collect()
    };
    let rows = (0..6).map(|i| j.iter().map(|c| c[i]).collect()).collect();
    let mut text = matrix(&format!("{mode}ṗ = G·q̇, G = "), &entries(g.clone()), Align::Right);
    text += &format!("\n{}", matrix(&format!("{mode}J({name}) = "), &entries(rows), Align::Right));
    let (n, rank) = (q.len(), rank(j));
    if rank < n.min(6) {
        text += &format!(
            "  a serial singularity: J has rank {rank}, and {n} joint{} driven: some motion of them leaves `{name}` at rest\n",
            if n == 1 { " is" } else { "s are" }
        );
    }
    text
}
