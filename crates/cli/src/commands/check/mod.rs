//! `denavit check`: formulas that somebody printed, and motion that was recorded, held against the robot.

mod class;
mod class_page;
mod html;
pub mod lerobot;
mod markdown;
mod marked;
pub mod recording;
mod recording_plot;
pub mod rubric;
mod sheet;
mod terminal;

use crate::arguments::CheckArguments;
use crate::commands::certificate;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{note, words};
use denavit::description::{Diagnostic, Severity, line_column, render};
use denavit_check::{CheckOptions, Checked, MAX_BYTES, Note, check};
use denavit_load::Kind;
use denavit_reading::code::Dialect;
use denavit_reading::document::{Format, readable};
use rubric::Task;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A document with what was found in it.
struct Document<'a> {
    /// As the command line names it.
    name: &'a str,
    text: &'a str,
    checked: &'a Checked,
}

impl Document<'_> {
    /// The line of a place.
    fn line(&self, at: usize) -> usize {
        line_column(self.text, at).0
    }

    /// The part of the document at a place, blanks run together.
    fn source(&self, span: &std::ops::Range<usize>) -> String {
        let source = self.text.get(span.clone()).unwrap_or_default();
        source.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

/// Checks a document, or several of a class.
///
/// # Errors
/// 1 if something in it is wrong, 3 if something cannot be read; and where there is no such robot or file.
pub fn run(mut arguments: CheckArguments) -> Result<(), Failure> {
    let task = task(&mut arguments)?;
    let robot = &arguments.robot.robot;
    if arguments.files.is_empty() && matches!(Kind::of(robot), Some(Kind::Robot | Kind::Bodies | Kind::Par)) {
        return Err(Failure::Usage(format!("{robot} is a robot: name the document behind it")));
    }
    if let [file] = &arguments.files[..]
        && let Some(table) = recording::table_of(file)?
    {
        return recording::run(&arguments, &file.to_string_lossy(), table);
    }
    if arguments.recording.is_any() {
        let options = "--time, --joints, --position, --rotation, --recipe and --fix";
        return Err(Failure::Usage(format!("{options} are for one recording: denavit check ROBOT data.csv")));
    }
    let files = listed(&arguments.files)?;
    match (&files[..], &arguments.files[..]) {
        ([] | [_], [] | [_]) if arguments.csv.is_none() && !arguments.files.iter().any(|f| f.is_dir()) => {
            one(&arguments, task.as_ref())
        }
        _ => class::run(&arguments, task, &files),
    }
}

/// The rubric: that of `--rubric`, or a task in the robot's place, which names its robot.
fn task(arguments: &mut CheckArguments) -> Result<Option<Task>, Failure> {
    let read = |file: &Path| {
        let name = file.to_string_lossy();
        let text = fs::read_to_string(file).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
        rubric::read(&name, &text)
    };
    let first = PathBuf::from(&arguments.robot.robot);
    let is_task = first.extension().is_some_and(|e| e == "toml")
        && fs::read_to_string(&first).is_ok_and(|t| t.lines().any(|l| l.trim() == "[[items]]"));
    if !is_task {
        return arguments.rubric.as_deref().map(read).transpose();
    }
    if arguments.rubric.is_some() {
        return Err(Failure::Usage("the task has a rubric of its own; leave out --rubric".into()));
    }
    let task = read(&first)?;
    // A path is one beside the task.
    arguments.robot.robot = match &task.robot {
        Some(file) if file.contains(['.', '/']) => {
            first.parent().unwrap_or(Path::new("")).join(file).to_string_lossy().into_owned()
        }
        Some(name) => name.clone(),
        None => {
            let hint = "a task names its robot: `robot = \"puma560\"`, or a file beside it";
            return Err(Failure::Input(format!("error: {}: no robot\n  = hint: {hint}", first.display())));
        }
    };
    if arguments.files.is_empty() {
        return Err(Failure::Usage("name the documents to be marked, or their folder".into()));
    }
    Ok(Some(task))
}

/// The documents, folders replaced by the files in them.
fn listed(named: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = vec![];
    for path in named {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let failed = |e: io::Error| Failure::Input(format!("error: {}: {e}", path.display()));
        let entries = fs::read_dir(path).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let mut there: Vec<PathBuf> = entries.into_iter().map(|e| e.path()).collect();
        let is_hidden = |f: &Path| f.file_name().is_some_and(|n| n.to_string_lossy().starts_with('.'));
        there.retain(|f| f.is_file() && !is_hidden(f));
        there.sort();
        files.extend(there);
    }
    Ok(files)
}

/// Checks one document.
fn one(arguments: &CheckArguments, task: Option<&Task>) -> Result<(), Failure> {
    let (robot, name) = match &arguments.files[..] {
        [file, ..] => (Some(load::robot(&arguments.robot)?), file.to_string_lossy().into_owned()),
        [] => (None, arguments.robot.robot.clone()),
    };
    // A robot that is named has its values; the document's tables get theirs as they are read.
    let set = match &robot {
        Some(_) => vec![],
        None => arguments.robot.set.iter().map(|s| load::name_and_value(s)).collect::<Result<_, _>>()?,
    };
    let text = contents(&name)?;
    let options = CheckOptions {
        table: load::table_options(&arguments.robot),
        set,
        claim: arguments.claim.clone(),
        tolerance: arguments.tolerance,
        language: language_of(&name),
    };
    let format = Format::of(&name, &text);
    let mut checked = check(&text, format, robot.as_ref(), &options)
        .map_err(|notes| Failure::Input(render(&findings(notes.iter()), &name, &text)))?;
    if let Some(task) = task {
        if let Some(robot) = checked.robots.first() {
            task.fits(robot.variables().len())?;
        }
        task.rubric.answer(&text, format, &mut checked);
    }
    let document = Document { name: &name, text: &text, checked: &checked };
    let worth = checked.notes.iter().filter(|n| arguments.all || n.severity != Severity::Note);
    note(&render(&findings(worth), &name, &text));
    let certified = match &arguments.certificate {
        Some(file) => certified(file, &document),
        None => Ok(()),
    };
    let mut out = anstream::stdout();
    if let Some(file) = &arguments.html {
        fs::write(file, html::page(&document))
            .map_err(|e| Failure::Input(format!("error: {}: {e}", file.display())))?;
    }
    if let Some(task) = task {
        write!(out, "{}", sheet::report(&document, &task.rubric))?;
    } else if arguments.json {
        let found = denavit_wire::check::Checked::of(&name, &text, &checked);
        writeln!(out, "{}", denavit_wire::text(&found))?;
    } else if arguments.markdown {
        write!(out, "{}", markdown::list(&document))?;
    } else {
        write!(out, "{}", terminal::report(&document, arguments.all))?;
    }
    match (verdict(&document), certified) {
        (Ok(()), certified) => certified,
        (Err(why), certified) => {
            if let Err(Failure::GaveUp(missing)) = certified {
                writeln!(anstream::stderr(), "note: {missing}")?;
            }
            Err(why)
        }
    }
}

/// Writes a certificate for each robot of the document that something equal is said of: into `FILE`, then into `FILE-2` and so on.
fn certified(file: &Path, document: &Document) -> Result<(), Failure> {
    let certificates: Vec<_> = (0..document.checked.robots.len())
        .filter_map(|k| denavit_certificate::document(document.checked, k, &|at| document.line(at)))
        .collect();
    if certificates.is_empty() {
        return Err(Failure::GaveUp("no certificate: nothing in the document is proved".into()));
    }
    for (k, certificate) in certificates.into_iter().enumerate() {
        let (stem, ending) = (file.file_stem().unwrap_or_default(), file.extension().unwrap_or_default());
        let name = format!("{}-{}.{}", stem.to_string_lossy(), k + 1, ending.to_string_lossy());
        let file = if k == 0 { file.to_path_buf() } else { file.with_file_name(name) };
        certificate::write(&file, certificate)?;
    }
    Ok(())
}

/// Notes in words.
fn findings<'a>(notes: impl Iterator<Item = &'a Note>) -> Vec<Diagnostic> {
    notes.map(|n| words().note(n)).collect()
}

/// The language of a program, by its file's ending.
fn language_of(name: &str) -> Option<Dialect> {
    match Path::new(name).extension()?.to_str()? {
        "py" => Some(Dialect::Python),
        // Julia is read as MATLAB, JavaScript as C.
        "m" | "jl" => Some(Dialect::Matlab),
        "c" | "h" | "cpp" | "cc" | "hpp" | "ino" | "js" | "mjs" | "ts" => Some(Dialect::C),
        _ => None,
    }
}

/// The exit code.
fn verdict(document: &Document) -> Result<(), Failure> {
    let tally = document.checked.tally();
    let plural = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    if tally.wrong + tally.conditional > 0 {
        let mut parts = vec![];
        if tally.wrong > 0 {
            parts.push(plural(tally.wrong, "claim is wrong", "claims are wrong"));
        }
        if tally.conditional > 0 {
            parts.push(plural(
                tally.conditional,
                "is right under a condition",
                "are right under a condition",
            ));
        }
        return Err(Failure::No(parts.join(", ")));
    }
    if tally.unreadable + tally.undecided > 0 {
        let count = tally.unreadable + tally.undecided;
        return Err(Failure::Input(plural(count, "claim is not decided", "claims are not decided")));
    }
    if tally.carried > 0 {
        return Err(Failure::No(plural(
            tally.carried,
            "claim follows from an earlier error",
            "claims follow from earlier errors",
        )));
    }
    let is_empty = document.checked.claims.is_empty() && document.checked.answered.is_empty();
    if tally.unjudged > 0 && !is_empty {
        return Err(Failure::Input(plural(tally.unjudged, "line is not judged", "lines are not judged")));
    }
    if is_empty {
        let hint = "a claim is an equation such as `P_x = …`, `T06 = […]` or `θ1 = atan2(…)`; say what a left side means \
             with --claim, or with a comment `check: claim T06` before it";
        return Err(Failure::Input(format!(
            "error: {}: no formula about the robot was found\n  = hint: {hint}",
            document.name
        )));
    }
    Ok(())
}

/// The text of a file or of standard input.
fn contents(name: &str) -> Result<String, Failure> {
    let bytes =
        denavit_load::bytes(name, MAX_BYTES).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let text = decoded(&bytes).ok_or_else(|| Failure::Input(format!("error: {name}: this is not a text")))?;
    Ok(readable(name, text))
}

/// The text of bytes: UTF-8, or UTF-16 where they begin with its mark; nothing of what is no text, a PDF for one.
fn decoded(bytes: &[u8]) -> Option<String> {
    let units = |big: bool| {
        let unit = |c: &[u8]| if big { [c[0], c[1]] } else { [c[1], c[0]] };
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|c| u16::from_be_bytes(unit(c))).collect();
        Some(String::from_utf16_lossy(&units))
    };
    match bytes {
        [0xff, 0xfe, ..] => units(false),
        [0xfe, 0xff, ..] => units(true),
        _ if bytes.contains(&0) || bytes.starts_with(b"%PDF") => None,
        _ => Some(String::from_utf8_lossy(bytes).into_owned()),
    }
}
