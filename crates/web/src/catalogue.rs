//! Where robots come from: the catalogue, files, tables out of documents, other conventions.

use crate::refusal::Refusal;
use crate::robot_file::RobotFile;
use crate::subject::Subject;
use crate::words;
use denavit::catalogue;
use denavit::description::{
    Convention, Description, Diagnostic, TableKind, TableOptions, prove_same_chain, read_table, read_toml,
    write_toml,
};
use denavit_report::words::Geometry as _;
use denavit_wire::finding::Finding;
use serde::{Deserialize, Serialize};

/// A robot by its name, or the text of a robot file.
#[derive(Deserialize)]
pub struct Open {
    text: String,
    kind: OwnKind,
}

/// Texts that need nothing but themselves to be read.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum OwnKind {
    Robot,
    Toml,
}

/// A text with a table, or a program that makes a robot.
#[derive(Deserialize)]
pub struct Foreign {
    text: String,
    kind: ForeignKind,
    convention: Option<String>,
    degrees: Option<bool>,
    millimetres: Option<bool>,
    /// Which of several tables, from 1.
    table: Option<usize>,
}

/// What a text is; `any` where that has to be found out.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum ForeignKind {
    Markdown,
    Csv,
    Latex,
    Any,
}

/// The cells of a text, and what is to be said of it.
#[derive(Serialize)]
pub struct Opened {
    file: Option<RobotFile>,
    findings: Vec<Finding>,
}

/// A robot in another convention.
#[derive(Serialize)]
pub struct Converted {
    file: Option<RobotFile>,
    /// Whether both are proved to be the same chain.
    proved: bool,
    /// What moved.
    words: String,
}

/// A robot of the catalogue, or of a robot file: its cells, and what is to be said of it.
///
/// # Errors
/// If there is no such robot in the catalogue.
pub fn open(open: &Open) -> Result<Opened, Refusal> {
    match open.kind {
        OwnKind::Toml => Ok(robot_file(&open.text)),
        OwnKind::Robot => {
            let text = catalogue::text(&open.text);
            text.map(robot_file)
                .ok_or_else(|| Refusal::new(format!("no robot `{}` in the catalogue", open.text)))
        }
    }
}

/// Reads a text with a robot in it: its cells, and what is to be said of it.
///
/// # Errors
/// If there is no such convention.
pub fn read(open: &Foreign) -> Result<Opened, Refusal> {
    let text = open.text.as_str();
    let kinds: &[TableKind] = match open.kind {
        ForeignKind::Markdown => &[TableKind::Markdown],
        ForeignKind::Csv => &[TableKind::Csv],
        ForeignKind::Latex => &[TableKind::Latex],
        ForeignKind::Any if text.lines().any(|line| line.trim_start().starts_with("[[joints]]")) => {
            return Ok(robot_file(text));
        }
        ForeignKind::Any => &[TableKind::Markdown, TableKind::Latex, TableKind::Csv],
    };
    let options = TableOptions {
        convention: open.convention.as_deref().map(convention).transpose()?,
        angles_in_degrees: open.degrees,
        lengths_in_millimetres: open.millimetres,
        table: open.table,
        columns: None,
    };
    let mut failed: Option<Vec<Diagnostic>> = None;
    for &kind in kinds {
        match read_table(text, kind, &options) {
            Ok((description, findings)) => {
                return Ok(Opened { file: cells(&description), findings: placed(&findings, text) });
            }
            // The reader that came furthest says best what is wrong.
            Err(findings) if failed.as_ref().is_none_or(|before| reached(before) < reached(&findings)) => {
                failed = Some(findings);
            }
            Err(_) => {}
        }
    }
    Ok(Opened { file: None, findings: placed(&failed.unwrap_or_default(), text) })
}

/// How far into a text a reader came.
fn reached(findings: &[Diagnostic]) -> usize {
    findings.iter().map(|d| d.span.start).max().unwrap_or(0)
}

/// A robot file, with its errors in its cells if it has some.
fn robot_file(text: &str) -> Opened {
    let findings = match read_toml(text) {
        Ok((_, findings)) | Err(findings) => findings,
    };
    Opened { file: RobotFile::from_toml(text), findings: placed(&findings, text) }
}

fn cells(description: &Description) -> Option<RobotFile> {
    RobotFile::from_toml(&write_toml(description))
}

fn placed(findings: &[Diagnostic], text: &str) -> Vec<Finding> {
    findings.iter().map(|d| Finding::placed(d, text)).collect()
}

/// The convention of a name.
///
/// # Errors
/// If there is none.
pub fn convention(name: &str) -> Result<Convention, Refusal> {
    let found = Convention::ALL.into_iter().find(|c| c.name() == name);
    found.ok_or_else(|| Refusal::new(format!("no convention is called `{name}`")))
}

/// The robot in another convention.
///
/// # Errors
/// If there is no such convention.
pub fn convert(subject: &Subject, to: &str) -> Result<Converted, Refusal> {
    let conversion = subject.description.converted(convention(to)?);
    let proved = prove_same_chain(&subject.description, &conversion.description).is_equal();
    let (file, words) = (cells(&conversion.description), words().moved(&conversion.moved));
    Ok(Converted { file, proved, words })
}
