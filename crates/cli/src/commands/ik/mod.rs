//! `denavit ik`: joint variables for a pose; the derivation of their formulas.

mod answer;
mod formats;
mod json;
mod pose;
mod stream;
mod summary;

use crate::arguments::{Format, IkArguments};
use crate::commands::fk::{configuration, without_values};
use crate::failure::Failure;
use crate::load;
use answer::{Question, Report};
use denavit::description::{Description, JointKind};
use denavit::inverse::explain::Explanation;
use denavit::inverse::{Goal, InverseModel, Options, Refusal};
use std::io::Write;

/// Solves a pose, or shows the derivation.
///
/// # Errors
/// If something cannot be read, there is no closed form, or the pose is not reachable.
pub fn run(arguments: &IkArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let goal: Goal = arguments.goal.into();
    let given = given(&description, arguments.given.as_deref())?;
    let options =
        Options { goal, given: arguments.given.is_some().then(|| given.iter().map(|g| g.0).collect()) };
    let is_numeric = arguments.pose.is_some() || arguments.q.is_some() || arguments.input.is_some();
    let model = match InverseModel::derive(&description, &options) {
        Ok(model) => model,
        Err(refusal) => return Err(refused(arguments, &description, &refusal, is_numeric)?),
    };
    if !is_numeric {
        let explanation = Explanation::of(&model);
        write!(anstream::stdout(), "{}", printed(arguments, &explanation))?;
        return Ok(());
    }
    let name = &arguments.robot.robot;
    let mut solver =
        model.solver(&description).map_err(|missing| without_values(&description, name, &missing))?;
    let at = arguments.q.as_deref().map(|text| configuration(&description, text)).transpose()?;
    let values = values(&description, &model, &given, at.as_deref())?;
    let question = Question::new(&description, &model, values);
    if let Some(path) = &arguments.input {
        return stream::run(&solver, &question, path);
    }
    let pose = match (&at, &arguments.pose) {
        (Some(q), _) => solver.robot.pose(q),
        (None, Some(text)) => pose::read(text, &arguments.orientation, goal)?,
        (None, None) => return Ok(()),
    };
    let answer = solver.solve(&pose, &question.given);
    let text = if arguments.json {
        question.json(&pose, &answer)
    } else {
        Report {
            question: &question,
            description: &description,
            pose: &pose,
            answer: &answer,
            at: at.as_deref(),
        }
        .text()
    };
    write!(anstream::stdout(), "{text}")?;
    if answer.is_reachable() { Ok(()) } else { Err(Failure::No(answer::obstacle(&description, &answer))) }
}

fn printed(arguments: &IkArguments, e: &Explanation) -> String {
    let format = if arguments.json { Format::Json } else { arguments.format };
    match (format, arguments.explain, arguments.symbolic) {
        (Format::Json, ..) => json::document(e),
        (_, true, _) => formats::document(e, &e.document(), format),
        (_, _, true) => formats::document(e, &e.summary(), format),
        (Format::Terminal, ..) => summary::text(e),
        // A format was asked for: the formulas.
        (_, false, false) => formats::document(e, &e.summary(), format),
    }
}

/// What was found before the derivation ended, and why it ended.
fn refused(
    arguments: &IkArguments,
    description: &Description,
    refusal: &Refusal,
    is_numeric: bool,
) -> Result<Failure, Failure> {
    let why = refusal.to_string();
    let stuck = match refusal {
        Refusal::Given(_) => return Ok(Failure::Usage(format!("--given: {why}"))),
        Refusal::Unsuitable(_) => None,
        Refusal::Stuck(stuck) => Some(stuck),
    };
    let mut out = anstream::stdout();
    match stuck {
        Some(_) | None if arguments.json && (is_numeric || stuck.is_none()) => {
            writeln!(out, "{}", json::refusal(description, &why))?;
        }
        Some(stuck) if !is_numeric => {
            let explanation = Explanation::of_stuck(description, stuck, arguments.goal.into());
            write!(out, "{}", printed(arguments, &explanation))?;
        }
        _ => {}
    }
    Ok(Failure::Unsupported(why))
}

/// Joints by name or number, with values where they are said.
fn given(description: &Description, text: Option<&str>) -> Result<Vec<(usize, Option<f64>)>, Failure> {
    let variables = description.variables();
    let mut found: Vec<(usize, Option<f64>)> = vec![];
    let bad = |why: String| Failure::Usage(format!("--given: {why}"));
    for part in text.unwrap_or_default().split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let (word, value) = match part.split_once('=') {
            Some((word, value)) => (word.trim(), Some(value)),
            None => (part, None),
        };
        let number = word.parse().ok().filter(|n| (1..=variables.len()).contains(n)).map(|n: usize| n - 1);
        let joint = number.or_else(|| variables.iter().position(|v| *v.symbol.name() == *word));
        let Some(joint) = joint else {
            let names: Vec<String> = variables.iter().map(|v| v.symbol.name().to_string()).collect();
            return Err(bad(format!("no joint `{word}`; there are {}", names.join(", "))));
        };
        if found.iter().any(|g| g.0 == joint) {
            return Err(bad(format!("{word} is given twice")));
        }
        let read = |text: &str| {
            let value = load::value_of(text, variables[joint].kind.into())?;
            crate::commands::fk::value(value)
        };
        let value = value.map(read).transpose().map_err(|why| bad(format!("{word}: {why}")))?;
        found.push((joint, value));
    }
    Ok(found)
}

/// Values of the given joints: as said, as they are in `-q`, or 0 (where the limits exclude that, their middle).
fn values(
    description: &Description,
    model: &InverseModel,
    given: &[(usize, Option<f64>)],
    at: Option<&[f64]>,
) -> Result<Vec<f64>, Failure> {
    let limits = crate::commands::fk::limits(description);
    let mut found = vec![];
    for &j in &model.given {
        let said = given.iter().find(|g| g.0 == j).and_then(|g| g.1);
        let value = match (said, at) {
            (Some(x), _) => x,
            (None, Some(q)) => q[j],
            (None, None) => {
                let (variable, limits) = &limits[j];
                let x = match limits {
                    Some([low, high]) if !(*low..=*high).contains(&0.0) => f64::midpoint(*low, *high),
                    _ => 0.0,
                };
                let (name, unit) = (
                    variable.symbol.name(),
                    if variable.kind == JointKind::Revolute { "30deg" } else { "0.2" },
                );
                writeln!(
                    anstream::stderr(),
                    "note: {name} is one joint too many; taken as {}, `--given {name}={unit}` chooses",
                    crate::commands::fk::reading(x, variable.kind)
                )?;
                x
            }
        };
        found.push(value);
    }
    Ok(found)
}
