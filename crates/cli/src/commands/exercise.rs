//! `denavit exercise`: a sheet of tasks, its solution, and what marks answers.

use crate::arguments::{ExerciseArguments, ExerciseFormat};
use crate::commands::check::rubric;
use crate::commands::report::{markdown, put};
use crate::failure::Failure;
use crate::load;
use crate::terminal::note;
use denavit::description::{Description, write_toml};
use denavit_report::{
    ArmOptions, Exercise, ExerciseOptions, NoExercise, exercise, exercise_of_arm, moodle, notebook,
    prairielearn, render,
};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Writes a sheet, or the folder of a task.
///
/// # Errors
/// If there is no such robot or file, 4 if the robot has not what such an exercise is about.
pub fn run(arguments: &ExerciseArguments) -> Result<(), Failure> {
    let description = arguments.robot.as_ref().map(load::robot).transpose()?;
    let make = |seed| made(arguments, description.as_ref(), seed);
    match (&arguments.task, names(arguments)?) {
        (Some(folder), Some(names)) => series(arguments, make, &names, folder),
        (Some(folder), None) => task(&make(arguments.seed)?, folder),
        (None, None) => sheet(&make(arguments.seed)?, arguments),
        (None, Some(names)) => exported(arguments, make, &names),
    }
}

/// A series for another system.
fn exported(
    arguments: &ExerciseArguments,
    make: impl Fn(u64) -> Result<Exercise, Failure>,
    names: &[String],
) -> Result<(), Failure> {
    let stdout = Path::new("-");
    let to = arguments.output.as_deref().unwrap_or(stdout);
    let format = format(arguments)?;
    let all = others(arguments.seed, make, names.len())?;
    match format {
        ExerciseFormat::Moodle => put(to, moodle(&all).as_bytes()),
        ExerciseFormat::Prairielearn => all
            .iter()
            .zip(names)
            .try_for_each(|(e, name)| files(&prairielearn(e), &folder(arguments)?.join(name))),
        ExerciseFormat::Jupyter => all
            .iter()
            .zip(names)
            .try_for_each(|(e, name)| files(&[(format!("{name}.ipynb"), notebook(e))], folder(arguments)?)),
        _ => Err(Failure::Usage(
            "--series and --students need --task DIR, or --format moodle, prairielearn or jupyter".into(),
        )),
    }
}

/// The folder that -o names.
fn folder(arguments: &ExerciseArguments) -> Result<&Path, Failure> {
    let named = arguments.output.as_deref().filter(|o| *o != Path::new("-"));
    named.ok_or_else(|| Failure::Usage("-o names the folder".into()))
}

/// Files of a folder by their names in it.
fn files(all: &[(String, String)], folder: &Path) -> Result<(), Failure> {
    for (name, text) in all {
        let path = folder.join(name);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent)
            .map_err(|e| Failure::Input(format!("error: {}: {e}", parent.display())))?;
        put(&path, text.as_bytes())?;
    }
    Ok(())
}

/// The exercise with this seed, about the robot or an arm that is made up.
fn made(arguments: &ExerciseArguments, robot: Option<&Description>, seed: u64) -> Result<Exercise, Failure> {
    let language = arguments.language.tongue();
    let options = ExerciseOptions { kind: arguments.kind.into(), seed, count: arguments.count, language };
    let made = match robot {
        Some(description) => exercise(description, &options),
        None => {
            let arm = ArmOptions { difficulty: arguments.difficulty.into(), series: arguments.seed };
            exercise_of_arm(&arm, &options)
        }
    };
    made.map_err(|why| match why {
        NoExercise::Count(_) => Failure::Usage(format!("--count: {why}")),
        NoExercise::Values(_) => Failure::Usage(format!("{why}; --set NAME=VALUE gives values")),
        _ => Failure::Unsupported(format!("--kind {}: {why}", options.kind.name())),
    })
}

/// So many other seeds are tried where a sheet is like an earlier one: of few arms there are not many.
const OTHERS: usize = 20;
/// The most exercises of a series.
const MOST: usize = 1000;

/// Whether the first cell of a table is what its column holds.
fn is_head(name: &str) -> bool {
    let bare = name.trim_matches(['"', '\'', '#', ' ']).to_lowercase();
    HEADS.contains(&bare.as_str())
}

/// What first columns of tables of students are called.
const HEADS: [&str; 36] = [
    "name",
    "names",
    "student",
    "students",
    "student name",
    "student id",
    "id",
    "id number",
    "user",
    "username",
    "login",
    "uid",
    "email",
    "e-mail",
    "email address",
    "first name",
    "firstname",
    "last name",
    "lastname",
    "surname",
    "full name",
    "vorname",
    "nachname",
    "matrikelnummer",
    "matrikelnr",
    "matrikel",
    "studierende",
    "nom",
    "prénom",
    "étudiant",
    "étudiants",
    "nombre",
    "apellido",
    "apellidos",
    "estudiante",
    "alumno",
];

/// What the folders of a series are called.
fn names(arguments: &ExerciseArguments) -> Result<Option<Vec<String>>, Failure> {
    let names: Vec<String> = match (&arguments.students, arguments.series) {
        (Some(file), _) => {
            let text = fs::read_to_string(file)
                .map_err(|e| Failure::Input(format!("error: {}: {e}", file.display())))?;
            // A table of students has them in its first column.
            let first =
                |line: &str| line.split([',', ';', '\t']).next().unwrap_or_default().trim().to_string();
            let text = text.trim_start_matches('\u{feff}');
            let mut names: Vec<String> = text.lines().map(first).filter(|name| !name.is_empty()).collect();
            if let Some(head) = names.first().filter(|name| is_head(name)) {
                note(&format!(
                    "note: {}: the first row, `{head}`, is a head and no student\n",
                    file.display()
                ));
                names.remove(0);
            }
            names
        }
        (None, Some(n)) => {
            let width = n.to_string().len().max(2);
            (1..=n).map(|k| format!("{k:0width$}")).collect()
        }
        (None, None) => return Ok(None),
    };
    if !(1..=MOST).contains(&names.len()) {
        return Err(Failure::Usage(format!("{} exercises: a series has 1 to {MOST}", names.len())));
    }
    let is_plain = |name: &str| !name.contains(['/', '\\', ':']) && !name.starts_with('.');
    if let Some(name) = names.iter().find(|name| !is_plain(name)) {
        return Err(Failure::Usage(format!("`{name}` can be no folder")));
    }
    let twice = (1..names.len()).find(|&k| names[..k].contains(&names[k]));
    match twice {
        Some(k) => Err(Failure::Usage(format!("`{}` is there twice", names[k]))),
        None => Ok(Some(names)),
    }
}

/// A folder for each name, no two sheets alike, and a table of which is whose.
fn series(
    arguments: &ExerciseArguments,
    make: impl Fn(u64) -> Result<Exercise, Failure>,
    names: &[String],
    folder: &Path,
) -> Result<(), Failure> {
    let mut table = String::from("name,seed,robot\n");
    for (name, made) in names.iter().zip(others(arguments.seed, make, names.len())?) {
        task(&made, &folder.join(name))?;
        table += &format!("{name},{},{}\n", made.options.seed, made.robot.name);
    }
    put(&folder.join("series.csv"), table.as_bytes())
}

/// So many exercises from a seed on, no two alike.
fn others(
    first: u64,
    make: impl Fn(u64) -> Result<Exercise, Failure>,
    count: usize,
) -> Result<Vec<Exercise>, Failure> {
    let (mut seen, mut all, mut seed) = (BTreeSet::new(), vec![], first);
    for _ in 0..count {
        let mut made = make(seed)?;
        for _ in 0..OTHERS {
            seed = seed.wrapping_add(1);
            // All but the title, in which arms that are made up have their number.
            let solution = render::markdown(&made.solution, "figures").text;
            if seen.insert(solution.split_once('\n').map_or("", |(_, rest)| rest).to_string()) {
                break;
            }
            made = make(seed)?;
        }
        all.push(made);
    }
    Ok(all)
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
        ExerciseFormat::Moodle => moodle(std::slice::from_ref(made)),
        ExerciseFormat::Jupyter => notebook(made),
        ExerciseFormat::Prairielearn => return files(&prairielearn(made), folder(arguments)?),
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
        (None, Some("xml")) => Ok(ExerciseFormat::Moodle),
        (None, Some("ipynb")) => Ok(ExerciseFormat::Jupyter),
        (None, Some(other)) => Err(Failure::Usage(format!(
            "-o: the ending .{other} says no format; .md, .tex, .typ, .json, .xml and .ipynb do, or --format"
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
