//! Parallel robots by their names or files.

use super::{check_options, contents, name_and_value, render};
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::note;
use denavit::description::parallel::Parallel;
use denavit::description::{MAX_BYTES, PARALLEL_VERBS, read_parallel};
use denavit_load::{Kind, catalogue_name};
use denavit_parallel::catalogue;

/// The parallel robot that the arguments name, with the values that they set, and its text, if it is one; its findings are said.
///
/// # Errors
/// If its file has errors, a value cannot be set, or an option is for other robots.
pub fn parallel(arguments: &RobotArguments) -> Result<Option<(Parallel, String)>, Failure> {
    let name = arguments.robot.as_str();
    let listed = catalogue_name(name).and_then(|n| catalogue::text(&n));
    let text = match (listed, Kind::of(name)) {
        (Some(text), _) => text.to_string(),
        (None, Some(Kind::Robot)) => match contents(name, MAX_BYTES) {
            Ok(text) => text,
            Err(_) => return Ok(None), // whoever reads it next says why
        },
        _ => return Ok(None),
    };
    let Some(read) = read_parallel(&text) else { return Ok(None) };
    let (mut parallel, findings) = read.map_err(|found| Failure::Input(render(&found, name, &text)))?;
    check_options(arguments, listed.is_some())?;
    if arguments.base.is_some() || arguments.tip.is_some() {
        return Err(Failure::Usage(
            "--base and --tip: a parallel robot has its base and its platform alone".into(),
        ));
    }
    note(render(&findings, name, &text).trim_end());
    for setting in &arguments.set {
        let (name, value) = name_and_value(setting)?;
        parallel.set(&name, &value).map_err(|why| Failure::Usage(format!("--set {setting}: {why}")))?;
    }
    Ok(Some((parallel, text)))
}

/// A parallel robot is refused: said by verbs that are for chains.
///
/// # Errors
/// If the arguments name one.
pub fn no_parallel(arguments: &RobotArguments) -> Result<(), Failure> {
    match parallel(arguments)? {
        None => Ok(()),
        Some((parallel, _)) => Err(Failure::Unsupported(format!(
            "{} is a parallel robot, and this is for chains: {PARALLEL_VERBS}",
            parallel.name
        ))),
    }
}
