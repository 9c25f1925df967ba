//! What the joints can do: from the robot file, or from the command line.

use crate::arguments::PathArguments;
use crate::commands::fk::value;
use crate::failure::Failure;
use crate::load;
use denavit::description::{Description, Row};
use denavit::motion::{Limits, MotionError};
use denavit_symbolic::{Expr, Symbol};

/// What is known of the joints.
pub struct Known {
    /// Largest velocities, one a joint, if all are known.
    pub velocity: Option<Vec<f64>>,
    /// Velocities and accelerations, perhaps jerks, if all are known.
    pub all: Option<Limits>,
}

/// The limits that are known.
///
/// # Errors
/// If an option cannot be read.
pub fn read(description: &Description, arguments: &PathArguments) -> Result<Known, Failure> {
    let of = |s: Symbol| description.parameters.iter().find(|p| p.symbol == s)?.value?.eval(|_| None).ok();
    let in_file = |cell: &dyn Fn(&Row) -> Option<Expr>| -> Option<Vec<f64>> {
        let rows = description.rows.iter().filter(|r| r.variable.is_some());
        rows.map(|r| cell(r)?.eval(of).ok()).collect()
    };
    let given = |text: &Option<String>, option: &str| given(description, text, option);
    let velocity = given(&arguments.velocity, "--velocity")?.or_else(|| in_file(&|r| r.velocity));
    let acceleration =
        given(&arguments.acceleration, "--acceleration")?.or_else(|| in_file(&|r| r.acceleration));
    let jerk = given(&arguments.jerk, "--jerk")?;
    let all = match (&velocity, &acceleration) {
        (Some(v), Some(a)) if !v.is_empty() => {
            let bad = |e: MotionError| Failure::Usage(e.to_string());
            let limits = Limits::symmetric(v, a).map_err(bad)?;
            Some(match jerk {
                Some(jerk) => limits.with_jerk(&jerk).map_err(bad)?,
                None => limits,
            })
        }
        _ if jerk.is_some() => return Err(both("--jerk")),
        _ if arguments.law.is_some() => return Err(both("--law")),
        _ => None,
    };
    Ok(Known { velocity, all })
}

fn both(option: &str) -> Failure {
    Failure::Usage(format!("{option}: velocities and accelerations of all joints are needed too"))
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
