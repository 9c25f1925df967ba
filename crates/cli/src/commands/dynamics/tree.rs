//! `dynamics --whole`: all joints of a tree.

use super::{Arm, Given, gravity, report};
use crate::arguments::DynamicsArguments;
use crate::commands::fk::tree::{bodies, configuration, joints, kind};
use crate::failure::Failure;
use crate::load;
use denavit::description::JointKind;
use denavit::dynamics::{OfTree, Unknown};
use std::io::Write;

/// Answers what is asked about a state of a tree.
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
    let found = OfTree::new(&m).map_err(|why| {
        let hint = match why {
            Unknown::NoMasses => {
                "\n  = hint: a URDF or an MJCF does; a tree of rows has them as mass, com and inertia"
            }
            Unknown::Unweighed(_) | Unknown::NoValue(_) | Unknown::NoAxis(_) => "",
        };
        Failure::Input(format!("error: {file}: {why}{hint}"))
    })?;
    let moving: Vec<(String, JointKind)> =
        joints(&m).into_iter().map(|j| (j.name.clone(), kind(j))).collect();
    let q = configuration(&m, arguments.q.as_deref())?;
    let given = Given::at_rest(&moving, arguments)?;
    let names = moving.iter().map(|j| j.0.clone()).collect();
    let arm = Arm { dynamics: found.dynamics, name: m.name.clone(), joints: names, exerts: None };
    let answer = arm.answer(given, q).map_err(|why| Failure::Input(format!("error: {why}")))?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => report::text(&arm.name, &moving, &answer),
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}
