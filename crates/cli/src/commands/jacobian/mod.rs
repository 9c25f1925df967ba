//! `denavit jacobian`: Jacobians, velocities and forces in numbers; formulas and singularities.

mod answer;
mod linkage;
mod report;
mod stream;
mod symbolic;

use crate::arguments::{Format, JacobianArguments};
use crate::commands::derive::reference;
use crate::commands::fk::{configuration, plural};
use crate::commands::parallel;
use crate::failure::{Failure, without_values};
use crate::load;
use answer::{Answer, Questions};
use denavit::Robot;
use denavit::description::{Description, JointKind, Measure};
use denavit::forward::Reference;
use denavit::geometry::Vector;
use denavit::geometry::orientation::OrientationSet;
use denavit::velocity::{Damping, JacobianModel, Viewpoint};
use denavit_symbolic::Expr;
use std::io::Write;

/// Answers what is asked about velocities and forces.
///
/// # Errors
/// If the robot, the configuration or an option cannot be read, a parameter has no value, or nothing can be written.
pub fn run(arguments: &JacobianArguments) -> Result<(), Failure> {
    if let Some((parallel, _)) = load::parallel(&arguments.robot)? {
        return parallel::jacobian(arguments, &parallel);
    }
    if let Some(closed) = load::without_chain(&arguments.robot)? {
        return linkage::run(arguments, &closed);
    }
    let description = load::robot(&arguments.robot)?;
    if arguments.frame == "shortest" && arguments.at.is_some() {
        return Err(Failure::Usage("--frame shortest chooses the point itself; leave --at away".into()));
    }
    if arguments.symbolic || arguments.explain {
        let format = if arguments.json { Format::Json } else { arguments.format };
        let view = (arguments.frame != "shortest").then(|| viewpoint(&description, arguments)).transpose()?;
        let body = body(&description, arguments)?;
        let what = match (arguments.explain, arguments.position) {
            (false, _) => symbolic::What::Matrix(view),
            (true, false) => symbolic::What::Singularities,
            (true, true) => symbolic::What::PositionSingularities,
        };
        let file = arguments.certificate.as_deref();
        let (text, certified) =
            symbolic::document(&description, body, what, format, arguments.language.tongue(), file)?;
        write!(anstream::stdout(), "{text}")?;
        return certified;
    }
    if arguments.certificate.is_some() {
        return Err(Failure::Usage("--certificate goes with --symbolic or --explain".into()));
    }
    let view = match arguments.frame.as_str() {
        "shortest" => JacobianModel::shortest(&description, body(&description, arguments)?).view,
        _ => viewpoint(&description, arguments)?,
    };
    let robot = Robot::numeric(&description)
        .map_err(|missing| without_values(&description, &arguments.robot.robot, &missing))?;
    match (&arguments.input, &arguments.q) {
        (Some(path), _) => stream::run(&description, &view, path),
        (None, Some(text)) => {
            let q = configuration(&description, text)?;
            let questions = questions(&description, arguments, robot.joints)?;
            let answer = Answer::new(&description, &robot, view, &q, questions);
            let text = if arguments.json {
                format!("{}\n", denavit_wire::text(&answer.wire()))
            } else {
                report::text(&answer)
            };
            write!(anstream::stdout(), "{text}")?;
            Ok(())
        }
        (None, None) => Err(Failure::Usage(format!(
            "say where the joints are: -q with {}; or --symbolic or --explain for formulas",
            plural(robot.joints, "value"),
        ))),
    }
}

fn body(description: &Description, arguments: &JacobianArguments) -> Result<Reference, Failure> {
    match reference(description, &arguments.of, "--of")? {
        Reference::Base | Reference::Frame(0) => {
            Err(Failure::Usage(format!("--of {}: the base does not move", arguments.of)))
        }
        body => Ok(body),
    }
}

fn viewpoint(description: &Description, arguments: &JacobianArguments) -> Result<Viewpoint<Expr>, Failure> {
    let body = body(description, arguments)?;
    let axes = reference(description, &arguments.frame, "--frame")?;
    let mut view = Viewpoint::of(body, axes);
    match arguments.at.as_deref() {
        None => {}
        Some(text) if text.contains(',') => {
            let parts: Vec<&str> = text.split(',').map(str::trim).collect();
            let [x, y, z] = parts[..] else {
                return Err(Failure::Usage(format!("--at {text}: a frame, or three lengths x, y, z")));
            };
            let length = |part: &str| {
                load::value_of(part, Measure::Length).map_err(|why| Failure::Usage(format!("--at: {why}")))
            };
            view.offset = Vector([length(x)?, length(y)?, length(z)?]);
        }
        Some(text) => view.at = reference(description, text, "--at")?,
    }
    Ok(view)
}

/// What is asked besides the Jacobian.
fn questions(
    description: &Description,
    arguments: &JacobianArguments,
    joints: usize,
) -> Result<Questions, Failure> {
    let set = arguments.orientation.as_deref().map(str::parse::<OrientationSet>).transpose();
    let orientation = set.map_err(|e| Failure::Usage(format!("--orientation: {e}")))?;
    if orientation.is_some() && (arguments.frame != "base" || arguments.at.is_some()) {
        return Err(Failure::Usage(
            "--orientation: the analytic Jacobian is of the body's own origin in the base; leave --frame and --at away"
                .into(),
        ));
    }
    let many = |text: &Option<String>, option: &str, n: usize| -> Result<Option<Vec<f64>>, Failure> {
        text.as_deref().map(|t| numbers(t, option, n)).transpose()
    };
    let twist = arguments.twist.as_deref().map(twist).transpose()?;
    let damping = match &arguments.damping {
        None => Damping::default(),
        Some(text) => match numbers(text, "--damping", 2)?[..] {
            [threshold, largest] if threshold >= 0.0 && (0.0..=threshold).contains(&largest) => {
                Damping { threshold, largest }
            }
            _ => {
                return Err(Failure::Usage(format!(
                    "--damping {text}: a threshold that is not negative, and at most as much damping, as in 0.04,0.02"
                )));
            }
        },
    };
    let torques = many(&arguments.torques, "--torques", joints)?;
    if torques.iter().flatten().any(|&t| t <= 0.0) {
        return Err(Failure::Usage("--torques: largest torques are positive".into()));
    }
    let rates = match &arguments.rates {
        None => None,
        Some(text) => Some(joint_rates(&joints_of(description), text, "--rates")?),
    };
    let wish = match &arguments.wish {
        None => vec![],
        Some(text) => joint_rates(&joints_of(description), text, "--wish")?,
    };
    Ok(Questions {
        orientation,
        rates,
        twist,
        damping,
        wish,
        wrench: many(&arguments.wrench, "--wrench", 6)?.and_then(|w| w.try_into().ok()),
        torques,
        hessian: arguments.hessian,
    })
}

/// Numbers separated by commas or blanks.
///
/// # Errors
/// If they are not `n`, or one is no finite number.
pub fn numbers(text: &str, option: &str, n: usize) -> Result<Vec<f64>, Failure> {
    let parts = parts(text);
    if parts.len() != n {
        return Err(Failure::Usage(format!("{option}: {} given, {n} needed", plural(parts.len(), "value"))));
    }
    let number = |part: &&str| match part.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(Failure::Usage(format!("{option}: `{part}` is no finite number"))),
    };
    parts.iter().map(number).collect()
}

fn parts(text: &str) -> Vec<&str> {
    load::list(text).into_iter().flat_map(str::split_whitespace).collect()
}

/// Six components, `-` where any will do.
fn twist(text: &str) -> Result<([f64; 6], [bool; 6]), Failure> {
    let given = parts(text);
    if given.len() != 6 {
        let found = plural(given.len(), "value");
        return Err(Failure::Usage(format!("--twist: {found} given, 6 needed: vx, vy, vz, wx, wy, wz")));
    }
    let (mut twist, mut rows) = ([0.0; 6], [true; 6]);
    for (k, part) in given.iter().enumerate() {
        if *part == "-" {
            rows[k] = false;
        } else {
            twist[k] = numbers(part, "--twist", 1)?[0];
        }
    }
    Ok((twist, rows))
}

/// Joint velocities or accelerations: radians or metres a second (squared), degrees and millimetres where a value says so.
///
/// # Errors
/// If they are not one a joint, or one is no value.
pub fn joint_rates(joints: &[(String, JointKind)], text: &str, option: &str) -> Result<Vec<f64>, Failure> {
    let separated = load::list(text);
    if separated.len() != joints.len() {
        let found = plural(separated.len(), "value");
        return Err(Failure::Usage(format!("{option}: {found} given, one a joint: {}", joints.len())));
    }
    let rate = |(part, (name, kind)): (&&str, &(String, JointKind))| {
        let value =
            ["/s^2", "/s²", "/s"].into_iter().find_map(|unit| part.strip_suffix(unit)).unwrap_or(part);
        let read = load::value_of(value, (*kind).into()).and_then(crate::commands::fk::value);
        read.map_err(|why| Failure::Usage(format!("{option}: {name}: {why}")))
    };
    separated.iter().zip(joints).map(rate).collect()
}

/// The joints of a chain by the names of their variables.
pub fn joints_of(description: &Description) -> Vec<(String, JointKind)> {
    description.variables().iter().map(|v| (v.symbol.name().to_string(), v.kind)).collect()
}
