//! What stands in a file, with its findings.

use crate::folder::Folder;
use crate::kind::Kind;
use crate::text::contents;
use denavit::closure;
use denavit::description::{
    Decimals, Described, Diagnostic, Linkage, MAX_BYTES, MAX_XML_BYTES, Mechanism, RowTree, Severity,
    TableOptions, is_mjcf, read_bodies, read_par, read_program, read_robot, read_table_robot,
};
use std::io;
use std::path::PathBuf;
use std::sync::Arc;

/// How a file is to be read.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Values of a xacro file's arguments.
    pub arguments: Vec<(String, String)>,
    /// Whether decimals of angles are taken as they are written: 1.5708 is no quarter turn.
    pub as_written: bool,
    /// Folders of packages, by name.
    pub packages: Vec<(String, PathBuf)>,
    /// How tables are read; which one is the number of a program's robot, too.
    pub table: TableOptions,
}

impl Options {
    /// How decimals are taken.
    pub fn decimals(&self) -> Decimals {
        if self.as_written { Decimals::AsWritten } else { Decimals::Meant }
    }
}

/// What a file says of a robot.
pub enum Content {
    /// A chain, a tree of rows, or what has closed loops.
    Rows(Described),
    /// A tree of rows as SYMORO writes it, which may be a chain.
    Par(Box<RowTree>),
    /// A tree of bodies without closed loops.
    Bodies(Box<Mechanism>),
}

/// A finding in a text; its place is one of that text.
#[derive(Clone, PartialEq, Debug)]
pub struct Finding {
    /// What was found.
    pub diagnostic: Diagnostic,
    /// What the text is called.
    pub name: Arc<str>,
    /// The text.
    pub text: Arc<str>,
}

impl Finding {
    /// All findings in one text.
    pub fn all(findings: Vec<Diagnostic>, name: &str, text: &Arc<str>) -> Vec<Self> {
        let name: Arc<str> = name.into();
        let of = |diagnostic| Finding { diagnostic, name: name.clone(), text: text.clone() };
        findings.into_iter().map(of).collect()
    }

    /// True for an error.
    pub fn is_error(&self) -> bool {
        self.diagnostic.severity == Severity::Error
    }
}

/// A file that was read.
pub struct Contents {
    /// What it says.
    pub content: Content,
    /// Its text.
    pub text: Arc<str>,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
    /// By how many metres its bodies lie apart from where the decimals as written put them.
    pub apart: f64,
}

/// Why there is nothing.
#[derive(Debug)]
pub enum Problem {
    /// The file cannot be read.
    Unreadable(io::Error),
    /// It has errors.
    Errors(Vec<Finding>),
    /// Arguments were given to a file that is not for xacro.
    TakesNoArguments,
    /// The folder of a package is none.
    NoFolder(PathBuf),
}

/// Reads the file of this name, of this kind.
///
/// # Errors
/// See [`Problem`].
pub fn read(name: &str, kind: Kind, options: &Options) -> Result<Contents, Problem> {
    let most = if kind == Kind::Bodies { MAX_XML_BYTES } else { MAX_BYTES };
    let text = contents(name, most).map_err(Problem::Unreadable)?;
    read_text(name, text.into(), kind, options)
}

/// Reads a text of this kind; `name` is what findings call it, and the files that it names are looked for around that name.
///
/// # Errors
/// See [`Problem`].
pub fn read_text(name: &str, text: Arc<str>, kind: Kind, options: &Options) -> Result<Contents, Problem> {
    if let Some((_, folder)) = options.packages.iter().find(|p| !p.1.is_dir()) {
        return Err(Problem::NoFolder(folder.clone()));
    }
    let findings = |all| Finding::all(all, name, &text);
    let errors = |all| Problem::Errors(findings(all));
    let (content, found) = match kind {
        Kind::Bodies => return bodies(name, text, options),
        Kind::Robot => {
            let (read, found) = read_robot(&text).map_err(errors)?;
            let found = with_loops(&read, found).map_err(errors)?;
            (Content::Rows(read), found)
        }
        Kind::Table(kind) => {
            let (read, found) = read_table_robot(&text, kind, &options.table).map_err(errors)?;
            (Content::Rows(read), found)
        }
        Kind::Par => {
            let (read, found) = read_par(&text, options.decimals()).map_err(errors)?;
            let found = with_loops(&read, found).map_err(errors)?;
            match read {
                Described::Tree(tree) => (Content::Par(tree), found),
                other => (Content::Rows(other), found),
            }
        }
        Kind::Program(language) => {
            let (chain, found) = read_program(&text, language, options.table.table).map_err(errors)?;
            (Content::Rows(Described::Chain(Box::new(chain))), found)
        }
    };
    let findings = findings(found);
    Ok(Contents { content, text, findings, apart: 0.0 })
}

/// The findings, with those in the closed loops of what was read.
fn with_loops(read: &Described, mut found: Vec<Diagnostic>) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    if let Described::Linkage(linkage) = read {
        found.extend(closure::findings(linkage));
    }
    let has_errors = found.iter().any(|d| d.severity == Severity::Error);
    if has_errors { Err(found) } else { Ok(found) }
}

/// A tree of bodies, with the files that it names; with closed loops it is a linkage.
fn bodies(name: &str, text: Arc<str>, options: &Options) -> Result<Contents, Problem> {
    if is_mjcf(&text) && !options.arguments.is_empty() {
        return Err(Problem::TakesNoArguments);
    }
    let read = |decimals| {
        let mut folder = Folder::around(name, &options.packages);
        read_bodies(name, &text, &mut folder, &options.arguments, decimals)
    };
    let (outcome, files) = read(options.decimals());
    let placed = |found: Vec<Diagnostic>| -> Vec<Finding> {
        let mut texts: Vec<(Arc<str>, Arc<str>)> = vec![];
        let mut shared = |name: &str, text: &str| {
            let known = texts.iter().position(|t| *t.0 == *name);
            let at = known.unwrap_or_else(|| {
                texts.push((name.into(), text.into()));
                texts.len() - 1
            });
            texts[at].clone()
        };
        let place = |d: Diagnostic| {
            let (name, text, span) = files.locate(&d.span)?;
            let (name, text) = shared(name, text);
            Some(Finding { diagnostic: Diagnostic { span, ..d }, name, text })
        };
        found.into_iter().filter_map(place).collect()
    };
    let (mechanism, mut found) = outcome.map_err(|found| Problem::Errors(placed(found)))?;
    let linkage = closed(&mechanism, &mut found);
    let findings = placed(found);
    let apart = match (options.decimals(), read(Decimals::AsWritten)) {
        (Decimals::Meant, (Ok((written, _)), _)) => mechanism.apart(&written),
        _ => 0.0,
    };
    let content = match linkage {
        Some(linkage) => Content::Rows(Described::Linkage(Box::new(linkage))),
        None => Content::Bodies(Box::new(mechanism)),
    };
    Ok(Contents { content, text, findings, apart })
}

/// The linkage of a tree of bodies with closed loops; nothing where it has none, or such that are found wrong: then they are left, which is
/// said.
fn closed(mechanism: &Mechanism, found: &mut Vec<Diagnostic>) -> Option<Linkage> {
    let span = mechanism.holds.first()?.span.clone();
    let linkage = Linkage::of_mechanism(mechanism).ok();
    let said = linkage.as_ref().map_or(vec![], closure::findings);
    let is_wrong = linkage.is_none() || said.iter().any(|d| d.severity == Severity::Error);
    let softened = |d: Diagnostic| match d.severity {
        Severity::Error => Diagnostic { severity: Severity::Warning, ..d },
        _ => d,
    };
    found.extend(said.into_iter().map(softened));
    if is_wrong {
        let message = "the closed loops are left: joints move as if they were open".into();
        found.push(Diagnostic { severity: Severity::Warning, span, message, hint: None });
        return None;
    }
    linkage
}
