//! What the joints can do: from the command line, else from the robot file.

use crate::arguments::PathArguments;
use crate::commands::fk::value;
use crate::failure::Failure;
use crate::load;
use denavit::description::Description;
use denavit::motion::plan::KnownLimits;

/// The limits that are known.
///
/// # Errors
/// If an option cannot be read.
pub fn read(description: &Description, arguments: &PathArguments) -> Result<KnownLimits, Failure> {
    let given = |text: &Option<String>, option: &str| given(description, text, option);
    let asked = KnownLimits {
        velocity: given(&arguments.velocity, "--velocity")?,
        acceleration: given(&arguments.acceleration, "--acceleration")?,
        jerk: given(&arguments.jerk, "--jerk")?,
    };
    Ok(asked.or(KnownLimits::of(description)))
}

/// One value for all joints, or one each; `100deg/s` or a plain number.
fn given(
    description: &Description,
    text: &Option<String>,
    option: &str,
) -> Result<Option<Vec<f64>>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let variables = description.variables();
    let parts: Vec<&str> = text.split([',', ';', ' ']).filter(|p| !p.is_empty()).collect();
    let number = |part: &str, k: usize| -> Result<f64, Failure> {
        let length = part.split('/').next().unwrap_or(part);
        match load::value_of(length, variables[k].kind.into()).and_then(value) {
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
