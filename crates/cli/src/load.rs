//! From what stands on the command line to a robot.

mod linkage;
mod parallel;
mod rows;
mod urdf;

pub use denavit_load::{Around, contents, frame, is_tree, joint};
use linkage::closed_tree;
pub use linkage::{WholeLinkage, beside_chain, linkage, loops, whole, without_chain};
pub use parallel::{no_parallel, parallel};
pub use urdf::bundle;

use crate::arguments::{AngleUnit, LengthUnit, RobotArguments};
use crate::failure::Failure;
use crate::terminal::{decimals, note};
use denavit::description::{
    Described, Description, Diagnostic, MAX_BYTES, Measure, Mechanism, RowTree, Severity, TableOptions,
    read_robot, read_table_robot, read_value, write_toml,
};
use denavit_load::{
    Content, Contents, ENDINGS, Finding, Kind, Options, Problem, catalogue_name, close_names, listed,
};
use denavit_symbolic::Expr;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Reads the robot that the arguments name; what is worth saying about it goes to standard error.
///
/// # Errors
/// If there is no such robot, or its file cannot be read or has errors.
pub fn robot(arguments: &RobotArguments) -> Result<Description, Failure> {
    Ok(robot_file(arguments)?.0)
}

/// Reads the robot as [`robot`] does, with what its chain was taken out of.
///
/// # Errors
/// If there is no such robot, or its file cannot be read or has errors.
pub fn robot_and_around(arguments: &RobotArguments) -> Result<(Description, Around), Failure> {
    let (description, _, around) = all(arguments)?;
    Ok((description, around))
}

/// Reads the robot as [`robot`] does, and gives it as the text of a robot file, too: as it was written where that is all
/// that there is to it, else as it is to be written.
///
/// # Errors
/// If there is no such robot, or its file cannot be read or has errors.
pub fn robot_file(arguments: &RobotArguments) -> Result<(Description, String), Failure> {
    let (description, text, _) = all(arguments)?;
    Ok((description, text))
}

fn all(arguments: &RobotArguments) -> Result<(Description, String, Around), Failure> {
    no_parallel(arguments)?;
    let name = catalogue_name(&arguments.robot);
    let listed = name.as_deref().and_then(|n| Some((n, listed(n)?)));
    check_options(arguments, listed.is_some())?;
    let (mut description, text, around) = match listed {
        Some((name, text)) => robot_of_rows(arguments, read(name, text, read_robot(text))?, text)?,
        None => from_file(arguments)?,
    };
    let mut seen: Vec<&str> = vec![];
    // What has closed loops has its values already: they decide how its loops close.
    let is_closed = matches!(&around, Around::Rows(chain) if chain.closed.is_some());
    for setting in arguments.set.iter().filter(|_| !is_closed) {
        let name = setting.split('=').next().unwrap_or_default().trim();
        if seen.contains(&name) {
            return Err(Failure::Usage(format!("--set gives {name} two values")));
        }
        seen.push(name);
        let (name, value) = name_and_value(setting)?;
        description.set(&name, &value).map_err(|why| Failure::Usage(format!("--set {setting}: {why}")))?;
    }
    let text = text.filter(|_| arguments.set.is_empty()).unwrap_or_else(|| write_toml(&description));
    Ok((description, text, around))
}

/// A chain, its text if it has one, and what it was taken out of.
type Found = (Description, Option<String>, Around);

/// Options that are for other kinds of files are refused.
fn check_options(arguments: &RobotArguments, is_listed: bool) -> Result<(), Failure> {
    let is_urdf = !is_listed && is_tree(&arguments.robot);
    let is_par = !is_listed && arguments.robot.ends_with(".par");
    let is_table = !is_listed && !is_urdf && !is_par && !arguments.robot.ends_with(".toml");
    if let (false, Some(option)) = (is_table, table_option(arguments, is_urdf || is_par)) {
        return Err(Failure::Usage(format!(
            "{option} is for tables, and {} says it itself",
            arguments.robot
        )));
    }
    if let (false, Some(option)) = (is_urdf, urdf_option(arguments, is_par)) {
        return Err(Failure::Usage(format!("{option} is for URDF files, and {} is none", arguments.robot)));
    }
    Ok(())
}

/// True for what is read as a robot file, the catalogue's among them: its reader says which rows are no body.
pub fn is_robot_file(name: &str) -> bool {
    let is_listed = catalogue_name(name).is_some_and(|n| listed(&n).is_some());
    is_listed || Path::new(name).extension().is_some_and(|ending| ending == "toml")
}

/// The option given that only a URDF can need; `.par` files hold decimals, too.
fn urdf_option(arguments: &RobotArguments, is_par: bool) -> Option<&'static str> {
    let given = [
        (arguments.as_written && !is_par, "--as-written"),
        (!arguments.arg.is_empty(), "--arg"),
        (!arguments.package.is_empty(), "--package"),
    ];
    given.into_iter().find(|g| g.0).map(|g| g.1)
}

/// The option given that only a table can need; a convention can be asked of a URDF as well.
fn table_option(arguments: &RobotArguments, is_urdf: bool) -> Option<&'static str> {
    let given = [
        (arguments.convention.is_some() && !is_urdf, "--convention"),
        (arguments.angles.is_some(), "--angles"),
        (arguments.lengths.is_some(), "--lengths"),
        (arguments.table.is_some(), "--table"),
        (arguments.columns.is_some(), "--columns"),
    ];
    given.into_iter().find(|g| g.0).map(|g| g.1)
}

/// The robot, and the text of its file if that is a robot file.
fn from_file(arguments: &RobotArguments) -> Result<Found, Failure> {
    let without_text = |(description, around)| (description, None, around);
    let name = arguments.robot.as_str();
    match Kind::of(name) {
        Some(Kind::Bodies) => urdf::from_urdf(arguments).map(without_text),
        Some(Kind::Par) => rows::from_par(arguments).map(without_text),
        Some(Kind::Program(language)) => rows::from_program(arguments, language).map(without_text),
        Some(kind @ (Kind::Robot | Kind::Table(_))) => {
            let file = file(arguments, kind)?;
            let Content::Rows(described) = file.content else { return Err(unknown_robot(name)) };
            let (description, written, around) = robot_of_rows(arguments, described, &file.text)?;
            Ok((description, written.filter(|_| kind == Kind::Robot), around))
        }
        None if Path::new(name).is_file() => {
            Err(Failure::Input(format!("error: {name}: what is this?\n  = hint: {ENDINGS}")))
        }
        None => Err(unknown_robot(name)),
    }
}

/// The file that the arguments name, of this kind; what is worth saying about it goes to standard error.
fn file(arguments: &RobotArguments, kind: Kind) -> Result<Contents, Failure> {
    let name = arguments.robot.as_str();
    let file = denavit_load::read(name, kind, &options(arguments)?).map_err(|why| match why {
        Problem::Unreadable(e) => Failure::Input(format!("error: {name}: {e}")),
        Problem::Errors(findings) => Failure::Input(rendered(&findings)),
        Problem::TakesNoArguments => {
            Failure::Usage(format!("--arg is for xacro files, and {name} is a model of MuJoCo's"))
        }
        Problem::NoFolder(folder) => {
            Failure::Usage(format!("--package: there is no folder {}", folder.display()))
        }
    })?;
    note(rendered(&file.findings).trim_end());
    Ok(file)
}

/// How the arguments want their file to be read.
fn options(arguments: &RobotArguments) -> Result<Options, Failure> {
    let packages = pairs(&arguments.package, "--package", "ur_description=../ur_description")?;
    Ok(Options {
        arguments: pairs(&arguments.arg, "--arg", "name=ur5")?,
        as_written: arguments.as_written,
        packages: packages.into_iter().map(|(n, p)| (n, p.into())).collect(),
        table: table_options(arguments),
    })
}

/// `NAME=VALUE`, or `NAME:=VALUE` as ROS writes it.
fn pairs(settings: &[String], option: &str, example: &str) -> Result<Vec<(String, String)>, Failure> {
    let pair = |setting: &String| {
        let sides = setting.split_once(":=").or_else(|| setting.split_once('='));
        let sides = sides.map(|(name, value)| (name.trim().to_string(), value.trim().to_string()));
        sides.ok_or_else(|| Failure::Usage(format!("{option} {setting}: write NAME=VALUE, as in {example}")))
    };
    settings.iter().map(pair).collect()
}

/// The chain of what was read, and its text if that describes just this chain.
fn robot_of_rows(arguments: &RobotArguments, described: Described, text: &str) -> Result<Found, Failure> {
    let is_chain = matches!(described, Described::Chain(_));
    if let Described::Linkage(of) = described {
        let (description, around) = linkage::chain(arguments, of)?;
        return Ok((description, None, around));
    }
    let (description, around) = rows::chain(arguments, Content::Rows(described))?;
    Ok((description, is_chain.then(|| text.to_string()), around))
}

/// The tree of bodies or rows that the arguments name, if it is one and no chain of it is asked for.
///
/// # Errors
/// If the file cannot be read or has errors.
pub fn mechanism(arguments: &RobotArguments) -> Result<Option<Tree>, Failure> {
    if arguments.base.is_some() || arguments.tip.is_some() {
        return Ok(None);
    }
    no_parallel(arguments)?;
    let name = arguments.robot.as_str();
    let listed = catalogue_name(name).and_then(|n| listed(&n)).map(str::to_string);
    let tree = match Kind::of(name) {
        Some(Kind::Bodies) if listed.is_none() => {
            check_options(arguments, false)?;
            match urdf::bodies(arguments)? {
                Content::Bodies(mechanism) => Tree::Bodies(*mechanism),
                Content::Rows(Described::Linkage(of)) => match closed_tree(arguments, &of) {
                    Some(tree) => Tree::Rows(tree),
                    None => return Ok(None),
                },
                _ => return Ok(None),
            }
        }
        Some(Kind::Par) => {
            check_options(arguments, false)?;
            match rows::par(arguments)? {
                Content::Par(tree) if !tree.is_chain() => Tree::Rows(*tree),
                Content::Rows(Described::Linkage(of)) => match closed_tree(arguments, &of) {
                    Some(tree) => Tree::Rows(tree),
                    None => return Ok(None),
                },
                _ => return Ok(None),
            }
        }
        kind => {
            let is_listed = listed.is_some();
            let read = |text: &str| match kind {
                _ if is_listed => Some(read_robot(text)),
                Some(Kind::Robot) => Some(read_robot(text)),
                Some(Kind::Table(kind)) => Some(read_table_robot(text, kind, &table_options(arguments))),
                _ => None,
            };
            let text = match (listed, kind) {
                (Some(text), _) => Some(text),
                (None, Some(Kind::Robot | Kind::Table(_))) => contents(name, MAX_BYTES).ok(),
                _ => None,
            };
            let Some(Ok((described, findings))) = text.as_deref().and_then(read) else {
                return Ok(None);
            };
            let tree = match described {
                Described::Tree(tree) => *tree,
                Described::Linkage(of) => match closed_tree(arguments, &of) {
                    Some(tree) => tree,
                    None => return Ok(None),
                },
                Described::Chain(_) => return Ok(None),
            };
            check_options(arguments, is_listed)?;
            note(render(&findings, name, text.as_deref().unwrap_or_default()).trim_end());
            Tree::Rows(tree)
        }
    };
    if !arguments.set.is_empty() {
        return Err(Failure::Usage("--set is for one chain: name its end with --tip".into()));
    }
    Ok(Some(tree))
}

/// A whole tree.
pub enum Tree {
    /// As bodies and joints between them.
    Bodies(Mechanism),
    /// As rows.
    Rows(RowTree),
}

impl Tree {
    /// The same, lent.
    pub fn as_ref(&self) -> denavit::mechanism::Tree<'_> {
        match self {
            Tree::Bodies(m) => denavit::mechanism::Tree::Bodies(m),
            Tree::Rows(rows) => denavit::mechanism::Tree::Rows(rows),
        }
    }
}

/// How tables are to be read.
pub fn table_options(arguments: &RobotArguments) -> TableOptions {
    TableOptions {
        convention: arguments.convention.map(Into::into),
        angles_in_degrees: arguments.angles.map(|u| u == AngleUnit::Deg),
        lengths_in_millimetres: arguments.lengths.map(|u| u == LengthUnit::Mm),
        table: arguments.table,
        columns: arguments.columns.clone(),
    }
}

type Reading = Result<(Described, Vec<Diagnostic>), Vec<Diagnostic>>;

fn read(name: &str, text: &str, outcome: Reading) -> Result<Described, Failure> {
    match outcome {
        Ok((described, findings)) => {
            note(render(&findings, name, text).trim_end());
            Ok(described)
        }
        Err(findings) => Err(Failure::Input(render(&findings, name, text))),
    }
}

fn rendered(findings: &[Finding]) -> String {
    findings.iter().map(|f| coloured(&f.diagnostic, &f.name, &f.text)).collect()
}

fn render(findings: &[Diagnostic], name: &str, text: &str) -> String {
    findings.iter().map(|d| coloured(d, name, text)).collect()
}

fn coloured(finding: &Diagnostic, name: &str, text: &str) -> String {
    use anstyle::{AnsiColor, Style};
    let style: Style = match finding.severity {
        Severity::Error => AnsiColor::Red.on_default().bold(),
        Severity::Warning => AnsiColor::Yellow.on_default().bold(),
        Severity::Note => AnsiColor::Cyan.on_default(),
    };
    let word = finding.severity.name();
    finding.render(name, text).replacen(word, &format!("{style}{word}{style:#}"), 1)
}

fn unknown_robot(name: &str) -> Failure {
    let close = close_names(name);
    let hint = match &close[..] {
        [] => {
            "`denavit robots` lists the catalogue; files end in .toml, .par, .urdf, .xacro, .xml, .mjcf, .md, .txt, .csv, .tsv, .tex, .m or .py"
                .to_string()
        }
        names => format!("did you mean {}?", names.join(", ")),
    };
    Failure::Input(format!("error: no robot or file `{name}`\n  = hint: {hint}"))
}

/// The two sides of `NAME=VALUE`.
///
/// # Errors
/// If there is no equals sign.
pub fn name_and_value(setting: &str) -> Result<(String, String), Failure> {
    let sides = setting.split_once('=').map(|(name, value)| (name.trim().into(), value.trim().into()));
    sides.ok_or_else(|| Failure::Usage(format!("--set {setting}: write NAME=VALUE, as in D3=450mm")))
}

/// The values of a list: between commas or semicolons that stand in no bracket, or between blanks if there are none; brackets
/// around all of it are taken off.
pub fn list(text: &str) -> Vec<&str> {
    let text = unbracketed(text.trim());
    let mut depth = 0;
    let is_between = |c: char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        depth == 0 && matches!(c, ',' | ';')
    };
    let parts: Vec<&str> = text.split(is_between).map(str::trim).collect();
    if parts.len() > 1 { parts } else { text.split_whitespace().collect() }
}

/// The text without brackets around it that belong together.
pub fn unbracketed(text: &str) -> &str {
    let mut depth = 0;
    let closes = text.char_indices().find_map(|(at, c)| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(at)
    });
    let inner = text.strip_prefix(['(', '[']).and_then(|rest| rest.strip_suffix([')', ']']));
    match inner {
        Some(inner) if closes == Some(text.len() - 1) => unbracketed(inner.trim()),
        _ => text,
    }
}

/// Says once that an angle without unit is one in radians, where it is more than a turn.
pub fn note_of_radians(text: &str, name: &str, x: f64) {
    static SAID: AtomicBool = AtomicBool::new(false);
    // An exponent is no unit.
    let has_unit = text.contains(|c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E') || c == '°');
    if has_unit || x.abs() <= TAU {
        return;
    }
    if !SAID.swap(true, Ordering::Relaxed) {
        let turns = decimals(x / TAU, 2);
        note(&format!("note: {name} = {text} is in radians, {turns} turns: for degrees write `{text}deg`"));
    }
}

/// A constant with or without unit.
///
/// # Errors
/// A sentence that says what is wrong.
pub fn value_of(text: &str, measure: Measure) -> Result<Expr, String> {
    read_value(text.trim(), measure).map_err(|findings| {
        let sentences = findings.iter().map(|d| match &d.hint {
            Some(hint) => format!("{} ({hint})", d.message),
            None => d.message.clone(),
        });
        sentences.collect::<Vec<_>>().join("; ")
    })
}
