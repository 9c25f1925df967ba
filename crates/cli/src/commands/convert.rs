//! `denavit convert`: a robot in another format, read back and held against itself.

use crate::arguments::{ConvertArguments, ConvertFormat};
use crate::commands::report::put;
use crate::failure::Failure;
use crate::load;
use crate::terminal::note;
use denavit::Robot;
use denavit::description::{
    Decimals, Description, prove_same_chain, read_toml, read_urdf, write_toml, write_urdf,
};
use denavit::random::Random;
use std::f64::consts::PI;

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
    const SAMPLES: usize = 256;
    let Some(back) = back.filter(|b| b.variables().len() == robot.variables().len()) else {
        return note("note: what was written was not held against the robot");
    };
    if prove_same_chain(robot, back).is_equal() || prove_same_chain(&robot.in_numbers(), back).is_equal() {
        return note("note: read back, it is proved to be the same robot");
    }
    let (Ok(a), Ok(b)) = (Robot::numeric(robot), Robot::numeric(back)) else {
        return note("note: what was written was not held against the robot: parameters have no values");
    };
    let mut random = Random(20);
    let mut most = 0.0_f64;
    for _ in 0..SAMPLES {
        let q: Vec<f64> = robot.variables().iter().map(|_| (2.0 * random.unit() - 1.0) * PI).collect();
        let [x, y] = [&a, &b].map(|r| r.pose(&q).matrix().concat());
        most = x.iter().zip(y).fold(most, |most, (x, y)| most.max((x - y).abs()));
    }
    note(&format!("note: read back, its poses differ by {most:.0e} at most in {SAMPLES} configurations"));
}
