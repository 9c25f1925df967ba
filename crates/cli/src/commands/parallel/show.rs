//! `show`: the geometry of a parallel robot, and how it is solved.

use super::{Numbers, formulas, refuse};
use crate::arguments::ShowArguments;
use crate::failure::Failure;
use crate::terminal::{Align, FAINT, HEADING, NAME, number, styled, table};
use denavit::description::JointKind;
use denavit::description::parallel::{DeltaDrive, Family, Parallel, Place};
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::quantity::reading;
use denavit_wire::Schema;
use denavit_wire::parallel::{Geometry, Shown};
use std::io::Write;

/// Shows a parallel robot.
///
/// # Errors
/// If something is asked that is for chains, or a length has no value.
pub fn run(arguments: &ShowArguments, parallel: &Parallel, text: &str) -> Result<(), Failure> {
    refuse(&[(arguments.to.is_some(), "--as"), (arguments.figure.is_some(), "--figure")])?;
    let mut out = anstream::stdout();
    if arguments.toml {
        refuse(&[(!arguments.robot.set.is_empty(), "--toml with --set")])?;
        write!(out, "{text}")?;
        return Ok(());
    }
    let numbers = Numbers::new(parallel, &arguments.robot.robot)?;
    let family = parallel.numbers().map_err(|e| Failure::Usage(e.to_string()))?;
    if arguments.json {
        let number = |e| parallel.number(e).unwrap_or(f64::NAN);
        let answer = Shown {
            drives: numbers.names(),
            geometry: Geometry::from(&family),
            kind: parallel.family.kind(),
            limits: parallel.limits.iter().map(|l| l.map(number)).collect(),
            poses: parallel.poses.iter().map(|p| p.0.as_str()).collect(),
            robot: &parallel.name,
            schema: Schema,
            source: parallel.source.as_deref(),
        };
        writeln!(out, "{}", denavit_wire::text(&answer))?;
        return Ok(());
    }
    let what = match family {
        Family::Stewart { .. } => "a Stewart platform: six legs, driven by their lengths",
        Family::Delta { drive: DeltaDrive::Turns(_), .. } => "a delta robot: three arms that turn, and rods",
        Family::Delta { drive: DeltaDrive::Slides(_), .. } => "a delta robot: three slides, and rods",
        Family::Planar3Rrr { .. } => "a planar 3-RRR robot: three legs of two links, turned at the base",
    };
    writeln!(out, "{}: {what} ({})", styled(&parallel.name, HEADING), numbers.names().join(", "))?;
    if let Some(source) = &parallel.source {
        writeln!(out, "{}", styled(source, FAINT))?;
    }
    write!(out, "\n{}", geometry(&family))?;
    let values: Vec<String> = parallel
        .parameters
        .iter()
        .map(|p| {
            format!(
                "{} = {}",
                styled(&p.symbol.name(), NAME),
                p.number().map_or("?".into(), |x| number(x, 0.0))
            )
        })
        .collect();
    if !values.is_empty() {
        writeln!(out, "\n  {}", values.join(",  "))?;
    }
    let range =
        |l: &[f64; 2]| format!("{} … {}", reading(l[0], numbers.kind()), reading(l[1], numbers.kind()));
    match &numbers.limits[..] {
        [] => {}
        [first, rest @ ..] if rest.iter().all(|l| l == first) => {
            writeln!(out, "\n  limits of each drive: {}", range(first))?;
        }
        all => {
            let ranges: Vec<String> =
                numbers.names().iter().zip(all).map(|(name, l)| format!("{name} {}", range(l))).collect();
            writeln!(out, "\n  limits: {}", ranges.join(", "))?;
        }
    }
    writeln!(out, "\n{}\n{}", styled("How it is solved", HEADING), formulas(&family).trim_end())?;
    for (name, place) in &parallel.poses {
        let at = match place {
            Place::Drives(q) => {
                let q: Vec<f64> = q.iter().map(|&e| parallel.number(e).unwrap_or(f64::NAN)).collect();
                numbers.at(&q)
            }
            Place::Platform(x) => {
                let x = x.map(|e| parallel.number(e).unwrap_or(f64::NAN));
                let p = x.translation.0.map(|x| number(x, 1e-15));
                let turned = extract(&x.rotation, OrientationSet::Rpy).values;
                let turned = match turned.iter().all(|a| *a == 0.0) {
                    true => String::new(),
                    false => {
                        let angles =
                            turned.iter().map(|a| reading(*a, JointKind::Revolute)).collect::<Vec<_>>();
                        format!(", roll, pitch, yaw {}", angles.join(", "))
                    }
                };
                format!("the platform at ({}) m{turned}", p.join(", "))
            }
        };
        writeln!(out, "  pose {}: {at}", styled(name, NAME))?;
    }
    Ok(())
}

/// Points and lengths, metres.
fn geometry(family: &Family<f64>) -> String {
    let cells = |p: &[f64]| p.iter().map(|&x| number(x, 1e-15)).collect::<Vec<_>>();
    let length = |x: f64| reading(x, JointKind::Prismatic);
    match family {
        Family::Stewart { base, platform } => {
            let row =
                |i: usize| [vec![(i + 1).to_string()], cells(&base[i].0), cells(&platform[i].0)].concat();
            let header = ["leg", "base x", "y", "z", "platform x", "y", "z"];
            table(&header, &[Align::Right; 7], &(0..6).map(row).collect::<Vec<_>>())
        }
        Family::Delta { base_radius, platform_radius, lower_arm, angles, drive } => {
            let drive = match drive {
                DeltaDrive::Turns(arm) => format!("upper arm {}", length(*arm)),
                DeltaDrive::Slides(slope) => {
                    format!("slides {} below the horizontal", reading(*slope, JointKind::Revolute))
                }
            };
            format!(
                "  base radius {}, platform radius {}, {drive}, lower arm {}\n  arms at {}\n",
                length(*base_radius),
                length(*platform_radius),
                length(*lower_arm),
                angles.map(|a| reading(a, JointKind::Revolute)).join(", ")
            )
        }
        Family::Planar3Rrr { base, platform, proximal, distal } => {
            let row = |i: usize| {
                let links = cells(&[proximal[i], distal[i]]);
                [vec![(i + 1).to_string()], cells(&base[i]), cells(&platform[i]), links].concat()
            };
            let header = ["leg", "base x", "y", "platform x", "y", "proximal", "distal"];
            table(&header, &[Align::Right; 7], &(0..3).map(row).collect::<Vec<_>>())
        }
    }
}
