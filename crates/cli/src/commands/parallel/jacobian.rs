//! `jacobian`: J_x ẋ = J_q q̇ at a pose, and singularities of both kinds.

use super::fk::{chosen, poses};
use super::{Numbers, formulas, refuse};
use crate::arguments::JacobianArguments;
use crate::failure::Failure;
use crate::terminal::{Align, HEADING, NAME, matrix, number, styled};
use denavit::description::parallel::Parallel;
use denavit::geometry::{Transform, Vector};
use denavit_parallel::Assembly;
use denavit_parallel::rates::{Gained, Motion, Rates};
use denavit_wire::parallel::{Moving, rows};
use std::io::Write;

/// Answers for a parallel robot: for the mode that is asked for, a pose of its file, or all modes.
///
/// # Errors
/// If something is asked that is for chains, the drives cannot be read, or there is no pose for them.
pub fn run(arguments: &JacobianArguments, parallel: &Parallel) -> Result<(), Failure> {
    refuse(&[
        (arguments.input.is_some(), "--input"),
        (arguments.frame != "base", "--frame"),
        (arguments.of != "tool", "--of"),
        (arguments.at.is_some(), "--at"),
        (arguments.orientation.is_some(), "--orientation"),
        (arguments.rates.is_some(), "--rates"),
        (arguments.twist.is_some(), "--twist"),
        (arguments.wrench.is_some(), "--wrench"),
        (arguments.hessian, "--hessian"),
        (arguments.explain, "--explain"),
        (arguments.certificate.is_some(), "--certificate"),
    ])?;
    let mut out = anstream::stdout();
    let numbers = Numbers::new(parallel, &arguments.robot.robot)?;
    if arguments.symbolic {
        refuse(&[(arguments.json, "--symbolic --json")])?;
        let family = parallel.numbers().map_err(|e| Failure::Usage(e.to_string()))?;
        write!(out, "{}\n{}", styled(&parallel.name, HEADING), formulas(&family))?;
        return Ok(());
    }
    let at = numbers.configuration(arguments.q.as_deref())?;
    numbers.warn_of_limits(&at.q);
    let mode = arguments.robot.mode.as_deref();
    let all: Vec<Assembly> = match (&at.pose, mode) {
        (Some((name, pose)), None) => {
            let residual = numbers.robot.open(pose, &at.q);
            vec![Assembly { mode: name.clone(), pose: *pose, residual, is_proved: true }]
        }
        _ => chosen(numbers.robot.forward(&at.q), mode)?.all,
    };
    if all.is_empty() {
        return Err(Failure::No("no pose was found for these drives".into()));
    }
    if !arguments.json {
        let title = format!("{} at {}", styled(&parallel.name, HEADING), numbers.at(&at.q));
        write!(out, "{title}\n\n{}", poses(&numbers.robot, &all, None))?;
    }
    for a in &all {
        let Some(rates) = numbers.robot.rates(&a.pose, &at.q) else {
            return Err(Failure::No(format!("mode {}: a leg has the length 0, and no direction", a.mode)));
        };
        if arguments.json {
            let who = (parallel.name.as_str(), parallel.family.kind(), a.mode.as_str());
            let answer = Moving::of(who, &a.pose, &at.q, &rates, &rates.singular());
            writeln!(out, "{}", denavit_wire::text(&answer))?;
        } else {
            write!(out, "\n{}", one(&numbers, &a.mode, &a.pose, &rates))?;
        }
    }
    Ok(())
}

/// Both matrices, and what is singular.
fn one(numbers: &Numbers, mode: &str, pose: &Transform<f64>, rates: &Rates) -> String {
    let entries = |rows: &[Vec<f64>]| -> Vec<Vec<String>> {
        rows.iter().map(|r| r.iter().map(|&x| number(x, 1e-14)).collect()).collect()
    };
    let columns = rows(rates.motion).join(", ");
    let mut text =
        format!("  mode {}: J_x ẋ = J_q q̇, ẋ = ({columns}) of the platform's origin\n\n", styled(mode, NAME));
    text += &matrix("J_x = ", &entries(&rates.platform), Align::Right);
    let diagonal: Vec<String> = rates.drives.iter().map(|&x| number(x, 1e-14)).collect();
    text += &format!("  J_q = diag({})\n", diagonal.join(", "));
    if let Some(j) = rates.forward() {
        text += &format!("\n{}", matrix("J = J_x⁻¹J_q = ", &entries(&j), Align::Right));
    }
    let singular = rates.singular();
    let values: Vec<String> = singular.values.iter().map(|&x| number(x, 1e-14)).collect();
    let by = match rates.motion {
        Motion::Translation => String::new(),
        _ => format!(" (lengths by {} m)", number(rates.length, 0.0)),
    };
    text += &format!("\n  singular values of J_x{by}: {}", values.join(", "));
    text += &match singular.gained[..] {
        [] => format!("; condition {}\n", number(singular.condition(), 0.0)),
        _ => "\n".into(),
    };
    for gained in &singular.gained {
        text += &format!(
            "  a parallel singularity (type 2): with all drives at rest the platform still has {}\n",
            motion(gained, pose)
        );
    }
    if singular.gained.is_empty() {
        text += &format!("  held least: {}\n", motion(&singular.weakest, pose));
    }
    for &leg in &singular.serial {
        text += &format!(
            "  a serial singularity (type 1): leg {} is stretched or folded, {} moves with the platform at rest\n",
            leg + 1,
            numbers.of.family.drive_name(leg)
        );
    }
    if singular.gained.is_empty() && singular.serial.is_empty() {
        text += "  not singular\n";
    }
    text
}

/// A motion in words and numbers.
fn motion(gained: &Gained, pose: &Transform<f64>) -> String {
    let size = pose.translation.norm().max(1.0);
    let vector = |v: &Vector<f64>| format!("({})", v.0.map(|x| number(x, 1e-9 * size)).join(", "));
    match gained {
        Gained::Translation(v) => format!("the translation along {}", vector(v)),
        Gained::Screw { axis, point, pitch } if pitch.abs() < 1e-9 * size => {
            format!("the rotation about the axis along {} through {}", vector(axis), vector(point))
        }
        Gained::Screw { axis, point, pitch } => format!(
            "the screw about the axis along {} through {} with the pitch {} m/rad",
            vector(axis),
            vector(point),
            number(*pitch, 0.0)
        ),
    }
}
