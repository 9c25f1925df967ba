//! What is described in rows, one chain or a tree, and the chain of it that a command is about.

use super::linkage::set;
use super::{Around, file, unknown_robot};
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::{note, words};
use denavit::description::{ClosedChain, Described, Description, Language, NoChain, NotCoupled};
use denavit_load::{Content, Kind, NotTaken};
use denavit_report::words::{Tongue, Whole};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// The chain of what was read, and what is around it; a description that is one already has no `--base` and `--tip`.
///
/// # Errors
/// If there is no such chain.
pub fn chain(arguments: &RobotArguments, content: Content) -> Result<(Description, Around), Failure> {
    let (description, around) = taken(arguments, content)?;
    if let Around::Rows(chain) = &around {
        if let Some(closed) = &chain.closed {
            note(&format!("note: {}", couplings(closed)));
            if !closed.beside.is_empty() {
                note(&format!(
                    "note: links beside the chain have no masses in it: {}",
                    closed.beside.join(", ")
                ));
            }
        }
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
    let mode = arguments.mode.as_deref();
    content.chain(name, base, tip, mode, arguments.convention.map(Into::into)).map_err(|why| match why {
        NotTaken::NoChain(why) => no_chain(name, &why),
        NotTaken::NotCoupled(NotCoupled::NoMode(why)) => Failure::Usage(format!("--mode: {name}: {why}")),
        NotTaken::NotCoupled(why) => {
            let hint = "`show`, `fk`, `jacobian`, `ik` and `dynamics` serve it as it is";
            Failure::Unsupported(format!("{name}: {why}\n  = hint: {hint}"))
        }
        NotTaken::NoLoops => Failure::Usage(format!("--mode is for closed loops, and {name} has none")),
        NotTaken::OneChain => {
            let option = if base.is_some() { "--base" } else { "--tip" };
            Failure::Usage(format!("{option} is for URDF files and trees, and {name} is one chain"))
        }
    })
}

/// How a chain was taken out of closed loops.
pub fn couplings(closed: &ClosedChain) -> String {
    let mode = match (&closed.mode_name, closed.mode.to_string().as_str()) {
        (_, "") => String::new(),
        (Some(name), signs) => format!(" in the mode {name} ({signs})"),
        (None, signs) => format!(" in the mode {signs}"),
    };
    let relation = |(s, e): &(Symbol, Expr)| format!("{} = {}", s.name(), plain(*e));
    let relations: Vec<String> = closed.passive.iter().map(relation).collect();
    let how = if closed.is_of_values { "proved for the values of the lengths" } else { "proved" };
    let mut text = match &relations[..] {
        [] => format!("closed loops{mode}"),
        all => format!("closed loops{mode}: {}; {how}", all.join(", ")),
    };
    if !closed.untested.is_empty() {
        let names = closed.untested.join(", ");
        text += &format!(
            "\nwarning: nothing is proved of {names}, whose passive joints are not affine: the chain is taken to move wherever it is, and they \
             close only as far as they reach"
        );
    }
    if !closed.meets.is_empty() {
        let zeros: Vec<String> = closed.meets.iter().map(|e| format!("{} = 0", plain(*e))).collect();
        text += &format!(
            "\nnote: its loops are flat, and modes meet, where {}: a parallel singularity",
            zeros.join(" or ")
        );
    }
    let renamed = closed.driven.iter().enumerate().filter_map(|(k, s)| {
        let own = format!("q{}", k + 1);
        (*s.name() != *own).then(|| format!("{own} is {}", s.name()))
    });
    let renamed: Vec<String> = renamed.collect();
    if !renamed.is_empty() {
        text += &format!("\nnote: joints are counted along the chain: of the file, {}", renamed.join(", "));
    }
    if !closed.without_limits.is_empty() {
        let names = closed.without_limits.join(", ");
        text += &format!(
            "\nwarning: the limits of {names} are not held: a chain has no place for those of passive joints"
        );
    }
    text
}

/// An angle or a length as the table shows it.
fn plain(e: Expr) -> String {
    denavit_report::document::plain(
        &denavit_report::cell(e, true, Tongue::English.words()),
        &Vocabulary::new(),
    )
}

/// Reads the file of `.par` that the arguments name.
///
/// # Errors
/// If it cannot be read or has errors.
pub fn par(arguments: &RobotArguments) -> Result<Content, Failure> {
    match file(arguments, Kind::Par)?.content {
        Content::Bodies(_) => Err(unknown_robot(&arguments.robot)),
        content => Ok(content),
    }
}

/// The chain of a `.par` file that the arguments name.
///
/// # Errors
/// If the file cannot be read or has errors, or there is no such chain.
pub fn from_par(arguments: &RobotArguments) -> Result<(Description, Around), Failure> {
    let mut content = par(arguments)?;
    if let Content::Rows(Described::Linkage(linkage)) = &mut content {
        set(arguments, linkage)?;
    }
    if let Content::Par(tree) = &content
        && tree.is_chain()
        && arguments.base.is_none()
        && arguments.tip.is_none()
    {
        let (description, _) = taken(arguments, content)?;
        return Ok((description, Around::Nothing));
    }
    chain(arguments, content)
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
        (arguments.mode.is_some(), "--mode"),
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
