//! `denavit report`: everything about a robot as a document.

#[cfg(feature = "pdf")]
mod embedded;
#[cfg(not(feature = "pdf"))]
mod installed;
mod pdf;

use crate::arguments::{LevelName, PaceName, ReportArguments, ReportFormat, RobotArguments, SectionName};
use crate::commands::fk::configuration;
use crate::failure::Failure;
use crate::load;
use denavit::description::Description;
use denavit_check::{Checked, check};
use denavit_reading::document::{Format, readable};
use denavit_report::render::slides::{self, Pace};
use denavit_report::{Document, Errata, Level, ReportOptions, Topic, compared, render, report};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes the report.
///
/// # Errors
/// If there is no such robot, the format is not known, or nothing can be written; 4 where a PDF needs Typst and there is
/// none.
pub fn run(arguments: &ReportArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let format = format(arguments)?;
    let pose = arguments.q.as_deref().map(|text| configuration(&description, text)).transpose()?;
    let is_single = arguments.beside.is_empty();
    let compared_by =
        [SectionName::Summary, SectionName::Figures, SectionName::Table, SectionName::Workspace];
    if !is_single && arguments.sections.iter().any(|s| !compared_by.contains(s)) {
        let why = "--beside: robots are compared by the sections summary, figures, table and workspace";
        return Err(Failure::Usage(why.into()));
    }
    let source = if is_single { checked(arguments, &description)? } else { None };
    let errata =
        source.as_ref().map(|(text, checked)| Errata { name: &arguments.robot.robot, text, checked });
    let options = ReportOptions {
        language: arguments.language.tongue(),
        title: arguments.title.clone(),
        author: arguments.author.clone(),
        level: level(arguments),
        topics: topics(arguments),
        conventions: arguments.conventions.iter().map(|&c| c.into()).collect(),
        pose,
        errata,
        for_slides: arguments.slides.is_some(),
    };
    let document = match &arguments.beside[..] {
        [] => report(&description, &options),
        others => {
            let others = others.iter().map(|name| {
                load::robot(&RobotArguments { robot: name.clone(), ..RobotArguments::default() })
            });
            let others = others.collect::<Result<Vec<Description>, Failure>>()?;
            compared(&[vec![description], others].concat(), &options)
        }
    };
    if document.sections.is_empty() {
        let why = "--sections: nothing of it applies to this robot; `errata` needs a document with formulas";
        return Err(Failure::Usage(why.into()));
    }
    let pace = arguments.slides.map(|pace| match pace {
        PaceName::Steps => Pace::Steps,
        PaceName::Whole => Pace::Whole,
    });
    write(&document, format, pace, &arguments.output)
}

fn level(arguments: &ReportArguments) -> Level {
    match arguments.level {
        LevelName::Short => Level::Short,
        LevelName::Full => Level::Full,
    }
}

fn topics(arguments: &ReportArguments) -> Vec<Topic> {
    match &arguments.sections[..] {
        [] => level(arguments).topics(),
        some => some.iter().map(|&s| s.into()).collect(),
    }
}

/// As said, or by the ending of the file.
fn format(arguments: &ReportArguments) -> Result<ReportFormat, Failure> {
    if let Some(format) = arguments.format {
        return Ok(format);
    }
    let ending = arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    match &ending[..] {
        "pdf" => Ok(ReportFormat::Pdf),
        "html" | "htm" => Ok(ReportFormat::Html),
        "typ" => Ok(ReportFormat::Typst),
        "tex" => Ok(ReportFormat::Latex),
        "md" | "markdown" => Ok(ReportFormat::Markdown),
        _ => Err(Failure::Usage(format!(
            "-o {}: the ending says the format: .pdf, .html, .typ, .tex or .md; or give --format",
            arguments.output.display()
        ))),
    }
}

/// What is found in the document that the robot comes from, if it comes from one and that claims anything.
fn checked(
    arguments: &ReportArguments,
    description: &Description,
) -> Result<Option<(String, Checked)>, Failure> {
    let name = &arguments.robot.robot;
    let is_document = matches!(
        Path::new(name).extension().and_then(|e| e.to_str()),
        Some("md" | "markdown" | "txt" | "tex")
    );
    let wanted = topics(arguments).contains(&Topic::Errata);
    if !(is_document && wanted) {
        return Ok(None);
    }
    let text = fs::read(name).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let text = readable(name, String::from_utf8_lossy(&text).into_owned());
    let options =
        denavit_check::CheckOptions { table: load::table_options(&arguments.robot), ..Default::default() };
    // What the reader of tables took is there; what cannot be read beside it is no part of the report.
    let checked = check(&text, Format::of(name, &text), Some(description), &options).ok();
    Ok(checked.map(|c| (text, c)))
}

fn write(document: &Document, format: ReportFormat, pace: Option<Pace>, to: &Path) -> Result<(), Failure> {
    let bytes = match (format, pace) {
        (ReportFormat::Html, None) => render::html(document).into_bytes(),
        (ReportFormat::Html, Some(pace)) => slides::html(document, pace).into_bytes(),
        (ReportFormat::Typst, None) => render::typst(document).into_bytes(),
        (ReportFormat::Typst, Some(pace)) => slides::typst(document, pace).into_bytes(),
        (ReportFormat::Pdf, None) => pdf::pdf(&render::typst(document))?,
        (ReportFormat::Pdf, Some(pace)) => pdf::pdf(&slides::typst(document, pace))?,
        (ReportFormat::Latex | ReportFormat::Markdown, Some(_)) => {
            let why = "--slides: slides are written as .html, .typ or .pdf, not as LaTeX or Markdown";
            return Err(Failure::Usage(why.into()));
        }
        (ReportFormat::Latex, None) => render::latex(document).into_bytes(),
        (ReportFormat::Markdown, None) => return markdown(document, to),
    };
    put(to, &bytes)
}

/// The text, and its figures in a folder beside it.
pub fn markdown(document: &Document, to: &Path) -> Result<(), Failure> {
    let stem = to.file_stem().map_or("report".into(), |s| s.to_string_lossy());
    let stem = if is_stdout(to) { "report".into() } else { stem };
    let written = render::markdown(document, &format!("{stem}-figures"));
    let folder = to.parent().map(Path::to_path_buf).unwrap_or_default();
    if !is_stdout(to) {
        for (name, svg) in &written.figures {
            let path: PathBuf = folder.join(name);
            if let Some(parent) = path.parent().filter(|p| !p.is_dir()) {
                fs::create_dir(parent).map_err(|e| cannot(parent, &e))?;
            }
            put(&path, svg.as_bytes())?;
        }
    }
    put(to, written.text.as_bytes())
}

fn is_stdout(to: &Path) -> bool {
    to.as_os_str() == "-"
}

/// Into a file, or to standard output.
pub fn put(to: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stdout(to) {
        return Ok(std::io::stdout().write_all(bytes)?);
    }
    fs::write(to, bytes).map_err(|e| cannot(to, &e))
}

fn cannot(path: &Path, e: &std::io::Error) -> Failure {
    Failure::Input(format!("error: {}: {e}", path.display()))
}

impl From<SectionName> for Topic {
    fn from(name: SectionName) -> Self {
        match name {
            SectionName::Summary => Topic::Summary,
            SectionName::Figures => Topic::Figures,
            SectionName::Table => Topic::Table,
            SectionName::Links => Topic::Links,
            SectionName::Forward => Topic::Forward,
            SectionName::Example => Topic::Example,
            SectionName::Inverse => Topic::Inverse,
            SectionName::Velocity => Topic::Velocity,
            SectionName::Dynamics => Topic::Dynamics,
            SectionName::Workspace => Topic::Workspace,
            SectionName::Errata => Topic::Errata,
            SectionName::References => Topic::References,
        }
    }
}
