//! Robots by name, from files and texts.

use crate::trouble::{Found, Kind, Trouble, all_found, apart, found, said};
use denavit::description::{
    Convention, Description, JointKind, NoChain, TableOptions, read_robot, read_toml, write_toml,
};
use denavit_load::{
    Around, Content, ENDINGS, NotTaken, Options, Problem, catalogue_name, close_names, listed, read,
};
use denavit_report::document::plain;
use denavit_report::words::{Tongue, Whole};
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::Vocabulary;
use pyo3::{PyResult, Python};
use std::path::PathBuf;

/// Metres that a person could see.
const SEEN: f64 = 1e-9;

/// A robot as it is asked for.
#[derive(Clone, Default)]
pub struct Request {
    /// A name of the catalogue, or the path of a file.
    pub name: String,
    /// Whether it is a file.
    pub is_file: bool,
    /// The link or frame at which the chain begins.
    pub base: Option<String>,
    /// The link or frame at which it ends.
    pub tip: Option<String>,
    /// The convention of a table that does not say it, or of the table that is made of bodies.
    pub convention: Option<String>,
    /// Values of a xacro file's arguments.
    pub arguments: Vec<(String, String)>,
    /// Folders of packages.
    pub packages: Vec<(String, PathBuf)>,
    /// Whether decimals of angles are taken as they are written.
    pub as_written: bool,
    /// `deg` or `rad`: the unit of angles without unit in a table.
    pub angles: Option<String>,
    /// `mm` or `m`: the unit of lengths without unit in a table.
    pub lengths: Option<String>,
    /// Which table or robot of a document, from 1.
    pub table: Option<usize>,
    /// What the columns of a table mean.
    pub columns: Option<String>,
}

/// What a robot is known by.
#[derive(Clone)]
pub struct Facts {
    /// The text of its file.
    pub text: String,
    /// What people call it.
    pub name: String,
    /// Where the numbers come from.
    pub source: Option<String>,
    /// The convention of the table.
    pub convention: &'static str,
    /// Variable, name, kind, limits and largest speed of each joint.
    pub joints: Vec<Joint>,
    /// Names of parameters, with their values.
    pub parameters: Vec<(String, Option<f64>)>,
    /// Named configurations.
    pub poses: Vec<(String, Vec<f64>)>,
    /// The heading and the rows of its table.
    pub table: (Vec<String>, Vec<Vec<String>>),
    /// Whether it says something of masses.
    pub has_masses: bool,
    /// Why it says nothing of masses though its file does.
    pub unweighed: Option<String>,
    /// Warnings and notes.
    pub findings: Vec<Found>,
}

/// Variable, name, kind, limits and largest speed.
pub type Joint = (String, Option<String>, &'static str, Option<(f64, f64)>, Option<f64>);

/// The convention of a name.
///
/// # Errors
/// If there is none.
pub fn convention(name: &str) -> Result<Convention, Trouble> {
    let known = Convention::ALL.into_iter().find(|c| c.name() == name);
    known.ok_or_else(|| {
        Trouble::new(Kind::Usage, format!("no convention `{name}`: standard, craig or khalil"))
    })
}

impl Request {
    fn options(&self) -> Result<Options, Trouble> {
        let unit = |given: &Option<String>, small: &str, large: &str| match given.as_deref() {
            None => Ok(None),
            Some(unit) if unit == small => Ok(Some(true)),
            Some(unit) if unit == large => Ok(Some(false)),
            Some(unit) => Err(Trouble::new(Kind::Usage, format!("no unit `{unit}`: {small} or {large}"))),
        };
        Ok(Options {
            arguments: self.arguments.clone(),
            as_written: self.as_written,
            packages: self.packages.clone(),
            table: TableOptions {
                convention: self.convention.as_deref().map(convention).transpose()?,
                angles_in_degrees: unit(&self.angles, "deg", "rad")?,
                lengths_in_millimetres: unit(&self.lengths, "mm", "m")?,
                table: self.table,
                columns: self.columns.clone(),
            },
        })
    }

    /// Reads the robot; its formulas belong to this thread.
    ///
    /// # Errors
    /// If there is none.
    pub fn load(&self) -> Result<Facts, Trouble> {
        if !self.is_file {
            let name = catalogue_name(&self.name);
            let Some((name, text)) = name.as_deref().and_then(|n| Some((n, listed(n)?))) else {
                let close = close_names(&self.name);
                let hint = match &close[..] {
                    [] => "`denavit.catalogue()` lists all; `Robot.from_file` reads files".to_string(),
                    close => format!("did you mean {}?", close.join(", ")),
                };
                return Err(Trouble::new(Kind::Unknown, format!("no robot `{}`: {hint}", self.name)));
            };
            let place = |all: Vec<_>| all.iter().map(|d| found(d, name, text)).collect::<Vec<_>>();
            let (read, findings) = read_robot(text).map_err(|all| Trouble::of(place(all)))?;
            return self.chain_of(Content::Rows(read), place(findings));
        }
        let name = &self.name;
        let kind = denavit_load::Kind::of(name);
        let kind = kind.filter(|_| name != "-").ok_or_else(|| {
            Trouble::new(
                Kind::File,
                match std::fs::metadata(name) {
                    Err(e) => format!("{name}: {e}"),
                    Ok(_) => format!("{name}: what is this? {ENDINGS}"),
                },
            )
        })?;
        let file = read(name, kind, &self.options()?).map_err(|why| match why {
            Problem::Unreadable(e) => Trouble::new(Kind::File, format!("{name}: {e}")),
            Problem::Errors(findings) => Trouble::of(all_found(&findings)),
            Problem::TakesNoArguments => Trouble::new(
                Kind::Usage,
                format!("arguments are for xacro files, and {name} is a model of MuJoCo's"),
            ),
            Problem::NoFolder(folder) => {
                Trouble::new(Kind::Usage, format!("packages: there is no folder {}", folder.display()))
            }
        })?;
        let mut findings = all_found(&file.findings);
        if file.apart > SEEN {
            findings.push(said("note", Tongue::English.words().read_apart(file.apart), name));
        }
        self.chain_of(file.content, findings)
    }

    fn chain_of(&self, content: Content, mut findings: Vec<Found>) -> Result<Facts, Trouble> {
        let words = Tongue::English.words();
        let name = self.name.as_str();
        let given = self.convention.as_deref().map(convention).transpose()?;
        let taken = content.chain(name, self.base.as_deref(), self.tip.as_deref(), None, given);
        let (description, around) = taken.map_err(|why| {
            let why = match why {
                NotTaken::NotCoupled(why) => format!("{name}: {why}"),
                NotTaken::NoLoops => format!("{name} has no closed loops"),
                NotTaken::OneChain => format!("{name} is one chain: it has no links to choose from"),
                NotTaken::NoChain(why) => {
                    let hint = if matches!(why, NoChain::Several(_)) { "; name one as `tip`" } else { "" };
                    format!("{name}: {why}{hint}")
                }
            };
            Trouble::new(Kind::Chain, why)
        })?;
        let unweighed = match &around {
            Around::Nothing => None,
            Around::Rows(chain) => {
                if let Some(agreement) = chain.agreement {
                    let how = words.agreement(agreement, Whole::Tree);
                    let note = format!("from `{}` to `{}`: {how}", chain.from, chain.to);
                    findings.push(said("note", note, name));
                }
                chain.unweighed.as_ref()
            }
            Around::Bodies(both) => {
                findings.push(said("note", words.chain(&both.1, &both.0), name));
                both.1.unweighed.as_ref()
            }
        };
        let unweighed = unweighed.map(ToString::to_string);
        findings.extend(unweighed.clone().map(|why| said("warning", why, name)));
        Ok(Facts { unweighed, ..Facts::of(&description, findings) })
    }
}

/// Reads a robot file that stands in a text.
///
/// # Errors
/// If it has errors.
pub fn from_text(text: &str, name: &str) -> Result<Facts, Trouble> {
    let place = |all: Vec<_>| all.iter().map(|d| found(d, name, text)).collect::<Vec<_>>();
    let (description, findings) = read_toml(text).map_err(|all| Trouble::of(place(all)))?;
    Ok(Facts::of(&description, place(findings)))
}

/// What is made of the description that a text of [`Facts`] holds, on a thread of its own.
///
/// # Errors
/// Those of the work; or if the text has errors.
pub fn derive<T: Send + 'static>(
    py: Python<'_>,
    text: &str,
    work: impl FnOnce(&Description) -> Result<T, Trouble> + Send + 'static,
) -> PyResult<T> {
    let text = text.to_string();
    apart(py, move || {
        let place = |all: Vec<_>| all.iter().map(|d| found(d, "robot", &text)).collect::<Vec<_>>();
        let (description, _) = read_toml(&text).map_err(|all| Trouble::of(place(all)))?;
        work(&description)
    })
}

impl Facts {
    /// What a description says.
    pub fn of(d: &Description, findings: Vec<Found>) -> Self {
        let number = |e: Expr| e.eval(|s| d.value(s)).ok().filter(|x| x.is_finite());
        let limits = |l: [Expr; 2]| Some((number(l[0])?, number(l[1])?));
        let joints = d.rows.iter().filter_map(|row| {
            let v = row.variable?;
            let kind = match v.kind {
                JointKind::Revolute => "revolute",
                JointKind::Prismatic => "prismatic",
            };
            let speed = row.velocity.and_then(number);
            Some((v.symbol.name().to_string(), row.name.clone(), kind, row.limits.and_then(limits), speed))
        });
        let pose = |(name, values): &(String, Vec<Expr>)| {
            let values: Option<Vec<f64>> = values.iter().map(|&e| number(e)).collect();
            Some((name.clone(), values?))
        };
        Facts {
            text: write_toml(d),
            name: d.name.clone(),
            source: d.source.clone(),
            convention: d.convention.name(),
            joints: joints.collect(),
            parameters: d
                .parameters
                .iter()
                .map(|p| (p.symbol.name().to_string(), d.value(p.symbol)))
                .collect(),
            poses: d.poses.iter().filter_map(pose).collect(),
            table: table(d),
            has_masses: d.has_masses(),
            unweighed: None,
            findings,
        }
    }
}

/// The table in its own letters.
fn table(d: &Description) -> (Vec<String>, Vec<Vec<String>>) {
    let columns = d.columns();
    let cell = |e: Expr, is_angle: bool| {
        plain(&denavit_report::cell(e, is_angle, Tongue::English.words()), &Vocabulary::new())
    };
    let letters = columns.iter().map(|c| c.letter(d.convention).to_string());
    let head = ["j".to_string(), String::new()].into_iter().chain(letters).chain(["limits".to_string()]);
    let rows = d.rows.iter().enumerate().map(|(i, row)| {
        let turns = row.variable.is_some_and(|v| v.kind == JointKind::Revolute);
        let kind = row.variable.map_or("–", |v| if v.kind == JointKind::Revolute { "R" } else { "P" });
        let cells = columns.iter().map(|c| cell(c.of(row), c.turns()));
        let unit = if turns { "" } else { " m" };
        let limits = row.limits.map(|l| format!("{} … {}{unit}", cell(l[0], turns), cell(l[1], turns)));
        let all = [(i + 1).to_string(), kind.to_string()].into_iter().chain(cells);
        all.chain([limits.unwrap_or_default()]).collect()
    });
    (head.collect(), rows.collect())
}
