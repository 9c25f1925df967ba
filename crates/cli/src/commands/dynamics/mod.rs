//! `denavit dynamics`: torques, inertia, accelerations in numbers; base parameters and torques as formulas.

mod report;

use crate::arguments::{DynamicsArguments, Format};
use crate::commands::document;
use crate::commands::fk::{configuration, plural, without_values};
use crate::commands::jacobian::{joint_rates, numbers};
use crate::failure::Failure;
use crate::load;
use crate::terminal::{note, words};
use denavit::description::Description;
use denavit::dynamics::{
    DynamicModel, Dynamics, GRAVITY, Ground, NoNumbers, Wrench, direct_dynamics, drive_torques, friction,
    gravity_torques, inertia_matrix, inverse_dynamics, kinetic_energy, potential_energy, velocity_torques,
};
use denavit::geometry::{Body, Vector};
use denavit_report::explain::{dynamics_document, dynamics_vocabulary};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::{Expr, Rational};
use denavit_wire::Schema;
use denavit_wire::dynamics::{Answer, Energy, Model};
use std::io::Write;

/// Answers what is asked about dynamics.
///
/// # Errors
/// If the robot or an option cannot be read, masses or values are missing, or nothing can be written.
pub fn run(arguments: &DynamicsArguments) -> Result<(), Failure> {
    let (mut description, around) = load::robot_and_around(&arguments.robot)?;
    if let Some(text) = &arguments.gravity {
        description.gravity = Some(gravity(text)?);
    }
    let held = around.held_joints();
    if !held.is_empty() {
        note(&format!(
            "note: what hangs on the chain behind {} counts as fixed where these joints are at 0",
            held.join(", ")
        ));
    }
    if arguments.symbolic {
        return symbolic(&description, arguments);
    }
    let Some(text) = &arguments.q else {
        return Err(Failure::Usage(format!(
            "say where the joints are: -q with {}; or --symbolic for formulas",
            plural(description.variables().len(), "value"),
        )));
    };
    let arm = Dynamics::numeric(&description).map_err(|why| match why {
        NoNumbers::NoMasses => Failure::Input(format!(
            "error: {}: it says nothing of masses\n  = hint: a URDF does, or mass, com and inertia in a robot file; \
             --symbolic gives formulas",
            arguments.robot.robot
        )),
        NoNumbers::Missing(missing) => without_values(&description, &arguments.robot.robot, &missing),
    })?;
    check_bodies(&description, &arm);
    let q = configuration(&description, text)?;
    let answer = answer(&description, &arm, arguments, q)?;
    let text = match arguments.json {
        true => format!("{}\n", denavit_wire::text(&answer)),
        false => report::text(&description, &answer),
    };
    write!(anstream::stdout(), "{text}")?;
    Ok(())
}

/// Says which links are no bodies.
fn check_bodies(description: &Description, arm: &Dynamics<f64>) {
    for (k, link) in arm.links.iter().enumerate() {
        if let Err(why) = link.body.check() {
            let name = description.rows[link.row].name.as_ref();
            let name = name.map_or(String::new(), |n| format!(" ({n})"));
            note(&format!("warning: link {}{name}: {}", k + 1, words().no_body(why)));
        }
        if link.body == Body::nothing() {
            note(&format!("note: link {} has no mass", k + 1));
        }
    }
}

fn answer(
    description: &Description,
    arm: &Dynamics<f64>,
    arguments: &DynamicsArguments,
    q: Vec<f64>,
) -> Result<Answer, Failure> {
    let n = arm.joints();
    let rates = |text: &Option<String>, option: &str| -> Result<Option<Vec<f64>>, Failure> {
        text.as_deref().map(|t| joint_rates(description, t, option)).transpose()
    };
    let qd = rates(&arguments.qd, "--qd")?.unwrap_or_else(|| vec![0.0; n]);
    let qdd = rates(&arguments.qdd, "--qdd")?;
    let tau = arguments.tau.as_deref().map(|t| numbers(t, "--tau", n)).transpose()?;
    let wrench: Option<Wrench<f64>> = match arguments.wrench.as_deref() {
        None => None,
        Some(text) => {
            let w = numbers(text, "--wrench", 6)?;
            Some([Vector([w[0], w[1], w[2]]), Vector([w[3], w[4], w[5]])])
        }
    };
    let accelerations = match &tau {
        None => None,
        Some(tau) => Some(direct_dynamics(arm, &q, &qd, tau, wrench.as_ref()).map_err(|singular| {
            let name = description.variables()[singular.joint].symbol.name().to_string();
            Failure::Input(format!(
                "error: {name} moves no mass of its own: no acceleration follows from torques\n  = hint: give its link a mass \
                 and an inertia, or the joint a rotor"
            ))
        })?),
    };
    let torques = tau.unwrap_or_else(|| {
        let pulled = qdd.clone().unwrap_or_else(|| vec![0.0; n]);
        drive_torques(arm, &q, &qd, &pulled, wrench.as_ref())
    });
    let held = wrench.as_ref().map(|w| {
        let still = vec![0.0; n];
        let with = inverse_dynamics(arm, &q, &still, &still, Some(w));
        with.iter().zip(gravity_torques(arm, &q)).map(|(a, b)| a - b).collect()
    });
    Ok(Answer {
        accelerations,
        energy: Energy { kinetic: kinetic_energy(arm, &q, &qd), potential: potential_energy(arm, &q) },
        friction: friction(arm, &qd),
        gravity: gravity_torques(arm, &q),
        inertia: inertia_matrix(arm, &q),
        robot: description.name.clone(),
        schema: Schema,
        torques,
        velocity: velocity_torques(arm, &q, &qd),
        wrench: held,
        q,
        qd,
        qdd,
    })
}

/// A direction, or three components.
fn gravity(text: &str) -> Result<[Expr; 3], Failure> {
    let size = Rational::new(GRAVITY.0, GRAVITY.1);
    let o = Rational::ZERO;
    let along = |axis: usize, size: Rational| -> [Rational; 3] {
        std::array::from_fn(|i| if i == axis { size.clone() } else { o.clone() })
    };
    let components = match text.trim().trim_start_matches('+') {
        "none" | "0" => [o.clone(), o.clone(), o.clone()],
        "x" => along(0, size),
        "-x" => along(0, -&size),
        "y" => along(1, size),
        "-y" => along(1, -&size),
        "z" => along(2, size),
        "-z" => along(2, -&size),
        _ => {
            let read: Option<Vec<Rational>> =
                load::list(text).into_iter().map(Rational::from_decimal).collect();
            read.and_then(|all| <[Rational; 3]>::try_from(all).ok()).ok_or_else(|| {
                Failure::Usage(format!(
                    "--gravity {text}: x, -x, y, -y, z, -z, none, or three components in m/s², as in 0,-9.81,0"
                ))
            })?
        }
    };
    Ok(components.map(Expr::from))
}

fn symbolic(description: &Description, arguments: &DynamicsArguments) -> Result<(), Failure> {
    let model = DynamicModel::derive(description);
    let names = dynamics_vocabulary(description, &model);
    let tongue = arguments.language.tongue();
    let text = if arguments.json || arguments.format == Format::Json {
        let text = |e: Expr| print(e, &names, Style::Ascii);
        format!("{}\n", denavit_wire::text(&Model::of(&description.name, &model, text)))
    } else {
        let blocks = dynamics_document(description, &model, tongue);
        let title = tongue.words().dynamics_title(&description.name);
        document::document_in(tongue, &title, &names, &blocks, arguments.format)
    };
    write!(anstream::stdout(), "{text}")?;
    match model.ground {
        Ground::Failed => Err(Failure::GaveUp("the torques are not Lagrange's".into())),
        _ => Ok(()),
    }
}
