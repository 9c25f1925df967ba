//! `fk`: all poses of the platform for values of the drives, and what is known of their number.

use super::{Numbers, formulas, refuse};
use crate::arguments::FkArguments;
use crate::commands::fk::plural;
use crate::failure::Failure;
use crate::terminal::{Align, HEADING, NAME, matrix, noise, number, styled, table};
use denavit::description::parallel::Parallel;
use denavit::geometry::Transform;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::quantity::decimals;
use denavit_parallel::stewart::Bound;
use denavit_parallel::{Assemblies, Assembly, Known, Robot};
use denavit_wire::parallel::Placed;
use std::io::Write;

/// Answers for a parallel robot.
///
/// # Errors
/// If something is asked that is for chains, the drives cannot be read, or there is no pose for them.
pub fn run(arguments: &FkArguments, parallel: &Parallel) -> Result<(), Failure> {
    refuse(&[(arguments.input.is_some(), "--input"), (arguments.frames.is_some(), "--frames")])?;
    let mut out = anstream::stdout();
    let numbers = Numbers::new(parallel, &arguments.robot.robot)?;
    if arguments.symbolic {
        refuse(&[(arguments.json, "--symbolic --json")])?;
        let family = parallel.numbers().map_err(|e| Failure::Usage(e.to_string()))?;
        write!(out, "{}\n{}", styled(&parallel.name, HEADING), formulas(&family))?;
        return Ok(());
    }
    let set = arguments.orientation.as_deref().map(str::parse::<OrientationSet>).transpose();
    let set = set.map_err(|e| Failure::Usage(format!("--orientation: {e}")))?;
    let at = numbers.configuration(arguments.q.as_deref())?;
    numbers.warn_of_limits(&at.q);
    let whole = numbers.robot.forward(&at.q);
    // Of all poses, whichever are printed.
    let (words, is_complete) = (said(&whole), whole.is_complete());
    let found = chosen(whole, arguments.robot.mode.as_deref())?;
    if arguments.json {
        let orientation = |pose: &Transform<f64>| set.map(|s| extract(&pose.rotation, s).into());
        let who = (parallel.name.as_str(), parallel.family.kind());
        let answer = Placed::of(who, &at.q, (&found, is_complete), numbers.within(&at.q), orientation);
        writeln!(out, "{}", denavit_wire::text(&answer))?;
    } else {
        let title = format!("{} at {}: ", styled(&parallel.name, HEADING), numbers.at(&at.q));
        writeln!(out, "{title}{}", plural(found.all.len(), "pose"))?;
        if !found.all.is_empty() {
            write!(out, "\n{}", poses(&numbers.robot, &found.all, set))?;
        }
        if let (Some(_), [one]) = (&arguments.robot.mode, &found.all[..]) {
            let rounding = noise([&one.pose]);
            let row = |row: &[f64; 4]| {
                row.iter()
                    .enumerate()
                    .map(|(c, &e)| number(e, if c == 3 { rounding } else { 1e-14 }))
                    .collect()
            };
            let entries: Vec<Vec<String>> = one.pose.matrix().iter().map(row).collect();
            write!(out, "\n{}", matrix("T(base → platform) = ", &entries, Align::Right))?;
        }
        writeln!(out, "\n  {words}")?;
    }
    match (found.all.is_empty(), is_complete) {
        (true, true) => Err(Failure::No("no pose has these drives".into())),
        (true, false) => Err(Failure::No("no pose was found for these drives".into())),
        _ => Ok(()),
    }
}

/// The assembly mode that is asked for, or all.
pub fn chosen(mut found: Assemblies, mode: Option<&str>) -> Result<Assemblies, Failure> {
    let Some(mode) = mode else { return Ok(found) };
    let known: Vec<String> = found.all.iter().map(|a| a.mode.clone()).collect();
    found.all.retain(|a| a.mode == mode.trim().replace('−', "-"));
    if found.all.is_empty() && !known.is_empty() {
        return Err(Failure::Usage(format!(
            "--mode: no assembly mode `{mode}` here; there are {}",
            known.join(", ")
        )));
    }
    Ok(found)
}

/// A table of poses.
pub fn poses(robot: &Robot, all: &[Assembly], set: Option<OrientationSet>) -> String {
    let rounding = noise(all.iter().map(|a| &a.pose));
    let shown = set.unwrap_or(OrientationSet::Rpy);
    let names: Vec<&str> = match (robot, set) {
        (Robot::Stewart(_), _) | (_, Some(_)) => [&["x", "y", "z"], shown.names()].concat(),
        (Robot::Delta(_), None) => vec!["x", "y", "z"],
        (Robot::Planar(_), None) => vec!["x", "y", "angle"],
    };
    let is_doubtful = !matches!(robot, Robot::Delta(_)) && all.iter().any(|a| !a.is_proved);
    let header =
        [vec!["mode"], names.clone(), vec!["residual"], if is_doubtful { vec!["proved"] } else { vec![] }]
            .concat();
    let angle = |x: f64| format!("{}°", decimals(x.to_degrees(), 4));
    let row = |a: &Assembly| {
        let p = a.pose.translation;
        let mut cells = vec![a.mode.clone()];
        cells.extend([p[0], p[1]].map(|x| number(x, rounding)));
        if let (Robot::Planar(_), None) = (robot, set) {
            let x = a.pose.rotation.x();
            cells.push(angle(x[1].atan2(x[0])));
        } else {
            cells.push(number(p[2], rounding));
            let turns = |k: usize| match shown {
                OrientationSet::Quaternion | OrientationSet::Matrix => false,
                OrientationSet::AxisAngle => k == 3,
                _ => true,
            };
            let values = extract(&a.pose.rotation, shown).values;
            let values = values.iter().enumerate().take(names.len() - 3);
            cells.extend(values.map(|(k, &x)| if turns(k) { angle(x) } else { number(x, 1e-14) }));
        }
        cells.push(format!("{:.0e}", a.residual));
        if is_doubtful {
            cells.push(if a.is_proved { "yes" } else { "no" }.into());
        }
        cells
    };
    let mut align = vec![Align::Right; header.len()];
    align[0] = Align::Left;
    table(&header, &align, &all.iter().map(row).collect::<Vec<_>>())
}

/// What is known of the number of poses.
fn said(found: &Assemblies) -> String {
    let real = found.all.iter().filter(|a| a.is_proved).count();
    match found.known {
        Known::ClosedForm => styled("in closed form: there are no others", NAME),
        Known::OnALine => {
            "the centres of the three spheres lie on a line: infinitely many positions, or none".into()
        }
        Known::Sextic { is_counted: true } => {
            styled("counted: the polynomial of degree 6 has no other real root, proved", NAME)
        }
        Known::Sextic { is_counted: false } => {
            "poses meet here, or the platform moves with its drives at rest: not counted, there may be others"
                .into()
        }
        Known::Paths { proved, bound: Bound::Forty, .. } if found.is_complete() => styled(
            &format!(
                "complete: all {proved} solutions over the complex numbers are proved, there are no others"
            ),
            NAME,
        ),
        Known::Paths { proved, bound: Bound::Sixteen, .. } if found.is_complete() => styled(
            &format!(
                "complete: legs that meet in three points have {proved} isolated poses at most over the complex numbers, and all are proved"
            ),
            NAME,
        ),
        Known::Paths { proved, lost, .. } => format!(
            "{} over the complex numbers proved, {real} of them real; {} of 40 ended in none that could be proved \
             (at infinity, where poses meet, or on a motion with all legs at rest): there may be others",
            plural(proved, "solution"),
            plural(lost, "path"),
        ),
    }
}
