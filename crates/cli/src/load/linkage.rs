//! Robots with closed loops that are no serial chain.

use super::{Around, contents, file, name_and_value, options, render, rows};
use crate::arguments::RobotArguments;
use crate::failure::{Failure, without_values};
use crate::terminal::note;
use denavit::closure::{Loops, findings};
use denavit::description::linkage::{Plan, is_passive};
use denavit::description::{
    ClosedChain, Convention, Described, Description, Linkage, MAX_BYTES, NotCoupled, Row, RowTree, Severity,
    read_par, read_robot,
};
use denavit::geometry::Transform;
use denavit_load::{Content, Kind, catalogue_name, listed};
use denavit_symbolic::{Expr, Symbol};

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
        (None, Some(kind @ Kind::Bodies)) => {
            let found = denavit_load::read(name, kind, &options(arguments)?).ok();
            found.and_then(
                |found| if let Content::Rows(read) = found.content { Some((read, vec![])) } else { None },
            )
        }
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
    said(arguments, &linkage)?;
    Ok(Some(linkage))
}

/// The linkage that the arguments name, if links move beside its serial chain that no tree with couplings has: its findings are said.
///
/// # Errors
/// As [`without_chain`] does.
pub fn beside_chain(arguments: &RobotArguments) -> Result<Option<Linkage>, Failure> {
    // Of a chain that is asked for by its ends there is that chain.
    let is_asked = arguments.base.is_some() || arguments.tip.is_some();
    let Some(linkage) = linkage(arguments)?.filter(|_| !is_asked) else { return Ok(None) };
    let chain = linkage.chain(None, None, arguments.mode.as_deref(), Convention::Khalil).ok();
    let closed = chain.as_ref().and_then(|c| c.closed.as_ref()).filter(|c| !c.beside.is_empty());
    if closed.is_none_or(|closed| with_beside(arguments, &linkage, closed).is_some()) {
        return Ok(None);
    }
    said(arguments, &linkage)?;
    Ok(Some(linkage))
}

/// What is worth saying of a linkage.
fn said(arguments: &RobotArguments, linkage: &Linkage) -> Result<(), Failure> {
    let name = arguments.robot.as_str();
    let is_listed = catalogue_name(name).is_some_and(|n| listed(&n).is_some());
    if !is_listed && Kind::of(name) == Some(Kind::Bodies) {
        file(arguments, Kind::Bodies)?; // what is worth saying of it is said
    } else if !is_listed {
        let text = contents(name, MAX_BYTES).unwrap_or_default();
        let found = findings(linkage);
        if found.iter().any(|d| d.severity == Severity::Error) {
            return Err(Failure::Input(render(&found, name, &text)));
        }
        note(render(&found, name, &text).trim_end());
    }
    Ok(())
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

/// A linkage of which all passive joints are couplings of driven ones.
pub struct WholeLinkage {
    /// Its rows, with joints counted as in the chain of it.
    pub tree: RowTree,
    /// The row at which the chain ends, and the tool there.
    pub tip: Option<usize>,
    /// The end of the chain in the frame of that row.
    pub tool: Transform<Expr>,
    /// Passive joints with friction or a rotor, which are left out.
    pub left_out: Vec<String>,
}

/// The linkage that the arguments name, with the links beside its chain, if all its passive joints are couplings of driven ones and these
/// are all on the chain, and some links are beside it: the chain, and what is around it.
///
/// # Errors
/// If a value cannot be set, or there is no such mode or frame.
pub fn whole(arguments: &RobotArguments) -> Result<Option<(Description, Around, WholeLinkage)>, Failure> {
    if arguments.base.is_some() {
        return Ok(None);
    }
    let Some(linkage) = linkage(arguments)? else { return Ok(None) };
    let content = Content::Rows(Described::Linkage(Box::new(linkage.clone())));
    let (description, around) = rows::taken(arguments, content)?;
    let Around::Rows(chain) = &around else { return Ok(None) };
    let Some(closed) = chain.closed.as_ref().filter(|c| !c.beside.is_empty()) else { return Ok(None) };
    let Some(whole) = with_beside(arguments, &linkage, closed) else { return Ok(None) };
    said(arguments, &linkage)?;
    note(&format!("note: {}", rows::couplings(closed)));
    note(&format!(
        "note: the whole linkage, the links beside the chain with it: {}",
        closed.beside.join(", ")
    ));
    if !whole.left_out.is_empty() {
        let names = whole.left_out.join(", ");
        note(&format!("warning: friction and rotors of passive joints ({names}) have no part in it"));
    }
    Ok(Some((description, around, whole)))
}

/// The whole of a linkage of which a chain was taken; nothing where not all driven joints are on the chain, or not all passive joints are
/// couplings.
fn with_beside(arguments: &RobotArguments, linkage: &Linkage, of: &ClosedChain) -> Option<WholeLinkage> {
    if linkage.driven().len() != of.driven.len() {
        return None; // some are beside the chain
    }
    let mut tree = closed_tree(arguments, linkage)?;
    let end = linkage.tree.end(None, arguments.tip.as_deref()).ok()?;
    let frame = linkage.tree.frames.iter().find(|f| f.name == end);
    let (tip, tool) = match frame {
        Some(f) => (f.on, f.pose),
        None => (linkage.tree.row_of(&end), Transform::identity()),
    };
    let drives = |row: &Row| row.rotor.is_some() || row.viscous.is_some() || row.coulomb.is_some();
    let left_out = (0..linkage.tree.rows.len()).filter(|&j| {
        let row = &linkage.tree.rows[j];
        drives(row) && row.variable.is_some_and(|v| is_passive(v.symbol))
    });
    let left_out = left_out.map(|j| linkage.tree.frame_name(j)).collect();
    let name =
        |s: Symbol| of.driven.iter().position(|o| *o == s).map(|k| Symbol::new(&format!("q{}", k + 1)));
    for row in &mut tree.rows {
        for cell in [&mut row.theta, &mut row.d] {
            *cell = cell.substitute(|s| name(s).map(Expr::from));
        }
        if let Some(v) = &mut row.variable {
            v.symbol = name(v.symbol).unwrap_or(v.symbol);
        }
    }
    Some(WholeLinkage { tree, tip, tool, left_out })
}

/// The tree of a linkage of which all passive joints are couplings of driven ones, proved, in the mode that is asked for.
pub(super) fn closed_tree(arguments: &RobotArguments, linkage: &Linkage) -> Option<RowTree> {
    let numbers = linkage.in_numbers();
    [linkage, &numbers].into_iter().find_map(|linkage| {
        let plan = Plan::of(linkage);
        let mode = linkage.mode(&plan, arguments.mode.as_deref()).ok()?;
        let (tree, is_left_out) = linkage.coupled(&plan, &mode);
        let all_affine = plan.affine(&mode).iter().all(|a| a.1.is_some()) && plan.unsolved.is_empty();
        let is_whole = !is_left_out.contains(&true) && all_affine;
        (is_whole && linkage.first_open(&plan, &mode).is_none()).then_some(tree)
    })
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
