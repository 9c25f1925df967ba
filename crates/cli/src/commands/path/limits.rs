//! What the joints can do: from the command line, else from the robot file.

use crate::arguments::PathArguments;
use crate::commands::fk::{value, without_values};
use crate::failure::Failure;
use crate::load;
use denavit::description::{Description, JointKind, Measure};
use denavit::dynamics::{Dynamics, NoNumbers};
use denavit::motion::TorqueLimits;
use denavit::motion::plan::KnownLimits;

/// The limits that are known.
///
/// # Errors
/// If an option cannot be read.
pub fn read(description: &Description, arguments: &PathArguments) -> Result<KnownLimits, Failure> {
    let given = |text: &Option<String>, option: &str| given(description, text, option, |kind| kind.into());
    let asked = KnownLimits {
        velocity: given(&arguments.velocity, "--velocity")?,
        acceleration: given(&arguments.acceleration, "--acceleration")?,
        jerk: given(&arguments.jerk, "--jerk")?,
        torque: torques(description, arguments)?,
    };
    Ok(asked.or(KnownLimits::of(description)))
}

/// What the drives of an arm with masses can do.
fn torques(description: &Description, arguments: &PathArguments) -> Result<Option<TorqueLimits>, Failure> {
    let unit = |kind| Measure::Other(if kind == JointKind::Revolute { "N m" } else { "N" });
    let Some(limits) = given(description, &arguments.torque, "--torque", unit)? else { return Ok(None) };
    let arm = Dynamics::numeric(description).map_err(|why| match why {
        NoNumbers::NoMasses => Failure::Input(format!(
            "error: {}: it says nothing of masses\n  = hint: a URDF does, or mass, com and inertia in a robot file",
            arguments.robot.robot
        )),
        NoNumbers::Missing(missing) => without_values(description, &arguments.robot.robot, &missing),
    })?;
    let limits = TorqueLimits::symmetric(arm, &limits);
    limits.map(Some).map_err(|why| Failure::Usage(format!("--torque: {why}")))
}

/// One value for all joints, or one each; `100deg/s` or a plain number.
fn given(
    description: &Description,
    text: &Option<String>,
    option: &str,
    measure: impl Fn(JointKind) -> Measure,
) -> Result<Option<Vec<f64>>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let variables = description.variables();
    // `5 N m` is one value.
    let is_one = variables.first().is_some_and(|v| load::value_of(text, measure(v.kind)).is_ok());
    let parts = if is_one { vec![text.as_str()] } else { load::list(text) };
    let number = |part: &str, k: usize| -> Result<f64, Failure> {
        let measure = measure(variables[k].kind);
        // Per second, squared or cubed, goes without saying.
        let plain = part.split('/').next().unwrap_or(part);
        let text = if matches!(measure, Measure::Other(_)) { part } else { plain };
        match load::value_of(text, measure).and_then(value) {
            Ok(x) if x > 0.0 => Ok(x),
            Ok(_) => Err(Failure::Usage(format!("{option}: `{part}` is not positive"))),
            Err(why) => Err(Failure::Usage(format!("{option}: {}: {why}", variables[k].symbol.name()))),
        }
    };
    match parts.len() {
        1 => (0..variables.len()).map(|k| number(parts[0], k)).collect::<Result<_, _>>().map(Some),
        n if n == variables.len() => {
            parts.iter().enumerate().map(|(k, p)| number(p, k)).collect::<Result<_, _>>().map(Some)
        }
        n => Err(Failure::Usage(format!(
            "{option}: {n} values; one for all, or one for each of {} joints",
            variables.len()
        ))),
    }
}
