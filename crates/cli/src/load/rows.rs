//! What is described in rows, one chain or a tree, and the chain of it that a command is about.

use super::{Around, file, unknown_robot};
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::{note, words};
use denavit::description::{Convention, Described, Description, Language, NoChain, RowTree};
use denavit_load::{Content, Kind};
use denavit_report::words::Whole;

/// The chain of what was read, and what is around it; a description that is one already has no `--base` and `--tip`.
///
/// # Errors
/// If there is no such chain.
pub fn chain(arguments: &RobotArguments, described: Described) -> Result<(Description, Around), Failure> {
    let name = arguments.robot.as_str();
    let tree = match described {
        Described::Chain(d) => {
            let given = [(&arguments.base, "--base"), (&arguments.tip, "--tip")];
            return match given.into_iter().find(|g| g.0.is_some()) {
                None => Ok((*d, Around::Nothing)),
                Some((_, option)) => Err(Failure::Usage(format!(
                    "{option} is for URDF files and trees, and {name} is one chain"
                ))),
            };
        }
        Described::Tree(tree) => tree,
    };
    of_tree(arguments, &tree, Convention::Khalil)
}

/// The chain of a tree that the arguments name.
fn of_tree(
    arguments: &RobotArguments,
    tree: &RowTree,
    usual: Convention,
) -> Result<(Description, Around), Failure> {
    let name = arguments.robot.as_str();
    let convention = arguments.convention.map_or(usual, Into::into);
    let (base, tip) = (arguments.base.as_deref(), arguments.tip.as_deref());
    let chain = tree.chain(base, tip, convention).map_err(|why| no_chain(name, &why))?;
    let joints = chain.description.variables().len();
    let joints = format!("{joints} joint{}", if joints == 1 { "" } else { "s" });
    let rows = match chain.agreement {
        None => "its rows as they stand".to_string(),
        Some(agreement) => words().agreement(agreement, Whole::Tree),
    };
    note(&format!("note: from `{}` to `{}`, {joints}; {rows}", chain.from, chain.to));
    if let Some(why) = &chain.unweighed {
        note(&format!("warning: {why}"));
    }
    Ok((chain.description.clone(), Around::Rows(Box::new(chain))))
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
    let given = arguments.base.is_some() || arguments.tip.is_some();
    if tree.is_chain() && !given {
        let convention = arguments.convention.map_or(Convention::Khalil, Into::into);
        let chain = tree.chain(None, None, convention);
        let chain = chain.map_err(|why| no_chain(&arguments.robot, &why))?;
        return Ok((chain.description, Around::Nothing));
    }
    of_tree(arguments, &tree, Convention::Khalil)
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
pub fn no_chain(name: &str, why: &NoChain) -> Failure {
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
