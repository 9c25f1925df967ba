//! What the joints can do: from the command line, else from the robot file.

use crate::arguments::PathArguments;
use crate::commands::dynamics::numeric;
use crate::commands::fk::value;
use crate::failure::Failure;
use crate::load::{self, Around};
use denavit::description::{Description, JointKind, Measure};
use denavit::motion::TorqueLimits;
use denavit::motion::plan::KnownLimits;
use denavit::quantity::torque_unit;

/// The limits that are known.
///
/// # Errors
/// If an option cannot be read.
pub fn read(
    description: &Description,
    around: &Around,
    arguments: &PathArguments,
) -> Result<KnownLimits, Failure> {
    let given = |text: &Option<String>, option: &str| given(description, text, option, |kind| kind.into());
    let asked = KnownLimits {
        velocity: given(&arguments.velocity, "--velocity")?,
        acceleration: given(&arguments.acceleration, "--acceleration")?,
        jerk: given(&arguments.jerk, "--jerk")?,
        torque: torques(description, around, arguments)?,
    };
    Ok(asked.or(KnownLimits::of(description)))
}

/// What the drives of an arm with masses can do: as it is given, or as its file has it.
fn torques(
    description: &Description,
    around: &Around,
    arguments: &PathArguments,
) -> Result<Option<TorqueLimits>, Failure> {
    let limits = match arguments.torque.as_deref().map(str::trim) {
        Some("file") => Some(efforts(description, around, &arguments.robot.robot)?),
        _ => given(description, &arguments.torque, "--torque", |kind| Measure::Other(torque_unit(kind)))?,
    };
    let Some(limits) = limits else { return Ok(None) };
    let limits = TorqueLimits::symmetric(numeric(description, &arguments.robot.robot)?, &limits);
    limits.map(Some).map_err(|why| Failure::Usage(format!("--torque: {why}")))
}

/// The efforts of a file of bodies and joints.
fn efforts(description: &Description, around: &Around, file: &str) -> Result<Vec<f64>, Failure> {
    let wrong = |why: String| Failure::Input(format!("error: --torque file: {file}: {why}"));
    let efforts = around.efforts().ok_or_else(|| wrong("it has no efforts; a URDF may".into()))?;
    let named = efforts.into_iter().zip(description.variables());
    let one = |(effort, v): (Option<f64>, denavit::description::Variable)| {
        effort.filter(|e| e.is_finite() && *e > 0.0).ok_or_else(|| {
            wrong(format!(
                "it says nothing of the effort of {}\n  = hint: --torque with a value each",
                v.symbol.name()
            ))
        })
    };
    named.map(one).collect()
}

/// One value for all joints, or one each; `100deg/s` or a plain number.
///
/// # Errors
/// If a value cannot be read, or there are others than joints.
pub fn given(
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
