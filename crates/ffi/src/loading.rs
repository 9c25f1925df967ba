//! Robots by name, from files and texts.

use crate::trouble::{Found, Trouble, text};
use crate::types::{FindingSeverity, JointKind, Status};
use denavit::description::{Convention, Description, JointKind as Kind, NoChain, read_robot, write_toml};
use denavit_load::{
    Around, Content, Contents, ENDINGS, NotTaken, Options, Problem, catalogue_name, close_names, listed,
    read, read_text,
};
use denavit_report::words::{Tongue, Whole};
use denavit_symbolic::Expr;
use std::ffi::CString;

/// Metres that a person could see.
const SEEN: f64 = 1e-9;

/// Where a description stands.
#[derive(Clone, Debug)]
pub enum Source {
    /// In the catalogue, by this name.
    Catalogue(String),
    /// In the file of this name.
    File(String),
    /// In a text, which is of the format that an ending of files names, or looks like one.
    Text(String, Option<String>),
}

/// A robot as it is asked for.
#[derive(Clone, Debug)]
pub struct Request {
    pub source: Source,
    pub options: Options,
    pub base: Option<String>,
    pub tip: Option<String>,
}

/// What a robot is known by.
#[derive(Debug)]
pub struct Facts {
    /// The text of its file.
    pub text: CString,
    /// What people call it.
    pub name: CString,
    pub convention: Convention,
    pub joints: Vec<Joint>,
    /// How many rows its table has.
    pub rows: usize,
    pub has_masses: bool,
    /// Why it says nothing of masses though its file does.
    pub unweighed: Option<String>,
    /// Warnings and notes.
    pub findings: Vec<Found>,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    pub variable: CString,
    pub name: Option<CString>,
    pub kind: JointKind,
    pub limits: Option<[f64; 2]>,
    pub velocity: Option<f64>,
}

impl Request {
    /// Reads the robot; its formulas belong to this thread.
    pub fn load(&self) -> Result<Facts, Trouble> {
        let file = match &self.source {
            Source::Catalogue(name) => return self.of_catalogue(name),
            Source::File(name) => {
                let kind = denavit_load::Kind::of(name).filter(|_| name != "-");
                let kind = kind.ok_or_else(|| {
                    let why = std::fs::metadata(name).err();
                    let why = why.map_or_else(|| format!("what is this? {ENDINGS}"), |e| e.to_string());
                    Trouble::new(Status::BadFile, format!("{name}: {why}"))
                })?;
                read(name, kind, &self.options)
            }
            Source::Text(all, format) => {
                let kind = match format {
                    None => denavit_load::Kind::of_text(all),
                    Some(format) => denavit_load::Kind::of(&format!("x.{format}")).ok_or_else(|| {
                        Trouble::new(Status::BadArgument, format!("no format `{format}`: {ENDINGS}"))
                    })?,
                };
                read_text(self.name(), all.as_str().into(), kind, &self.options)
            }
        };
        let Contents { content, findings, apart, .. } = file.map_err(|why| self.trouble(why))?;
        let mut findings = Found::all(&findings);
        if apart > SEEN {
            let words = Tongue::English.words().read_apart(apart);
            findings.push(Found::said(FindingSeverity::Note, &words, self.name()));
        }
        self.chain_of(content, findings)
    }

    /// What findings call it.
    fn name(&self) -> &str {
        match &self.source {
            Source::Catalogue(name) | Source::File(name) => name,
            Source::Text(..) => "text",
        }
    }

    fn trouble(&self, why: Problem) -> Trouble {
        let name = self.name();
        match why {
            Problem::Unreadable(e) => Trouble::new(Status::BadFile, format!("{name}: {e}")),
            Problem::Errors(findings) => Trouble::of(Found::all(&findings)),
            Problem::TakesNoArguments => {
                let why = format!("arguments are for xacro files, and {name} is a model of MuJoCo's");
                Trouble::new(Status::BadArgument, why)
            }
            Problem::NoFolder(folder) => {
                let why = format!("packages: there is no folder {}", folder.display());
                Trouble::new(Status::BadArgument, why)
            }
        }
    }

    fn of_catalogue(&self, asked: &str) -> Result<Facts, Trouble> {
        let name = catalogue_name(asked);
        let Some((name, all)) = name.as_deref().and_then(|n| Some((n, listed(n)?))) else {
            let close = close_names(asked);
            let hint = match &close[..] {
                [] => "`denavit_catalogue` lists all; `denavit_robot_file` reads files".to_string(),
                close => format!("did you mean {}?", close.join(", ")),
            };
            return Err(Trouble::new(Status::UnknownRobot, format!("no robot `{asked}`: {hint}")));
        };
        let place = |found: Vec<_>| found.iter().map(|d| Found::new(d, name, all)).collect::<Vec<_>>();
        let (content, findings) = read_robot(all).map_err(|found| Trouble::of(place(found)))?;
        self.chain_of(Content::Rows(content), place(findings))
    }

    fn chain_of(&self, content: Content, mut findings: Vec<Found>) -> Result<Facts, Trouble> {
        let words = Tongue::English.words();
        let name = self.name();
        let convention = self.options.table.convention;
        let taken = content.chain(name, self.base.as_deref(), self.tip.as_deref(), None, convention);
        let (description, around) = taken.map_err(|why| {
            let why = match why {
                NotTaken::NotCoupled(why) => format!("{name}: {why}"),
                NotTaken::NoLoops => format!("{name} has no closed loops"),
                NotTaken::OneChain => format!("{name} is one chain: it has no links to choose from"),
                NotTaken::NoChain(why) => {
                    let hint = if matches!(why, NoChain::Several(_)) { "; name one as tip" } else { "" };
                    format!("{name}: {why}{hint}")
                }
            };
            Trouble::new(Status::NoChain, why)
        })?;
        let mut say = |severity, what: &str| findings.push(Found::said(severity, what, name));
        let unweighed = match &around {
            Around::Nothing => None,
            Around::Rows(chain) => {
                if let Some(agreement) = chain.agreement {
                    let how = words.agreement(agreement, Whole::Tree);
                    let note = format!("from `{}` to `{}`: {how}", chain.from, chain.to);
                    say(FindingSeverity::Note, &note);
                }
                chain.unweighed.as_ref()
            }
            Around::Bodies(both) => {
                say(FindingSeverity::Note, &words.chain(&both.1, &both.0));
                both.1.unweighed.as_ref()
            }
        };
        let unweighed = unweighed.map(ToString::to_string);
        if let Some(why) = &unweighed {
            say(FindingSeverity::Warning, why);
        }
        Ok(Facts { unweighed, ..Facts::of(&description, findings) })
    }
}

impl Facts {
    /// What a description says.
    pub fn of(d: &Description, findings: Vec<Found>) -> Self {
        let number = |e: Expr| e.eval(|s| d.value(s)).ok().filter(|x| x.is_finite());
        let joints = d.rows.iter().filter_map(|row| {
            let v = row.variable?;
            Some(Joint {
                variable: text(&v.symbol.name()),
                name: row.name.as_deref().map(text),
                kind: match v.kind {
                    Kind::Revolute => JointKind::Revolute,
                    Kind::Prismatic => JointKind::Prismatic,
                },
                limits: row.limits.and_then(|[a, b]| Some([number(a)?, number(b)?])),
                velocity: row.velocity.and_then(number),
            })
        });
        Facts {
            text: text(&write_toml(d)),
            name: text(&d.name),
            convention: d.convention,
            joints: joints.collect(),
            rows: d.rows.len(),
            has_masses: d.has_masses(),
            unweighed: None,
            findings,
        }
    }
}
