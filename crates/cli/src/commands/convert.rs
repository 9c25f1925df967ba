//! `denavit convert`: a robot in another format, read back and held against itself.

use crate::arguments::{ConvertArguments, ConvertFormat};
use crate::commands::report::put;
use crate::failure::Failure;
use crate::load;
use crate::terminal::note;
use denavit::description::{Decimals, Description, read_toml, read_urdf, write_toml, write_urdf};
use denavit::mechanism::{COMPARED, Comparison, compare};

/// Writes a robot in another format.
///
/// # Errors
/// If there is no such robot, a parameter has no value, or nothing can be written.
pub fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let robot = load::robot(&arguments.robot)?;
    let converted = match arguments.written_as {
        Some(to) => robot.converted(to.into()).description,
        None => robot.clone(),
    };
    let (text, back) = match arguments.to {
        ConvertFormat::Toml => {
            let text = write_toml(&converted);
            let back = read_toml(&text).ok().map(|r| r.0);
            (text, back)
        }
        ConvertFormat::Urdf => {
            let text = write_urdf(&converted).map_err(|missing| {
                let names: Vec<String> = missing.iter().map(|s| s.name().to_string()).collect();
                Failure::Input(format!("error: no value for {}; give it with --set", names.join(", ")))
            })?;
            let read = read_urdf(&text, Decimals::Meant).ok();
            let chain = read.and_then(|(m, _)| m.chain(Some("base"), Some("tool"), robot.convention).ok());
            (text, chain.map(|c| c.description))
        }
    };
    put(&arguments.output, text.as_bytes())?;
    say_same(&robot, back.as_ref());
    Ok(())
}

/// Says how what was written is the robot.
fn say_same(robot: &Description, back: Option<&Description>) {
    let Some(back) = back else {
        return note(
            "note: what was written was not held against the robot: it does not read back as one chain",
        );
    };
    note(&match compare(robot, back) {
        Comparison::Proved => "note: read back, it is proved to be the same robot".to_string(),
        Comparison::Sampled(by) => {
            format!("note: read back, its poses differ by {by:.0e} at most in {COMPARED} configurations")
        }
        Comparison::OtherJoints => "note: read back, it has other joints than the robot".into(),
        Comparison::NoNumbers(missing) => {
            format!("note: what was written was not held against the robot: {missing}")
        }
    });
}
