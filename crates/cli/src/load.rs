//! From what stands on the command line to a robot.

mod files;
mod rows;
mod urdf;

pub use urdf::bundle;

use crate::arguments::{AngleUnit, LengthUnit, RobotArguments};
use crate::failure::Failure;
use crate::terminal::{decimals, note};
use denavit::catalogue;
use denavit::description::{
    Chain, Described, Description, Diagnostic, Language, MAX_BYTES, Measure, Mechanism, NamedFrame, Row,
    RowChain, RowTree, Severity, TableKind, TableOptions, Variable, read_robot, read_table_robot, read_value,
    root_element, write_toml,
};
use denavit_symbolic::Expr;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Reads the robot that the arguments name; what is worth saying about it goes to standard error.
///
/// # Errors
/// If there is no such robot, or its file cannot be read or has errors.
pub fn robot(arguments: &RobotArguments) -> Result<Description, Failure> {
    Ok(robot_file(arguments)?.0)
}

/// What a chain was taken out of.
pub enum Around {
    /// It is all that there is.
    Nothing,
    /// A tree of bodies.
    Bodies(Box<(Mechanism, Chain)>),
    /// A tree of rows.
    Rows(Box<RowChain>),
}

impl Around {
    /// The joints beside the chain behind which something weighs that hangs on it.
    pub fn held_joints(&self) -> Vec<String> {
        match self {
            Around::Nothing => vec![],
            Around::Bodies(both) => both.1.held.iter().map(|&j| both.0.joints[j].name.clone()).collect(),
            Around::Rows(chain) => chain.held.clone(),
        }
    }

    /// What the drives of the chain's joints can do by the file, newton metres or newtons, one a joint variable; nothing where it is
    /// no tree of bodies.
    pub fn efforts(&self) -> Option<Vec<Option<f64>>> {
        let Around::Bodies(both) = self else { return None };
        let (mechanism, chain) = &**both;
        let value = |s| chain.description.value(s);
        let of = |&j: &usize| mechanism.joints[j].effort.and_then(|e| e.eval(value).ok());
        Some(chain.joints.iter().map(of).collect())
    }

    /// The frames that do not move on those of the chain's table, by their names.
    pub fn frames(&self) -> Vec<NamedFrame> {
        match self {
            Around::Nothing => vec![],
            Around::Bodies(both) => both.0.frames(&both.1),
            Around::Rows(chain) => chain.frames.clone(),
        }
    }
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
    let name = catalogue_name(&arguments.robot);
    let listed = name.as_deref().and_then(|n| Some((n, listed(n)?)));
    check_options(arguments, listed.is_some())?;
    let (mut description, text, around) = match listed {
        Some((name, text)) => robot_of_rows(arguments, read(name, text, read_robot(text))?, text)?,
        None => from_file(arguments)?,
    };
    let mut seen: Vec<&str> = vec![];
    for setting in &arguments.set {
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

/// The endings of files of bodies and joints, and those of others that are known.
const TREES: [&str; 4] = ["urdf", "xacro", "xml", "mjcf"];
const OTHERS: [&str; 10] = ["toml", "md", "markdown", "txt", "csv", "tsv", "tex", "par", "m", "py"];
/// How much of a file is looked at for its root element.
const HEAD: u64 = 1 << 16;

/// True for a file of bodies and joints: a URDF, or a model of MuJoCo's. Which, its root element says; that it is one, too, where its
/// ending says nothing.
pub fn is_tree(name: &str) -> bool {
    let path = Path::new(name);
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if TREES.contains(&ending) || OTHERS.contains(&ending) || name == "-" || !path.is_file() {
        return TREES.contains(&ending);
    }
    let mut head = vec![];
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    let text = String::from_utf8_lossy(&head);
    read.is_ok() && matches!(root_element(&text), Some("robot" | "mujoco" | "mujocoinclude" | "sdf"))
}

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

/// The catalogue's spelling: lower case, words joined by hyphens. `None` for what looks like a path.
fn catalogue_name(text: &str) -> Option<String> {
    let is_path = text.contains(['/', '\\', '.']) || text == "-";
    (!is_path).then(|| text.to_lowercase().replace([' ', '_'], "-"))
}

/// True for what is read as a robot file, the catalogue's among them: its reader says which rows are no body.
pub fn is_robot_file(name: &str) -> bool {
    let is_listed = catalogue_name(name).is_some_and(|n| listed(&n).is_some());
    is_listed || Path::new(name).extension().is_some_and(|ending| ending == "toml")
}

/// The file of an arm of the catalogue, or of a structure beside it.
fn listed(name: &str) -> Option<&'static str> {
    catalogue::text(name).or_else(|| catalogue::structure_text(name))
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

/// The kind of tables in a file with this ending.
fn table_kind(ending: &str) -> Option<TableKind> {
    match ending {
        "md" | "markdown" | "txt" => Some(TableKind::Markdown),
        "csv" | "tsv" => Some(TableKind::Csv),
        "tex" => Some(TableKind::Latex),
        _ => None,
    }
}

/// The robot, and the text of its file if that is a robot file.
fn from_file(arguments: &RobotArguments) -> Result<Found, Failure> {
    let without_text = |(description, around)| (description, None, around);
    let name = arguments.robot.as_str();
    let path = Path::new(name);
    let kind = match path.extension().and_then(|e| e.to_str()) {
        _ if name == "-" => Some(TableKind::Markdown),
        Some("toml") => None,
        Some(ending) if let Some(kind) = table_kind(ending) => Some(kind),
        _ if is_tree(name) => return urdf::from_urdf(arguments).map(without_text),
        Some("par") => return rows::from_par(arguments).map(without_text),
        Some("m") => return rows::from_program(arguments, Language::Matlab).map(without_text),
        Some("py") => return rows::from_program(arguments, Language::Python).map(without_text),
        _ if path.is_file() => {
            let hint = "a robot file ends in .toml, .urdf, .xacro, .xml, .mjcf or .par, a table in .md, .txt, .csv, .tsv or .tex, a program in .m or .py";
            return Err(Failure::Input(format!("error: {name}: what is this?\n  = hint: {hint}")));
        }
        _ => return Err(unknown_robot(name)),
    };
    let text = contents(name, MAX_BYTES).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let outcome = match kind {
        None => read_robot(&text),
        Some(kind) => read_table_robot(&text, kind, &table_options(arguments)),
    };
    let (description, written, around) = robot_of_rows(arguments, read(name, &text, outcome)?, &text)?;
    Ok((description, written.filter(|_| kind.is_none()), around))
}

/// The chain of what was read, and its text if that describes just this chain.
fn robot_of_rows(arguments: &RobotArguments, described: Described, text: &str) -> Result<Found, Failure> {
    let is_chain = matches!(described, Described::Chain(_));
    let (description, around) = rows::chain(arguments, described)?;
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
    let name = arguments.robot.as_str();
    let listed = catalogue_name(name).and_then(|n| listed(&n)).map(str::to_string);
    let tree = match Path::new(name).extension().and_then(|e| e.to_str()) {
        _ if listed.is_none() && is_tree(name) => {
            check_options(arguments, false)?;
            Tree::Bodies(urdf::mechanism(arguments)?)
        }
        Some("par") => {
            check_options(arguments, false)?;
            let tree = rows::par(arguments)?;
            if tree.is_chain() {
                return Ok(None);
            }
            Tree::Rows(tree)
        }
        _ => {
            let is_listed = listed.is_some();
            let is_toml = is_listed || name.ends_with(".toml");
            let kind = Path::new(name).extension().and_then(|e| e.to_str()).and_then(table_kind);
            // Standard input, which has no ending, can be read but once: it is one chain.
            let text = match listed {
                None if is_toml || kind.is_some() => contents(name, MAX_BYTES).ok(),
                listed => listed,
            };
            let read = |text: &str| match kind {
                _ if is_toml => Some(read_robot(text)),
                Some(kind) => Some(read_table_robot(text, kind, &table_options(arguments))),
                None => None,
            };
            let Some(Ok((Described::Tree(tree), findings))) = text.as_deref().and_then(read) else {
                return Ok(None);
            };
            check_options(arguments, is_listed)?;
            note(render(&findings, name, text.as_deref().unwrap_or_default()).trim_end());
            Tree::Rows(*tree)
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

/// The text of a file or of standard input, bounded (one byte more says that there are more), whatever its bytes are.
///
/// # Errors
/// If it cannot be read.
pub fn contents(name: &str, most: usize) -> io::Result<String> {
    let limit = most as u64 + 1;
    let mut bytes = vec![];
    if name == "-" {
        io::stdin().lock().take(limit).read_to_end(&mut bytes)?;
    } else {
        File::open(name)?.take(limit).read_to_end(&mut bytes)?;
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
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
    let names = catalogue::names().into_iter().chain(catalogue::structures());
    let close: Vec<&str> = names.filter(|n| similar(n, name)).take(6).collect();
    let hint = match &close[..] {
        [] => {
            "`denavit robots` lists the catalogue; files end in .toml, .par, .urdf, .xacro, .xml, .mjcf, .md, .txt, .csv, .tsv, .tex, .m or .py"
                .to_string()
        }
        names => format!("did you mean {}?", names.join(", ")),
    };
    Failure::Input(format!("error: no robot or file `{name}`\n  = hint: {hint}"))
}

/// Whether a catalogue name is what somebody may have meant: it holds the text, or most of its letters in order.
fn similar(candidate: &str, text: &str) -> bool {
    let plain = |s: &str| s.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect::<String>();
    let (candidate, text) = (plain(candidate), plain(text));
    if text.len() < 2 {
        return false;
    }
    let mut rest = candidate.chars();
    let found = text.chars().filter(|&c| rest.clone().any(|r| r == c) && rest.any(|r| r == c)).count();
    candidate.contains(&text) || (found + 1 >= text.len() && text.len() + 3 >= candidate.len())
}

/// The joint (from 0) that a word names: by its number from 1, its variable, or the name of its row.
///
/// # Errors
/// A sentence that says which there are.
pub fn joint(d: &Description, word: &str) -> Result<usize, String> {
    let moving: Vec<_> = d.rows.iter().filter_map(|r| Some((r.variable?, r.name.as_deref()))).collect();
    let number = word.parse().ok().filter(|n| (1..=moving.len()).contains(n)).map(|n: usize| n - 1);
    let variable = moving.iter().position(|m| *m.0.symbol.name() == *word);
    let named = moving.iter().position(|m| m.1 == Some(word));
    if let (None, Some(v), Some(n)) = (number, variable, named.filter(|n| variable != Some(*n))) {
        let what = format!("`{word}` is the variable of joint {} and the name of joint {}", v + 1, n + 1);
        return Err(format!("{what}: name it by its number"));
    }
    let found = number.or(variable).or(named);
    found.ok_or_else(|| {
        let follows = d.rows.iter().find(|r| r.variable.is_none() && r.name.as_deref() == Some(word));
        if let Some(leader) = follows.and_then(|row| follows_whom(d, row)) {
            return format!("`{word}` does not move by itself: it follows {leader}");
        }
        let named = |(v, name): &(Variable, Option<&str>)| match name {
            Some(name) => format!("{} ({name})", v.symbol.name()),
            None => v.symbol.name().to_string(),
        };
        format!("no joint `{word}`; there are {}", moving.iter().map(named).collect::<Vec<_>>().join(", "))
    })
}

/// The frame that a word names: by its number from 0, or by the name of its row.
///
/// # Errors
/// A sentence that says which there are.
pub fn frame(d: &Description, word: &str) -> Result<usize, String> {
    let last = d.rows.len();
    if let Some(n) = word.parse::<usize>().ok().filter(|n| *n <= last) {
        return Ok(n);
    }
    let named = |row: &Row| row.name.as_deref() == Some(word);
    let found: Vec<usize> = (0..last).filter(|&i| named(&d.rows[i])).collect();
    match found[..] {
        [i] => Ok(i + 1),
        [] => {
            let names: Vec<&str> = d.rows.iter().filter_map(|r| r.name.as_deref()).collect();
            let names = if names.is_empty() { String::new() } else { format!(", or {}", names.join(", ")) };
            Err(format!("no frame `{word}`: name a frame from 0 to {last}{names}"))
        }
        _ => Err(format!("several rows are called `{word}`: name the frame by its number, from 0 to {last}")),
    }
}

/// The variables, with the names of their rows, that move a row which has none of its own.
fn follows_whom(d: &Description, row: &Row) -> Option<String> {
    let symbols = [row.theta, row.d].into_iter().flat_map(Expr::symbols).collect::<Vec<_>>();
    let moving = d.rows.iter().filter_map(|r| Some((r.variable?.symbol, r.name.as_deref())));
    let named = moving.filter(|m| symbols.contains(&m.0)).map(|(symbol, name)| match name {
        Some(name) => format!("{} ({name})", symbol.name()),
        None => symbol.name().to_string(),
    });
    let all: Vec<String> = named.collect();
    (!all.is_empty()).then(|| all.join(" and "))
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
