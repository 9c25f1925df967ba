//! `dynamics` of closed loops: by couplings where these are what the passive joints are, otherwise by the closures, in numbers.

use super::{Answer, Energy, Given, Momentum, Schema, gravity, report, simulation};
use crate::arguments::DynamicsArguments;
use crate::commands::fk::linkage::{assemblies, configuration, limited, warn};
use crate::failure::Failure;
use crate::terminal::note;
use denavit::closure::Assembly;
use denavit::description::{JointKind, Linkage, RowTree};
use denavit::dynamics::{ClosedDynamics, DynamicModel, Formulas, Held, NoNumbers, Power, simulate_closed};
use denavit::quantity::reading;
use denavit_report::explain::rows_dynamics_vocabulary;
use std::io::Write;

/// The names of joints, with what they do.
pub type Joints = Vec<(String, JointKind)>;

/// Answers what is asked about a linkage whose passive joints are not all couplings of driven ones.
///
/// # Errors
/// If something is asked that is for serial chains, masses or values are missing, an option cannot be read, or nothing closes.
pub fn run(arguments: &DynamicsArguments, mut linkage: Linkage) -> Result<(), Failure> {
    let given = [
        (arguments.symbolic, "--symbolic"),
        (arguments.explain, "--explain"),
        (arguments.input.is_some(), "--input"),
        (arguments.derivatives, "--derivatives"),
        (arguments.payload.is_some(), "--payload"),
        (arguments.at.is_some(), "--at"),
        (arguments.step.is_some(), "--step"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Unsupported(format!(
            "{option} for closed loops whose passive joints are not couplings of the driven ones"
        )));
    }
    if let Some(text) = &arguments.gravity {
        linkage.tree.gravity = Some(gravity(text)?);
    }
    let file = &arguments.robot.robot;
    let of = ClosedDynamics::new(&linkage).map_err(|why| match why {
        NoNumbers::Missing(missing) => crate::failure::without_values(&linkage.all_rows(), file, &missing),
        NoNumbers::NoMasses => Failure::Input(format!(
            "error: {file}: it says nothing of masses\n  = hint: a tree of rows has them as mass, com and inertia"
        )),
        NoNumbers::NegativeMass(..) => {
            Failure::Input(format!("error: {file}: {why}; no motion follows from it"))
        }
    })?;
    let q = configuration(&linkage, arguments.q.as_deref())?;
    let kinds = |variables: Vec<denavit::description::Variable>| -> Joints {
        variables.iter().map(|v| (v.symbol.name().to_string(), v.kind)).collect()
    };
    let (driven, passive) = (kinds(linkage.driven()), kinds(linkage.passive()));
    let given = Given::at_rest(&driven, arguments)?;
    let wrench = arguments.wrench.as_deref().map(|text| super::numbers(text, "--wrench", 6)).transpose()?;
    let found = assemblies(of.loops(), arguments.robot.mode.as_deref(), &q)?;
    let meant = of.loops().mode(None).ok();
    // The mode that is meant, of those that close there.
    let assembly = found.all.iter().find(|a| Some(&a.mode) == meant.as_ref()).unwrap_or(&found.all[0]);
    warn(&linkage, &q, std::slice::from_ref(assembly));
    let others = found.all.len() - 1;
    if others > 0 {
        let modes: Vec<String> =
            found.all.iter().filter(|a| a.mode != assembly.mode).map(|a| a.mode.to_string()).collect();
        note(&format!(
            "note: in the mode {}; it closes in {} as well: --mode",
            assembly.mode,
            modes.join(", ")
        ));
    }
    let shown = Shown { linkage: &linkage, driven, passive, assembly };
    if let Some(duration) = arguments.simulate {
        if wrench.is_some() {
            return Err(Failure::Unsupported("--simulate with --wrench for closed loops".into()));
        }
        return simulated(&of, &shown, arguments, duration, &q, &given);
    }
    let held = of
        .at(&q, &assembly.passive)
        .map_err(|why| Failure::No(format!("{why}: torques of driven joints do not tell how it moves")))?;
    say_stuck(&of, &held, &given.qd, &shown);
    let holding = wrench.map(|w| -> Result<Vec<f64>, Failure> {
        let place = of.loops().place(arguments.robot.tip.as_deref());
        let (_, place) = place.map_err(|why| Failure::Usage(why.to_string()))?;
        let columns = of.loops().rates(&place, &q, &assembly.passive).frame.unwrap_or_default();
        Ok(columns.iter().map(|c| c.iter().zip(&w).map(|(a, b)| a * b).sum()).collect())
    });
    let answer = answer(&shown, &held, given, holding.transpose()?, q)?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => {
            let at = shown.passive.iter().zip(&assembly.passive);
            let at: Vec<String> =
                at.map(|((name, kind), &x)| format!("{name} = {}", reading(x, *kind))).collect();
            note(&format!("note: passive joints {}", at.join(", ")));
            report::text(&linkage.tree.name, &shown.driven, &answer)
        }
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}

/// Formulas of a linkage whose passive joints are couplings.
///
/// # Errors
/// If something is asked that is for serial chains, there is no such choice of base parameters, or nothing can be written.
pub fn symbolic(tree: &RowTree, arguments: &DynamicsArguments) -> Result<(), Failure> {
    if arguments.explain {
        return Err(Failure::Unsupported("--explain of closed loops: --symbolic has their torques".into()));
    }
    let formulas = Formulas::of_rows(tree);
    let model = match super::representatives(arguments)? {
        Some(wanted) => DynamicModel::of_tree_for(formulas, &wanted).map_err(|why| super::no_basis(&why))?,
        None => DynamicModel::of_tree(formulas),
    };
    let joints: Vec<String> = (0..tree.rows.len()).map(|j| tree.frame_name(j)).collect();
    let names = rows_dynamics_vocabulary(tree, &model);
    super::tree::printed(&tree.name, &joints, &model, &names, arguments)
}

/// What is said of a linkage in a mode.
struct Shown<'a> {
    linkage: &'a Linkage,
    driven: Joints,
    passive: Joints,
    assembly: &'a Assembly,
}

/// Says which joints stand still and have Coulomb's friction.
fn say_stuck(of: &ClosedDynamics, held: &Held<'_>, qd: &[f64], shown: &Shown<'_>) {
    let names = shown.driven.iter().chain(&shown.passive).map(|j| j.0.as_str());
    let all = names.zip(held.rates(qd)).zip(&of.tree().drives);
    super::say_still(
        all.filter(|((_, rate), drive)| *rate == 0.0 && drive.coulomb != 0.0).map(|((n, _), _)| n),
    );
}

fn answer(
    shown: &Shown<'_>,
    held: &Held<'_>,
    given: Given,
    holding: Option<Vec<f64>>,
    q: Vec<f64>,
) -> Result<Answer, Failure> {
    let Given { qd, qdd, tau, .. } = given;
    let n = q.len();
    let less = |all: &[f64], sign: f64| -> Vec<f64> {
        let held = holding.iter().flatten().copied().chain(std::iter::repeat(0.0));
        all.iter().zip(held).map(|(t, h)| t + sign * h).collect()
    };
    let accelerations = match &tau {
        None => None,
        Some(tau) => Some(held.under(&qd, &less(tau, -1.0)).map_err(|singular| {
            let name = &shown.driven[singular.joint].0;
            Failure::Input(format!("error: {}", super::without_mass(name)))
        })?),
    };
    let torques = tau.unwrap_or_else(|| {
        let pulled = qdd.clone().unwrap_or_else(|| vec![0.0; n]);
        less(&held.torques(&qd, &pulled), 1.0)
    });
    let [kinetic, potential] = held.energies(&qd);
    let (friction, gravity, momentum) = (held.friction(&qd), held.gravity(), held.momentum(&qd));
    let power = Power::of(&qd, &torques, &friction, &gravity, holding.as_deref());
    super::bounded(Answer {
        accelerations,
        derivatives: None,
        energy: Energy { kinetic, potential },
        friction,
        gravity,
        inertia: held.inertia(),
        mode: Some(shown.assembly.mode.to_string()),
        momentum: Momentum {
            angular: momentum.angular.0,
            centre: momentum.centre.0,
            linear: momentum.linear.0,
            mass: momentum.mass,
        },
        passive: Some(shown.assembly.passive.clone()),
        power: power.into(),
        robot: shown.linkage.tree.name.clone(),
        schema: Schema,
        torques,
        velocity: held.velocity(&qd),
        wrench: holding,
        q,
        qd,
        qdd,
    })
    .map_err(|why| Failure::Input(format!("error: {why}")))
}

/// Follows the motion of all joints.
fn simulated(
    of: &ClosedDynamics,
    shown: &Shown<'_>,
    arguments: &DynamicsArguments,
    duration: f64,
    q: &[f64],
    given: &Given,
) -> Result<(), Failure> {
    let torques = simulation::acting(arguments, given.tau.clone(), q.len())?;
    let dt = simulation::between(arguments, duration);
    let start = (q, shown.assembly.passive.as_slice(), given.qd.as_slice());
    let found = simulate_closed(of, start, &torques, (duration, dt), simulation::TOLERANCE);
    let (joints, limits) = limited(shown.linkage).into_iter().map(|(n, k, ends)| ((n, k), ends)).unzip();
    let moving = simulation::Moving { name: &shown.linkage.tree.name, joints, limits, is_closed: true };
    simulation::told(&moving, found, arguments, simulation::usual(), duration)
}
