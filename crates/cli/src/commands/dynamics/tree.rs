//! `dynamics --whole`: all joints of a tree.

use super::{Arm, Exerts, Given, gravity, no_basis, numbers, report, representatives, simulation, stream};
use crate::arguments::{DynamicsArguments, Format};
use crate::commands::document;
use crate::commands::fk::tree::{bodies, configuration, joints, kind};
use crate::failure::Failure;
use crate::load;
use denavit::description::{JointKind, Mechanism};
use denavit::dynamics::{DynamicModel, Formulas, Ground, OfTree, Unknown};
use denavit_report::explain::{tree_dynamics_document, tree_dynamics_vocabulary};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, readable};
use denavit_wire::dynamics::Model;
use std::io::Write;

/// Why there is no dynamic model of a tree.
pub fn unknown(file: &str, why: &Unknown) -> Failure {
    let hint = match why {
        Unknown::NoMasses => {
            "\n  = hint: a URDF or an MJCF does; a tree of rows has them as mass, com and inertia"
        }
        Unknown::Unweighed(_) | Unknown::NoValue(_) | Unknown::NoAxis(_) => "",
        Unknown::NegativeMass(_) => "; no motion follows from it",
    };
    Failure::Input(format!("error: {file}: {why}{hint}"))
}

/// The most literals of a base parameter's formula that are printed.
const MAX_LITERALS: u64 = 20_000;

/// A base parameter of which the formula is too long to be printed, and its literals.
fn too_long(model: &DynamicModel) -> Option<(String, u64)> {
    let long =
        |p: &denavit::dynamics::BaseParameter| (p.symbol.name().to_string(), readable::literals(p.value));
    model.base.parameters.iter().map(long).find(|(_, literals)| *literals > MAX_LITERALS)
}

/// Formulas of a tree.
fn symbolic(m: &Mechanism, arguments: &DynamicsArguments) -> Result<(), Failure> {
    let tree = OfTree::exact(m).map_err(|why| unknown(&arguments.robot.robot, &why))?;
    let formulas = Formulas::of_tree(&tree).with_names();
    let model = match representatives(arguments)? {
        Some(wanted) => DynamicModel::of_tree_for(formulas, &wanted).map_err(|why| no_basis(&why))?,
        None => DynamicModel::of_tree(formulas),
    };
    let names = tree_dynamics_vocabulary(m, &model);
    let joints: Vec<String> = m.joints.iter().map(|j| j.name.clone()).collect();
    printed(&m.name, &joints, &model, &names, arguments)
}

/// Prints the model of a tree whose joints have these names.
///
/// # Errors
/// If nothing can be written, or the torques are not Lagrange's.
pub fn printed(
    name: &str,
    joints: &[String],
    model: &DynamicModel,
    names: &Vocabulary,
    arguments: &DynamicsArguments,
) -> Result<(), Failure> {
    if let Some((long, literals)) = too_long(model) {
        return Err(Failure::GaveUp(format!(
            "{long} has {literals} literals as a formula, by axes and frames at no usual angles; `generate --whole` writes its program"
        )));
    }
    let tongue = arguments.language.tongue();
    let text = if arguments.json || arguments.format == Format::Json {
        let text = |e: Expr| print(e, names, Style::Ascii);
        format!("{}\n", denavit_wire::text(&Model::of(name, model, text)))
    } else {
        let title = tongue.words().dynamics_title(name);
        let blocks = tree_dynamics_document(name, joints, model, tongue);
        document::document_in(tongue, &title, names, &blocks, arguments.format)
    };
    write!(anstream::stdout(), "{text}")?;
    match model.ground {
        Ground::Failed => Err(Failure::GaveUp("the torques are not Lagrange's".into())),
        Ground::Proved | Ground::Modulo(_) | Ground::Numbers(..) => Ok(()),
    }
}

/// The body that exerts a wrench at the origin of its frame.
fn exerted_by(m: &Mechanism, tree: &OfTree<f64>, link: &str) -> Result<Exerts, Failure> {
    let place = m.body(link).and_then(|body| tree.places[body]);
    match place.ok_or_else(|| Failure::Usage(format!("--at {link}: there is no such link")))? {
        (Some(link), place) => Ok(Exerts::Link(link, place.translation)),
        (None, _) => Ok(Exerts::Root),
    }
}

/// Answers what is asked about states of a tree.
///
/// # Errors
/// If it is no tree, masses or values are missing, an option cannot be read, or nothing can be written.
pub fn run(arguments: &DynamicsArguments) -> Result<(), Failure> {
    let file = &arguments.robot.robot;
    let tree = load::mechanism(&arguments.robot)?
        .ok_or_else(|| Failure::Usage(format!("--whole: {file} is no tree: leave it away")))?;
    let mut m = bodies(&tree, file)?;
    if let Some(text) = &arguments.gravity {
        m.gravity = Some(gravity(text)?);
    }
    if arguments.symbolic {
        return symbolic(&m, arguments);
    }
    let found = OfTree::new(&m).map_err(|why| unknown(file, &why))?;
    let moving: Vec<(String, JointKind)> =
        joints(&m).into_iter().map(|j| (j.name.clone(), kind(j))).collect();
    let exerts = arguments.at.as_deref().map(|link| exerted_by(&m, &found, link)).transpose()?;
    let wrench = arguments.wrench.as_deref().map(|text| numbers(text, "--wrench", 6)).transpose()?;
    let mut given = Given::at_rest(&moving, arguments)?;
    given.wrench = wrench.and_then(|w| w.try_into().ok());
    let names = moving.iter().map(|j| j.0.clone()).collect();
    let arm = Arm { dynamics: found.dynamics, name: m.name.clone(), joints: names, exerts, is_whole: false };
    if let Some(path) = &arguments.input {
        return stream::run(&arm, &given, path);
    }
    let q = configuration(&m, arguments.q.as_deref())?;
    if let Some(duration) = arguments.simulate {
        let moving = simulation::Moving {
            name: &m.name,
            joints: moving,
            limits: m.variable_limits(),
            is_closed: false,
        };
        return simulation::run(&moving, &arm, arguments, duration, &q, given);
    }
    arm.say_stuck(&given.qd);
    let answer = arm.answer(given, q).map_err(|why| Failure::Input(format!("error: {why}")))?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => report::text(&arm.name, &moving, &answer),
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}
