//! Where robots come from: the catalogue, files, tables out of documents, other conventions.

use crate::refusal::Refusal;
use crate::robot_file::RobotFile;
use crate::session::finding;
use crate::subject::Subject;
use crate::words;
use denavit::catalogue;
use denavit::description::{
    Convention, Description, Diagnostic, JointKind, TableKind, TableOptions, line_column, prove_same_chain,
    read_table, read_toml, write_toml,
};
use denavit_report::words::Geometry as _;
use serde::Deserialize;
use serde_json::{Value, json};

/// A text that holds a robot.
#[derive(Deserialize)]
pub struct Open {
    text: String,
    kind: String,
    convention: Option<String>,
    degrees: Option<bool>,
    millimetres: Option<bool>,
    /// Which of several tables, from 1.
    table: Option<usize>,
}

/// All robots of the catalogue.
pub fn list() -> Value {
    let robots = catalogue::names().into_iter().filter_map(|name| {
        let d = catalogue::robot(name)?;
        let letter = |kind| if kind == JointKind::Revolute { 'R' } else { 'P' };
        let joints: String = d.variables().iter().map(|v| letter(v.kind)).collect();
        Some(json!({
            "name": name, "title": d.name, "joints": joints, "convention": d.convention.name(), "source": d.source,
        }))
    });
    json!({ "robots": robots.collect::<Vec<_>>() })
}

/// Reads a robot: its cells, and what is to be said of the text.
///
/// # Errors
/// If there is no such robot in the catalogue, no such kind of text, or no such convention.
pub fn open(open: &Open) -> Result<Value, Refusal> {
    let text = match open.kind.as_str() {
        "robot" => catalogue::text(&open.text)
            .ok_or_else(|| Refusal::new(format!("no robot `{}` in the catalogue", open.text)))?,
        _ => open.text.as_str(),
    };
    let kinds: &[TableKind] = match open.kind.as_str() {
        "robot" | "toml" => return Ok(robot_file(text)),
        "markdown" => &[TableKind::Markdown],
        "csv" => &[TableKind::Csv],
        "latex" => &[TableKind::Latex],
        "any" => &[TableKind::Markdown, TableKind::Latex, TableKind::Csv],
        other => return Err(Refusal::new(format!("texts of the kind `{other}` are not known"))),
    };
    if open.kind == "any" && text.lines().any(|line| line.trim_start().starts_with("[[joints]]")) {
        return Ok(robot_file(text));
    }
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
                return Ok(opened(&description, findings.iter().map(|d| placed(d, text)).collect()));
            }
            // The reader that came furthest says best what is wrong.
            Err(findings) if failed.as_ref().is_none_or(|before| reached(before) < reached(&findings)) => {
                failed = Some(findings);
            }
            Err(_) => {}
        }
    }
    let findings: Vec<Value> = failed.iter().flatten().map(|d| placed(d, text)).collect();
    Ok(json!({ "file": null, "findings": findings }))
}

/// How far into a text a reader came.
fn reached(findings: &[Diagnostic]) -> usize {
    findings.iter().map(|d| d.span.start).max().unwrap_or(0)
}

/// A robot file, with its errors in its cells if it has some.
fn robot_file(text: &str) -> Value {
    let findings = match read_toml(text) {
        Ok((_, findings)) | Err(findings) => findings,
    };
    let findings: Vec<Value> = findings.iter().map(|d| placed(d, text)).collect();
    json!({ "file": RobotFile::from_toml(text), "findings": findings })
}

fn opened(description: &Description, findings: Vec<Value>) -> Value {
    json!({ "file": RobotFile::from_toml(&write_toml(description)), "findings": findings })
}

fn placed(d: &Diagnostic, text: &str) -> Value {
    let (line, column) = line_column(text, d.span.start);
    let mut value = finding(d);
    value["line"] = line.into();
    value["column"] = column.into();
    value
}

fn convention(name: &str) -> Result<Convention, Refusal> {
    let found = Convention::ALL.into_iter().find(|c| c.name() == name);
    found.ok_or_else(|| Refusal::new(format!("no convention is called `{name}`")))
}

/// The robot in another convention.
///
/// # Errors
/// If there is no such convention.
pub fn convert(subject: &Subject, to: &str) -> Result<Value, Refusal> {
    let conversion = subject.description.converted(convention(to)?);
    let proved = prove_same_chain(&subject.description, &conversion.description).is_equal();
    let mut value = opened(&conversion.description, vec![]);
    value["words"] = words().moved(&conversion.moved).into();
    value["proved"] = proved.into();
    Ok(value)
}
