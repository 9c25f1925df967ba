//! Robots with closed loops that are no serial chain.

use super::{Around, contents, name_and_value, options, render, rows};
use crate::arguments::RobotArguments;
use crate::failure::{Failure, without_values};
use crate::terminal::note;
use denavit::closure::{Loops, findings};
use denavit::description::{
    Convention, Described, Description, Linkage, MAX_BYTES, NotCoupled, Severity, read_par, read_robot,
};
use denavit_load::{Content, Kind, catalogue_name, listed};

/// The linkage that the arguments name, with the values that they set, if it is one; nothing is said of it, and what cannot be read is
/// none.
///
/// # Errors
/// If a value cannot be set.
pub fn linkage(arguments: &RobotArguments) -> Result<Option<Linkage>, Failure> {
    let name = arguments.robot.as_str();
    if name == "-" {
        return Ok(None); // it can be read but once
    }
    let listed = catalogue_name(name).and_then(|n| listed(&n));
    let read = match (listed, Kind::of(name)) {
        (Some(text), _) => read_robot(text).ok(),
        (None, Some(Kind::Robot)) => contents(name, MAX_BYTES).ok().and_then(|text| read_robot(&text).ok()),
        (None, Some(Kind::Par)) => {
            let decimals = options(arguments)?.decimals();
            contents(name, MAX_BYTES).ok().and_then(|text| read_par(&text, decimals).ok())
        }
        _ => None,
    };
    let Some((Described::Linkage(mut linkage), _)) = read else { return Ok(None) };
    set(arguments, &mut linkage)?;
    Ok(Some(*linkage))
}

/// The linkage that the arguments name, if it is one of which the chain asked for is not serial: its findings are said.
///
/// # Errors
/// If a value cannot be set, there is no such mode or frame, or a loop cannot be assembled.
pub fn without_chain(arguments: &RobotArguments) -> Result<Option<Linkage>, Failure> {
    let Some(linkage) = linkage(arguments)? else { return Ok(None) };
    let (base, tip, mode) = (arguments.base.as_deref(), arguments.tip.as_deref(), arguments.mode.as_deref());
    match linkage.chain(base, tip, mode, Convention::Khalil) {
        Err(NotCoupled::NotAffine { .. } | NotCoupled::NotProved(_)) => {}
        _ => return Ok(None),
    }
    if arguments.base.is_some() {
        return Err(Failure::Usage(
            "--base: closed loops that are no serial chain are seen from their base".into(),
        ));
    }
    let name = arguments.robot.as_str();
    let is_listed = catalogue_name(name).is_some_and(|n| listed(&n).is_some());
    if !is_listed {
        let text = contents(name, MAX_BYTES).unwrap_or_default();
        let found = findings(&linkage);
        if found.iter().any(|d| d.severity == Severity::Error) {
            return Err(Failure::Input(render(&found, name, &text)));
        }
        note(render(&found, name, &text).trim_end());
    }
    Ok(Some(linkage))
}

/// Gives parameters of a linkage the values that the arguments set.
///
/// # Errors
/// If there is no such parameter, or the value cannot be read.
pub fn set(arguments: &RobotArguments, linkage: &mut Linkage) -> Result<(), Failure> {
    let mut d: Description = linkage.all_rows();
    for setting in &arguments.set {
        let (name, value) = name_and_value(setting)?;
        d.set(&name, &value).map_err(|why| Failure::Usage(format!("--set {setting}: {why}")))?;
    }
    linkage.tree.parameters = d.parameters;
    Ok(())
}

/// The linkage in numbers.
///
/// # Errors
/// If a length has no value.
pub fn loops(arguments: &RobotArguments, linkage: &Linkage) -> Result<Loops, Failure> {
    Loops::new(linkage).map_err(|missing| without_values(&linkage.all_rows(), &arguments.robot, &missing))
}

/// The chain of a linkage.
///
/// # Errors
/// If there is none.
pub fn chain(
    arguments: &RobotArguments,
    mut linkage: Box<Linkage>,
) -> Result<(Description, Around), Failure> {
    set(arguments, &mut linkage)?;
    rows::chain(arguments, Content::Rows(Described::Linkage(linkage)))
}
