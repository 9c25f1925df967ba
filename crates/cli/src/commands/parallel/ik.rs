//! `ik`: the drives for a pose of the platform, in all modes.

use super::{At, Numbers, formulas, no, refuse};
use crate::arguments::{Format, IkArguments};
use crate::commands::fk::{plural, value};
use crate::commands::ik::pose;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{Align, HEADING, styled, table};
use denavit::description::Measure;
use denavit::description::parallel::{Family, Parallel};
use denavit::geometry::{Transform, Vector};
use denavit::inverse::Goal;
use denavit::quantity::reading;
use denavit_parallel::Solution;
use denavit_parallel::planar::PlanarPose;
use denavit_wire::Schema;
use denavit_wire::parallel::{Drives, Solved, Unreached};
use denavit_wire::pose::matrix;
use std::io::Write;

/// Answers for a parallel robot.
///
/// # Errors
/// If something is asked that is for chains, the pose cannot be read, or is not reached.
pub fn run(arguments: &IkArguments, parallel: &Parallel) -> Result<(), Failure> {
    refuse(&[
        (arguments.input.is_some(), "--input"),
        (arguments.given.is_some(), "--given"),
        (arguments.near.is_some(), "--near"),
        (arguments.best.is_some(), "--best"),
        (arguments.one, "--one"),
        (arguments.follow, "--follow"),
        (arguments.idealise.is_some(), "--idealise"),
        (arguments.certificate.is_some(), "--certificate"),
        (arguments.format != Format::Terminal, "--format"),
    ])?;
    let mut out = anstream::stdout();
    let numbers = Numbers::new(parallel, &arguments.robot.robot)?;
    let family = parallel.numbers().map_err(|e| Failure::Usage(e.to_string()))?;
    if arguments.pose.is_none() && arguments.q.is_none() {
        refuse(&[(arguments.json, "--json without a pose")])?;
        write!(out, "{}\n{}", styled(&parallel.name, HEADING), formulas(&family))?;
        return Ok(());
    }
    let pose = match (&arguments.pose, &arguments.q) {
        (Some(text), _) => platform_pose(arguments, &family, text)?,
        (None, text) => match numbers.configuration(text.as_deref())? {
            At { pose: Some((_, pose)), .. } => pose,
            At { pose: None, .. } => {
                return Err(Failure::Usage(
                    "-q: drives of a parallel robot have several poses: `fk` gives them, --pose takes one; -q takes the name of a pose \
                     of the file that is one of the platform"
                        .into(),
                ));
            }
        },
    };
    let (mut all, why) = match numbers.robot.inverse(&pose) {
        Ok(all) => (all, None),
        Err(why) => (vec![], Some(why)),
    };
    if let Some(mode) = arguments.robot.mode.as_deref() {
        let known = all.first().map_or("", |s| &s.mode).len();
        all.retain(|s| s.mode == mode.trim().replace('−', "-"));
        if all.is_empty() && why.is_none() {
            let hint = if known == 0 {
                "there is one solution alone".into()
            } else {
                format!("{known} signs, as in `+-+`")
            };
            return Err(Failure::Usage(format!("--mode {mode}: {hint}")));
        }
    }
    let before = all.len();
    if arguments.limits {
        all.retain(|s| numbers.within(&s.q) != Some(false));
    }
    let left_out = arguments.limits.then_some(before - all.len());
    let status = match (&why, all.is_empty()) {
        // A leg that turns about where it is held has any angle.
        (Some(w), _) if w.metres == 0.0 => "infinitely many",
        (Some(_), _) => "unreachable",
        (None, true) => "outside the limits",
        (None, false) => "solved",
    };
    if arguments.json {
        let drives = |s: &Solution| Drives {
            mode: s.mode.clone(),
            q: s.q.clone(),
            residual: s.residual,
            within_limits: numbers.within(&s.q),
        };
        let answer = Solved {
            kind: parallel.family.kind(),
            left_out,
            pose: matrix(&pose),
            robot: &parallel.name,
            schema: Schema,
            solutions: all.iter().map(drives).collect(),
            status,
            unreached: why.filter(|w| w.metres > 0.0).map(|w| Unreached { by: w.metres, leg: w.leg + 1 }),
        };
        writeln!(out, "{}", denavit_wire::text(&answer))?;
    } else if !all.is_empty() {
        let left =
            left_out.filter(|n| *n > 0).map_or(String::new(), |n| format!(", {n} left out by the limits"));
        let title = styled(&parallel.name, HEADING);
        write!(
            out,
            "{title}: {} in closed form{left}\n\n{}",
            plural(all.len(), "solution"),
            drives(&numbers, &all)
        )?;
    }
    match (why, status) {
        (Some(why), _) => Err(no(&why)),
        (None, "solved") => Ok(()),
        _ => Err(Failure::No("there are solutions, and the limits exclude all of them".into())),
    }
}

/// The pose in the terms of the family.
fn platform_pose(
    arguments: &IkArguments,
    family: &Family<f64>,
    text: &str,
) -> Result<Transform<f64>, Failure> {
    let parts = load::list(text);
    match family {
        Family::Stewart { .. } => {
            if arguments.goal() != Goal::Pose {
                return Err(Failure::Unsupported(
                    "--position for a Stewart platform: its legs hold a whole pose, --pose \"x, y, z, roll, pitch, yaw\"".into(),
                ));
            }
            pose::read(text, &arguments.orientation, Goal::Pose)
        }
        Family::Delta { .. } => {
            let pose = pose::read(text, &arguments.orientation, Goal::Position)?;
            let [x, z] = [pose.rotation.x(), pose.rotation.z()];
            if x[0] < 1.0 - 1e-12 || z[2] < 1.0 - 1e-12 {
                return Err(Failure::No(
                    "a delta keeps its orientation: it reaches no pose that is turned".into(),
                ));
            }
            Ok(pose)
        }
        Family::Planar3Rrr { .. } if parts.len() == 3 => {
            let read = |k: usize| {
                let measure = if k < 2 { Measure::Length } else { Measure::Angle };
                let x = load::value_of(parts[k], measure).and_then(value);
                x.map_err(|why| Failure::Usage(format!("--pose: `{}`: {why}", parts[k])))
            };
            let (x, y, angle) = (read(0)?, read(1)?, read(2)?);
            load::note_of_radians(parts[2], "angle", angle);
            Ok(PlanarPose { position: [x, y], angle }.transform())
        }
        Family::Planar3Rrr { .. } => {
            let pose = pose::read(text, &arguments.orientation, Goal::Pose).map_err(|e| match e {
                Failure::Usage(why) => Failure::Usage(format!("{why}; in the plane: x, y, angle")),
                other => other,
            })?;
            let Vector([_, _, z]) = pose.translation;
            if z.abs() > 1e-12 || pose.rotation.z()[2] < 1.0 - 1e-12 {
                return Err(Failure::No(
                    "the platform moves in the plane z = 0, and turns about z alone".into(),
                ));
            }
            Ok(pose)
        }
    }
}

/// A table of drives.
fn drives(numbers: &Numbers, all: &[Solution]) -> String {
    let names = numbers.names();
    let has_modes = all.iter().any(|s| !s.mode.is_empty());
    let has_limits = !numbers.limits.is_empty();
    let mut header: Vec<&str> = if has_modes { vec!["mode"] } else { vec![] };
    header.extend(names.iter().map(String::as_str));
    header.extend(has_modes.then_some("residual"));
    header.extend(has_limits.then_some("within limits"));
    let mut align = vec![Align::Right; header.len()];
    if has_modes {
        align[0] = Align::Left;
    }
    let row = |s: &Solution| {
        let mut cells = if has_modes { vec![s.mode.clone()] } else { vec![] };
        cells.extend(s.q.iter().map(|&x| reading(x, numbers.kind())));
        cells.extend(has_modes.then(|| format!("{:.0e}", s.residual)));
        cells.extend(numbers.within(&s.q).map(|w| if w { "yes" } else { "no" }.into()));
        cells
    };
    table(&header, &align, &all.iter().map(row).collect::<Vec<_>>())
}
