//! `denavit ik`: joint variables for a pose; the derivation of their formulas.

mod answer;
mod linkage;
pub mod pose;
mod stream;
mod summary;

use crate::arguments::{Format, IkArguments};
use crate::commands::fk::configuration;
use crate::commands::{certificate, document, parallel};
use crate::failure::{Failure, without_values};
use crate::load;
use crate::terminal::{note, words};
use answer::{Question, Report, Wanted};
use denavit::Robot;
use denavit::description::{Description, JointKind};
use denavit::idealise::{Ideal, idealised};
use denavit::inverse::{
    Criterion, Goal, InverseKinematics, InverseModel, InverseOptions, Refusal, Unprepared,
};
use denavit::quantity::reading;
use denavit_report::document::Block;
use denavit_report::explain::Explanation;
use denavit_report::words::Tongue;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_wire::derivation::Derivation;
use denavit_wire::inverse::Refused;
use std::io::Write;

/// Solves a pose, or shows the derivation.
///
/// # Errors
/// If something cannot be read, there is no closed form, or the pose is not reachable.
pub fn run(arguments: &IkArguments) -> Result<(), Failure> {
    if let Some((parallel, _)) = load::parallel(&arguments.robot)? {
        return parallel::ik(arguments, &parallel);
    }
    if let Some(closed) = load::without_chain(&arguments.robot)? {
        return linkage::run(arguments, &closed);
    }
    let loaded = load::robot(&arguments.robot)?;
    let name = &arguments.robot.robot;
    let ideal = match arguments.idealise {
        Some(tolerance) => Some(ideal(&loaded, name, tolerance)?),
        None => None,
    };
    let description = ideal.as_ref().map_or_else(|| loaded.clone(), |i| i.description.clone());
    let goal = arguments.goal();
    let given = given(&description, arguments.given.as_deref())?;
    let options = InverseOptions {
        goal,
        given: arguments.given.is_some().then(|| given.iter().map(|g| g.0).collect()),
    };
    if arguments.follow && arguments.input.is_none() {
        return Err(Failure::Usage("--follow goes with --input".into()));
    }
    let is_numeric = arguments.pose.is_some() || arguments.q.is_some() || arguments.input.is_some();
    if !is_numeric {
        let model = match InverseModel::derive(&description, &options) {
            Ok(model) => model,
            Err(refusal) => return Err(refused(arguments, &description, &refusal)?),
        };
        let position = Explanation::of_its_position(&model);
        write!(anstream::stdout(), "{}", printed(arguments, &Explanation::of(&model), position.as_ref()))?;
        if (arguments.json || arguments.format != Format::Terminal) && position.is_some() {
            note(BY_POSITION);
        }
        return match &arguments.certificate {
            Some(file) => certificate::write(file, denavit_certificate::inverse(&model)),
            None => Ok(()),
        };
    }
    let mut solver =
        InverseKinematics::new(&description, &options).map_err(|why| unprepared(&description, name, &why))?;
    for near in &solver.nearly {
        note(&format!("note: {}; solved as it stands, `--idealise` takes it so", words().nearly(near)));
    }
    let at = arguments.q.as_deref().map(|text| configuration(&description, text)).transpose()?;
    let read = |text: &str| configuration(&description, text);
    let near = arguments.near.as_deref().map(read).transpose().map_err(|e| match e {
        Failure::Usage(text) => Failure::Usage(text.replacen("-q:", "--near:", 1)),
        other => other,
    })?;
    solver.seed = near.clone().or_else(|| at.clone());
    let near = near.or_else(|| arguments.follow.then(|| vec![0.0; solver.robot.joints]));
    let criterion = near.map(Criterion::Nearest).or_else(|| arguments.best.map(Criterion::from));
    let wanted = Wanted {
        one: arguments.one,
        within_limits: arguments.limits,
        copies: arguments.input.is_none() && !arguments.one,
    };
    let values = values(&description, &solver.given, &given, at.as_deref())?;
    let question = Question::new(&description, &solver, values, (criterion, wanted), ideal.as_ref());
    if let Some(path) = &arguments.input {
        return stream::run(&solver, &question, path, arguments.follow);
    }
    let pose = match (&at, &arguments.pose) {
        // The arm as it is reaches that pose, an idealised one next to it.
        (Some(q), _) => Robot::numeric(&loaded).map_err(|why| without_values(&loaded, name, &why))?.pose(q),
        (None, Some(text)) => pose::read(text, &arguments.orientation, goal)?,
        (None, None) => return Ok(()),
    };
    let found = question.ask(&solver, &pose, at.as_deref());
    let answer = &found.answer;
    let text = if arguments.json {
        format!("{}\n", denavit_wire::text(&question.wire(&pose, &found)))
    } else {
        Report {
            solver: &solver,
            question: &question,
            description: &description,
            pose: &pose,
            answer,
            left_out: found.left_out,
            at: at.as_deref(),
            nearest: found.best.as_ref(),
        }
        .text()
    };
    write!(anstream::stdout(), "{text}")?;
    if goal == Goal::Pose && solver.serves_positions() {
        note(BY_POSITION);
    }
    if found.excluded() {
        return Err(Failure::No("there are solutions, and the limits exclude all of them".into()));
    }
    if answer.is_reachable() { Ok(()) } else { Err(Failure::No(answer::obstacle(&description, answer))) }
}

/// Said of an arm that serves positions.
const BY_POSITION: &str =
    "note: this arm has the freedoms of a position, not of a pose: `--position` asks for that alone";

/// The robot cannot be solved as it is given.
pub fn unprepared(description: &Description, name: &str, why: &Unprepared) -> Failure {
    match why {
        Unprepared::Missing(missing) => without_values(description, name, missing),
        Unprepared::Lengths(_) => Failure::Usage(format!("{name}: {why}")),
        Unprepared::Given(why) => Failure::Usage(format!("--given: {why}")),
    }
}

/// The special arm beside a nearly special one; what changed goes to standard error.
fn ideal(description: &Description, name: &str, tolerance: f64) -> Result<Ideal, Failure> {
    if !(0.0..=0.1).contains(&tolerance) {
        return Err(Failure::Usage("--idealise: a tolerance lies between 0 and 0.1".into()));
    }
    let ideal =
        idealised(description, tolerance).map_err(|missing| without_values(description, name, &missing))?;
    for snap in &ideal.snaps {
        let kind = if snap.what.is_angle() { JointKind::Revolute } else { JointKind::Prismatic };
        let (from, to) = (reading(snap.from, kind), reading(snap.to, kind));
        let (what, (first, second)) = (words().measured(snap.what), snap.axes);
        note(&format!("note: {what} of axes {first} and {second}: {from} taken as {to}"));
    }
    if ideal.snaps.is_empty() {
        note(&format!("note: nothing is nearly special up to {tolerance}"));
        return Ok(ideal);
    }
    let (turn, shift) = (ideal.rotation_error, ideal.position_error);
    note(&format!("note: the hand is off by up to {turn:.1e} rad and {shift:.1e} m for that"));
    Ok(ideal)
}

/// The derivation, or its formulas; on a terminal those of the position alone behind it, if there are any.
fn printed(arguments: &IkArguments, e: &Explanation, position: Option<&Explanation>) -> String {
    let format = if arguments.json { Format::Json } else { arguments.format };
    let language = arguments.language.tongue();
    let title = language.words().inverse_title(&e.description.name);
    let written =
        |blocks: &[Block], names: &Vocabulary| document::document_in(language, &title, names, blocks, format);
    let position = position.filter(|_| format == Format::Terminal);
    let names = position.map_or_else(|| e.names(), |p| e.names_with(p));
    match (format, arguments.explain, arguments.symbolic) {
        (Format::Json, ..) => format!("{}\n", denavit_wire::text(&Derivation::of(e))),
        (_, true, _) => {
            let whole = position.map_or_else(|| e.document(language), |p| e.document_with(p, language));
            written(&whole, &names)
        }
        (_, _, true) => {
            let formulas = position.map_or_else(|| e.summary(language), |p| e.summary_with(p, language));
            written(&formulas, &names)
        }
        (Format::Terminal, ..) if language == Tongue::English => {
            let alone = |p: &Explanation| {
                format!("\nThe position alone (`--position`):\n\n{}\n", summary::text(p).trim_end())
            };
            summary::text(e) + &position.map(alone).unwrap_or_default()
        }
        // A format or a language was asked for: the formulas.
        (_, false, false) => {
            let formulas = position.map_or_else(|| e.summary(language), |p| e.summary_with(p, language));
            written(&formulas, &names)
        }
    }
}

/// What was found before the derivation ended, and why it ended.
fn refused(
    arguments: &IkArguments,
    description: &Description,
    refusal: &Refusal,
) -> Result<Failure, Failure> {
    let why = refusal.to_string();
    let stuck = match refusal {
        Refusal::Given(_) => return Ok(Failure::Usage(format!("--given: {why}"))),
        Refusal::Unsuitable(_) => None,
        Refusal::Stuck(stuck) => Some(stuck),
    };
    let mut out = anstream::stdout();
    match stuck {
        None if arguments.json => writeln!(out, "{}", denavit_wire::text(&Refused::of(description, &why)))?,
        Some(stuck) => {
            let explanation = Explanation::of_stuck(description, stuck, arguments.goal());
            write!(out, "{}", printed(arguments, &explanation, None))?;
        }
        None => {}
    }
    let numbers = "; `--pose` and `-q` are answered in numbers all the same";
    Ok(Failure::Unsupported(format!("{why}{numbers}")))
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
        let joint = load::joint(description, word).map_err(bad)?;
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
    chosen: &[usize],
    given: &[(usize, Option<f64>)],
    at: Option<&[f64]>,
) -> Result<Vec<f64>, Failure> {
    let limits = crate::commands::fk::limits(description);
    let mut found = vec![];
    for &j in chosen {
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
                let taken = reading(x, variable.kind);
                note(&format!(
                    "note: {name} is one joint too many; taken as {taken}, `--given {name}={unit}` chooses"
                ));
                x
            }
        };
        found.push(value);
    }
    Ok(found)
}
