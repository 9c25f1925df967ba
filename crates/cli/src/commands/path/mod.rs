//! `denavit path`: joint and Cartesian paths, followed, timed and sampled.

pub mod limits;
mod motion;
mod plot;
mod report;
mod request;
mod samples;

use crate::arguments::{PathArguments, PathFormat};
use crate::failure::{Failure, without_values};
use crate::load;
use crate::terminal::note;
use denavit::Robot;
use denavit_wire::path::Path;
use std::io::Write;

/// Plans a path and prints it.
///
/// # Errors
/// If the robot, a way-point or an option cannot be read; if the path cannot be followed to its end; if nothing can be
/// written.
pub fn run(arguments: &PathArguments) -> Result<(), Failure> {
    let (description, around) = load::robot_and_around(&arguments.robot)?;
    let robot = Robot::numeric(&description)
        .map_err(|missing| without_values(&description, &arguments.robot.robot, &missing))?;
    let wish = request::read(&description, &robot, arguments)?;
    let limits = limits::read(&description, &around, arguments)?;
    let planned = motion::plan(&description, &robot, wish, &limits, arguments)?;
    let sampled = planned.sampled(&description, &robot, arguments.dt);
    let sampled = sampled.map_err(|why| Failure::Usage(format!("--dt: {why}")))?;
    let format = if arguments.json { PathFormat::Json } else { arguments.format };
    let text = match format {
        PathFormat::Text => report::text(&description, &planned, &sampled),
        PathFormat::Csv => samples::csv(&sampled, &description),
        PathFormat::Ndjson => samples::ndjson(&sampled),
        PathFormat::Json => {
            let path = Path::of(&description, &planned, samples::samples(&sampled));
            format!("{}\n", denavit_wire::text(&path))
        }
    };
    if let Some(file) = &arguments.plot {
        let picture = plot::picture(&description, &planned, &sampled);
        std::fs::write(file, picture)
            .map_err(|e| Failure::Input(format!("error: --plot {}: {e}", file.display())))?;
    }
    write!(anstream::stdout(), "{text}")?;
    if matches!(format, PathFormat::Csv | PathFormat::Ndjson) {
        note(&report::remarks(&description, &planned));
    }
    motion::verdict(&planned)
}
