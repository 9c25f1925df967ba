//! What the joints can do: from the robot file, or from the command line.

use crate::arguments::PathArguments;
use crate::failure::Failure;
use denavit::description::Description;
use denavit::motion::Limits;
use denavit_symbolic::{Expr, Symbol};

/// The limits, if velocities and accelerations of all joints are known.
///
/// # Errors
/// If an option cannot be read.
pub fn read(description: &Description, arguments: &PathArguments) -> Result<Option<Limits>, Failure> {
    let rows = || description.rows.iter().filter(|r| r.variable.is_some());
    let value = |s: Symbol| description.parameters.iter().find(|p| p.symbol == s)?.value?.eval(|_| None).ok();
    let known = |of: &dyn Fn(&denavit::description::Row) -> Option<Expr>| -> Option<Vec<f64>> {
        rows().map(|r| of(r)?.eval(value).ok()).collect()
    };
    let n = rows().count();
    let velocity = given(&arguments.velocity, "--velocity", n)?.or_else(|| known(&|r| r.velocity));
    let acceleration =
        given(&arguments.acceleration, "--acceleration", n)?.or_else(|| known(&|r| r.acceleration));
    let jerk = given(&arguments.jerk, "--jerk", n)?;
    let (Some(velocity), Some(acceleration)) = (velocity, acceleration) else {
        return match jerk {
            Some(_) => Err(Failure::Usage("--jerk: velocities and accelerations are needed too".into())),
            None => Ok(None),
        };
    };
    let bad = |e: denavit::motion::MotionError| Failure::Usage(e.to_string());
    let limits = Limits::symmetric(&velocity, &acceleration).map_err(bad)?;
    match jerk {
        Some(jerk) => limits.with_jerk(&jerk).map(Some).map_err(bad),
        None => Ok(Some(limits)),
    }
}

/// One value for all joints, or one each.
fn given(text: &Option<String>, option: &str, joints: usize) -> Result<Option<Vec<f64>>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let parts: Vec<&str> = text.split([',', ';', ' ']).filter(|p| !p.is_empty()).collect();
    let number = |p: &&str| match p.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(Failure::Usage(format!("{option}: `{p}` is no positive number"))),
    };
    let values: Vec<f64> = parts.iter().map(number).collect::<Result<_, _>>()?;
    match values.len() {
        1 => Ok(Some(vec![values[0]; joints])),
        k if k == joints => Ok(Some(values)),
        k => Err(Failure::Usage(format!(
            "{option}: {k} values; one for all, or one for each of {joints} joints"
        ))),
    }
}
