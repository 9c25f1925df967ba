//! `denavit identify --excite`: a motion that shows the parameters.

use super::Subject;
use crate::arguments::{CriterionOf, IdentifyArguments};
use crate::commands::check::recording::write_whole;
use crate::commands::dynamics::numeric;
use crate::commands::fk::value;
use crate::commands::path::limits::given;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{HEADING, note, styled};
use denavit::description::{Description, Measure};
use denavit::motion::plan::KnownLimits;
use denavit::quantity::{reading, torque_unit};
use denavit::space::JointSpace;
use denavit_identification::{Criterion, Excitation, Limits, NoExcitation, Search, excite, words};
use denavit_tables::{Column, written};
use denavit_wire::identification as wire;
use indicatif::{ProgressBar, ProgressStyle};
use std::f64::consts::PI;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// The most rows that are written.
const MOST_ROWS: f64 = 2e6;
/// Between two files that are written while a better motion is searched.
const BETWEEN: Duration = Duration::from_secs(2);

/// Searches a motion.
///
/// # Errors
/// If limits are not known or leave no room, or a file cannot be written.
pub fn run(subject: &Subject, arguments: &IdentifyArguments) -> Result<(), Failure> {
    if arguments.duration / arguments.dt > MOST_ROWS {
        return Err(Failure::Usage(format!(
            "--dt: {} s in steps of {} s are more than two million rows",
            arguments.duration, arguments.dt
        )));
    }
    let Some(description) = &subject.description else {
        return Err(Failure::Unsupported("--excite for whole trees: --tip takes a chain".into()));
    };
    let limits = limits(description, arguments)?;
    let search = Search {
        duration: arguments.duration,
        harmonics: usize::from(arguments.harmonics),
        seed: arguments.seed,
        trials: arguments.trials as usize,
        criterion: match arguments.criterion {
            CriterionOf::Determinant => Criterion::Determinant,
            CriterionOf::Condition => Criterion::Condition,
        },
    };
    let bar = bar(search.trials as u64);
    // What was found until then is there when the search is interrupted.
    let (mut last, mut shown, mut failed) = (Instant::now(), f64::NAN, None);
    let found = excite(&subject.model, &limits, &search, |best, tried| {
        bar.set_position(tried as u64);
        bar.set_message(format!("condition {}", words::short(best.condition)));
        let is_better = best.condition.to_bits() != shown.to_bits();
        if let Some(file) = arguments.output.as_deref().filter(|_| is_better && last.elapsed() > BETWEEN)
            && best.torque.is_none_or(|t| t <= 1.0)
        {
            (last, shown) = (Instant::now(), best.condition);
            failed = write(file, best, &subject.names, arguments.dt).err();
        }
        failed.is_none()
    });
    bar.finish_and_clear();
    if let Some(why) = failed {
        return Err(why);
    }
    let found = found.map_err(|why| match why {
        NoExcitation::Harmonics => Failure::Usage("--harmonics: at least 3".into()),
        NoExcitation::NoRoom(j) => {
            Failure::Usage(format!("{} has no room within its limits", subject.names[j]))
        }
        NoExcitation::Torques => Failure::No(
            "no motion that was tried keeps the torques within their limits\n  = hint: a longer --duration, a smaller --acceleration or --range, more --trials".into(),
        ),
    })?;
    if let Some(file) = &arguments.output {
        write(file, &found, &subject.names, arguments.dt)?;
    }
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&wire::Excitation::of(&subject.name, &found))),
        false => said(subject, description, arguments, &found),
    };
    write!(anstream::stdout(), "{text}")?;
    if arguments.output.is_none() && !arguments.json {
        note("note: -o FILE.csv writes the motion");
    }
    Ok(())
}

/// The motion in words.
fn said(subject: &Subject, d: &Description, arguments: &IdentifyArguments, found: &Excitation) -> String {
    let [start, ..] = found.at(0.0);
    let kinds = d.variables().into_iter().map(|v| v.kind);
    let at: Vec<String> = subject
        .names
        .iter()
        .zip(start)
        .zip(kinds)
        .map(|((name, x), kind)| format!("{name} = {}", reading(x, kind)))
        .collect();
    let mut text = format!(
        "{}: a Fourier series of {} harmonics, {} s, from rest to rest at the same place\n",
        styled(&subject.name, HEADING),
        arguments.harmonics,
        words::short(found.duration)
    );
    text += &format!("  it starts at {}\n", at.join(", "));
    text += &format!(
        "  condition number of the regressor of {} parameters, its columns of one size: {}\n",
        subject.model.parameters.len(),
        words::short(found.condition)
    );
    text += &format!(
        "  the best of {} motions that were tried; it is not known to be the best of all\n",
        found.trials
    );
    if let Some(part) = found.torque {
        text += &format!(
            "  torques take {} of their limits at most, at the times that were looked at\n",
            words::percent(part)
        );
    }
    text + "  positions, velocities and accelerations are within their limits at all times; whether the arm hits itself or anything else is not looked at\n"
}

/// Writes the motion: the time, joints, velocities, accelerations. Rows are `dt` apart; where these do not end with the motion, the last
/// one is behind it, at rest.
fn write(file: &Path, motion: &Excitation, names: &[String], dt: f64) -> Result<(), Failure> {
    let rows = (motion.duration / dt - 1e-9).ceil() as usize + 1;
    let times: Vec<f64> = (0..rows).map(|r| r as f64 * dt).collect();
    let states: Vec<[Vec<f64>; 3]> = times.iter().map(|t| motion.at(t.min(motion.duration))).collect();
    let mut columns = vec![Column { name: "t".into(), unit: None, values: times }];
    // The names that `identify` and `map` know.
    for (k, front) in ["", "qd", "qdd"].into_iter().enumerate() {
        for (j, name) in names.iter().enumerate() {
            let name = if k == 0 { name.clone() } else { format!("{front}{}", j + 1) };
            let values = states.iter().map(|s| s[k][j]).collect();
            columns.push(Column { name, unit: None, values });
        }
    }
    write_whole(file, &written(&columns))
}

/// What the joints may do.
fn limits(d: &Description, arguments: &IdentifyArguments) -> Result<Limits, Failure> {
    let own = |text: &Option<String>, option: &str| given(d, text, option, |kind| kind.into());
    let known = KnownLimits::of(d);
    let needed = |found: Option<Vec<f64>>, option: &str, what: &str| {
        found.ok_or_else(|| {
            Failure::Usage(format!(
                "{option}: the robot's file does not say the largest {what}: give one for all or one each"
            ))
        })
    };
    let velocity =
        needed(own(&arguments.velocity, "--velocity")?.or(known.velocity), "--velocity", "velocities")?;
    let acceleration = needed(
        own(&arguments.acceleration, "--acceleration")?.or(known.acceleration),
        "--acceleration",
        "accelerations",
    )?;
    let torque = given(d, &arguments.torque, "--torque", |kind| Measure::Other(torque_unit(kind)))?
        .map(|most| Ok::<_, Failure>((numeric(d, &arguments.robot.robot)?, most)))
        .transpose()?;
    Ok(Limits { position: positions(d, arguments.range.as_deref())?, velocity, acceleration, torque })
}

/// Where the joints may be: as it is told, as the file says, or half a turn to both sides.
fn positions(d: &Description, text: Option<&str>) -> Result<Vec<[f64; 2]>, Failure> {
    let variables = d.variables();
    if let Some(text) = text {
        let parts = load::list(text);
        let wrong = |why: String| Failure::Usage(format!("--range {text}: {why}"));
        if parts.len() != 1 && parts.len() != variables.len() {
            return Err(wrong(format!(
                "{} ranges; one for all, or one for each of {} joints",
                parts.len(),
                variables.len()
            )));
        }
        let one = |(k, v): (usize, &denavit::description::Variable)| {
            let part = parts[k.min(parts.len() - 1)];
            let (low, high) =
                part.split_once("..").ok_or_else(|| wrong(format!("`{part}`: write it as -90deg..90deg")))?;
            let number = |side: &str| load::value_of(side, v.kind.into()).and_then(value).map_err(&wrong);
            let range = [number(low)?, number(high)?];
            if range[0] < range[1] { Ok(range) } else { Err(wrong(format!("`{part}` is empty"))) }
        };
        return variables.iter().enumerate().map(one).collect();
    }
    let limits = JointSpace::without_lengths(d).limits;
    let mut free = vec![];
    let mut all = vec![];
    for (v, limit) in variables.iter().zip(limits) {
        match (limit, v.kind == denavit::description::JointKind::Revolute) {
            (Some(limit), _) => all.push(limit),
            (None, true) => {
                free.push(v.symbol.name().to_string());
                all.push([-PI, PI]);
            }
            (None, false) => {
                return Err(Failure::Usage(format!(
                    "--range: the robot's file does not say how far {} slides",
                    v.symbol.name()
                )));
            }
        }
    }
    if !free.is_empty() {
        note(&format!(
            "note: no limits are known of {}: half a turn to both sides is taken; --range",
            free.join(", ")
        ));
    }
    Ok(all)
}

/// A bar on standard error, where that is a terminal.
fn bar(trials: u64) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {eta} to go")
        .expect("a template of ours");
    ProgressBar::new(trials).with_style(style)
}
