//! What is described in rows, one chain or a tree, and the chain of it that a command is about.

use super::{Around, file, unknown_robot};
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::{note, words};
use denavit::description::{Described, Description, Language, NoChain, RowTree};
use denavit_load::{Content, Kind, NotTaken};
use denavit_report::words::Whole;

/// The chain of what was read, and what is around it; a description that is one already has no `--base` and `--tip`.
///
/// # Errors
/// If there is no such chain.
pub fn chain(arguments: &RobotArguments, content: Content) -> Result<(Description, Around), Failure> {
    let (description, around) = taken(arguments, content)?;
    if let Around::Rows(chain) = &around {
        let joints = description.variables().len();
        let joints = format!("{joints} joint{}", if joints == 1 { "" } else { "s" });
        let rows = match chain.agreement {
            None => "its rows as they stand".to_string(),
            Some(agreement) => words().agreement(agreement, Whole::Tree),
        };
        note(&format!("note: from `{}` to `{}`, {joints}; {rows}", chain.from, chain.to));
        if let Some(why) = &chain.unweighed {
            note(&format!("warning: {why}"));
        }
    }
    Ok((description, around))
}

/// The chain that the arguments name.
///
/// # Errors
/// If there is none.
pub fn taken(arguments: &RobotArguments, content: Content) -> Result<(Description, Around), Failure> {
    let name = arguments.robot.as_str();
    let (base, tip) = (arguments.base.as_deref(), arguments.tip.as_deref());
    content.chain(name, base, tip, arguments.convention.map(Into::into)).map_err(|why| match why {
        NotTaken::NoChain(why) => no_chain(name, &why),
        NotTaken::OneChain => {
            let option = if base.is_some() { "--base" } else { "--tip" };
            Failure::Usage(format!("{option} is for URDF files and trees, and {name} is one chain"))
        }
    })
}

/// Reads the file of `.par` that the arguments name.
///
/// # Errors
/// If it cannot be read or has errors.
pub fn par(arguments: &RobotArguments) -> Result<RowTree, Failure> {
    match file(arguments, Kind::Par)?.content {
        Content::Par(tree) => Ok(*tree),
        Content::Rows(_) | Content::Bodies(_) => Err(unknown_robot(&arguments.robot)),
    }
}

/// The chain of a `.par` file that the arguments name.
///
/// # Errors
/// If the file cannot be read or has errors, or there is no such chain.
pub fn from_par(arguments: &RobotArguments) -> Result<(Description, Around), Failure> {
    let tree = par(arguments)?;
    if tree.is_chain() && arguments.base.is_none() && arguments.tip.is_none() {
        let (description, _) = taken(arguments, Content::Par(Box::new(tree)))?;
        return Ok((description, Around::Nothing));
    }
    chain(arguments, Content::Par(Box::new(tree)))
}

/// The robot that a program makes.
///
/// # Errors
/// If the file cannot be read or has errors.
pub fn from_program(
    arguments: &RobotArguments,
    language: Language,
) -> Result<(Description, Around), Failure> {
    let name = arguments.robot.as_str();
    let given = [
        (arguments.convention.is_some(), "--convention"),
        (arguments.angles.is_some(), "--angles"),
        (arguments.lengths.is_some(), "--lengths"),
        (arguments.columns.is_some(), "--columns"),
        (arguments.base.is_some(), "--base"),
        (arguments.tip.is_some(), "--tip"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Usage(format!("{option} is not for programs: {name} says it itself")));
    }
    match file(arguments, Kind::Program(language))?.content {
        Content::Rows(Described::Chain(description)) => Ok((*description, Around::Nothing)),
        Content::Rows(_) | Content::Par(_) | Content::Bodies(_) => Err(unknown_robot(name)),
    }
}

/// Why there is no chain, with the option that helps.
fn no_chain(name: &str, why: &NoChain) -> Failure {
    let text = format!("{name}: {why}");
    match why {
        NoChain::Several(_) => Failure::Usage(format!("{text}\n  = hint: choose one with --tip LINK")),
        NoChain::Unknown { .. } => Failure::Usage(text),
        NoChain::NeedsValues(_) => {
            Failure::Input(format!("error: {text}\n  = hint: give them values in the file"))
        }
        NoChain::Rigid { .. } | NoChain::TooLong(_) | NoChain::NoDirection(_) => {
            Failure::Input(format!("error: {text}"))
        }
    }
}
