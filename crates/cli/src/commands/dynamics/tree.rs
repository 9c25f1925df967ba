//! `dynamics --whole`: all joints of a tree.

use super::{Arm, Given, gravity, report};
use crate::arguments::DynamicsArguments;
use crate::commands::fk::tree::{bodies, configuration, joints, kind};
use crate::commands::fk::{plural, value};
use crate::failure::Failure;
use crate::load;
use denavit::description::{JointKind, Measure};
use denavit::dynamics::{OfTree, Unknown};
use denavit::quantity::torque_unit;
use denavit::velocity::Viewpoint;
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
    let plain = |kind: JointKind| kind.into();
    let given = Given {
        qd: values(&moving, arguments.qd.as_deref(), "--qd", plain)?
            .unwrap_or_else(|| vec![0.0; moving.len()]),
        qdd: values(&moving, arguments.qdd.as_deref(), "--qdd", plain)?,
        tau: values(&moving, arguments.tau.as_deref(), "--tau", |kind| Measure::Other(torque_unit(kind)))?,
        wrench: None,
    };
    let names = moving.iter().map(|j| j.0.clone()).collect();
    let (name, at) = (m.name.clone(), Viewpoint::tool());
    let arm = Arm { dynamics: found.dynamics, robot: None, name, joints: names, at };
    let answer = arm.answer(given, q).map_err(|why| Failure::Input(format!("error: {why}")))?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => report::text(&arm.name, &moving, &answer),
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}

/// A value a joint; per second, or squared, goes without saying.
fn values(
    joints: &[(String, JointKind)],
    text: Option<&str>,
    option: &str,
    measure: impl Fn(JointKind) -> Measure,
) -> Result<Option<Vec<f64>>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let parts = load::list(text);
    if parts.len() != joints.len() {
        let (there, wanted) = (plural(parts.len(), "value"), plural(joints.len(), "joint"));
        return Err(Failure::Usage(format!("{option}: {there} given, the tree has {wanted}")));
    }
    let one = |(part, (name, kind)): (&str, &(String, JointKind))| {
        let measure = measure(*kind);
        let plain = part.split('/').next().unwrap_or(part);
        let text = if matches!(measure, Measure::Other(_)) { part } else { plain };
        let read = load::value_of(text, measure).and_then(value);
        read.map_err(|why| Failure::Usage(format!("{option}: {name}: {why}")))
    };
    parts.into_iter().zip(joints).map(one).collect::<Result<_, _>>().map(Some)
}
