//! `denavit exercise`: a sheet of tasks, its solution, and what marks answers.

use crate::arguments::{ExerciseArguments, ExerciseFormat};
use crate::commands::check::rubric;
use crate::commands::report::{markdown, put};
use crate::failure::Failure;
use crate::load;
use crate::terminal::note;
use denavit::description::write_toml;
use denavit_report::{Exercise, ExerciseOptions, NoExercise, exercise, render};
use std::fs;
use std::path::Path;

/// Writes a sheet, or the folder of a task.
///
/// # Errors
/// If there is no such robot or file, 4 if the robot has not what such an exercise is about.
pub fn run(arguments: &ExerciseArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let options = ExerciseOptions {
        kind: arguments.kind.into(),
        seed: arguments.seed,
        count: arguments.count,
        language: arguments.language.tongue(),
    };
    let made = exercise(&description, &options).map_err(|why| match why {
        NoExercise::Count(_) => Failure::Usage(format!("--count: {why}")),
        NoExercise::Values(_) => Failure::Usage(format!("{why}; --set NAME=VALUE gives values")),
        _ => Failure::Unsupported(format!("--kind {}: {why}", options.kind.name())),
    })?;
    match &arguments.task {
        Some(folder) => task(&made, folder),
        None => sheet(&made, arguments),
    }
}

/// One sheet to a file or to standard output.
fn sheet(made: &Exercise, arguments: &ExerciseArguments) -> Result<(), Failure> {
    let document = if arguments.solution { &made.solution } else { &made.statement };
    let stdout = Path::new("-");
    let to = arguments.output.as_deref().unwrap_or(stdout);
    let bytes = match format(arguments)? {
        ExerciseFormat::Markdown => {
            if to == stdout && document.has_figures() {
                note("note: the drawing is not on standard output; -o FILE.md writes it beside the sheet\n");
            }
            return markdown(document, to);
        }
        ExerciseFormat::Latex => render::latex(document),
        ExerciseFormat::Typst => render::typst(document),
        ExerciseFormat::Json => {
            let wire = denavit_wire::exercise::Exercise::of(made, arguments.solution);
            format!("{}\n", denavit_wire::text(&wire))
        }
    };
    put(to, bytes.as_bytes())
}

/// As said, or by the ending of the file.
fn format(arguments: &ExerciseArguments) -> Result<ExerciseFormat, Failure> {
    let ending =
        arguments.output.as_deref().and_then(Path::extension).map(|e| e.to_string_lossy().to_lowercase());
    match (arguments.format, ending.as_deref()) {
        (Some(format), _) => Ok(format),
        (None, None | Some("md" | "markdown")) => Ok(ExerciseFormat::Markdown),
        (None, Some("tex")) => Ok(ExerciseFormat::Latex),
        (None, Some("typ")) => Ok(ExerciseFormat::Typst),
        (None, Some("json")) => Ok(ExerciseFormat::Json),
        (None, Some(other)) => Err(Failure::Usage(format!(
            "-o: the ending .{other} says no format; .md, .tex, .typ and .json do, or --format"
        ))),
    }
}

/// Both sheets, the robot that answers are held against, and the points.
fn task(made: &Exercise, folder: &Path) -> Result<(), Failure> {
    let failed = |e: std::io::Error| Failure::Input(format!("error: {}: {e}", folder.display()));
    fs::create_dir_all(folder).map_err(failed)?;
    markdown(&made.statement, &folder.join("exercise.md"))?;
    markdown(&made.solution, &folder.join("solution.md"))?;
    put(&folder.join("robot.toml"), write_toml(&made.robot).as_bytes())?;
    put(&folder.join("task.toml"), rubric::write(&made.rubric, "robot.toml").as_bytes())
}
