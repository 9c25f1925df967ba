//! `denavit check`: formulas that somebody printed, held against the robot.

mod html;
mod markdown;
mod marked;
mod rubric;
mod terminal;

use crate::arguments::CheckArguments;
use crate::commands::certificate;
use crate::failure::Failure;
use crate::load;
use crate::terminal::{note, words};
use denavit::description::{Diagnostic, Severity, line_column, render};
use denavit_check::{CheckOptions, Checked, MAX_BYTES, Note, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;
use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;

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

/// Checks a document.
///
/// # Errors
/// 1 if something in it is wrong, 3 if something cannot be read; and where there is no such robot or file.
pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let (robot, name) = match &arguments.file {
        Some(file) => (Some(load::robot(&arguments.robot)?), file.to_string_lossy().into_owned()),
        None => (None, arguments.robot.robot.clone()),
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
    let checked = check(&text, format, robot.as_ref(), &options)
        .map_err(|notes| Failure::Input(render(&findings(notes.iter()), &name, &text)))?;
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
    if let Some(file) = &arguments.rubric {
        let name = file.to_string_lossy();
        let rubric = fs::read_to_string(file).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
        write!(out, "{}", rubric::sheet(&document, &name, &rubric)?)?;
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
        "m" => Some(Dialect::Matlab),
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
    if tally.unjudged > 0 && !document.checked.claims.is_empty() {
        return Err(Failure::Input(plural(tally.unjudged, "line is not judged", "lines are not judged")));
    }
    if document.checked.claims.is_empty() {
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
    let limit = MAX_BYTES as u64 + 1;
    let mut bytes = vec![];
    let read = if name == "-" {
        io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else {
        fs::File::open(Path::new(name)).and_then(|f| f.take(limit).read_to_end(&mut bytes))
    };
    read.map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
