//! Robots as programs make them with the toolboxes for MATLAB and Python: `Link`, `Revolute`, `PrismaticMDH`, … in a `SerialLink` or
//! `DHRobot` (Corke's Robotics Toolbox), or `dhparams` of a `rigidBodyTree` (MATLAB's).
//!
//! Nothing is run: lengths and angles are formulas of numbers and of names that the program says. What a toolbox takes for granted
//! holds: angles in radians, the standard convention unless `modified` or a name with MDH says otherwise; the value of the joint's own
//! parameter is that of its variable and does not count.

mod code;
mod links;

pub use code::Language;

use super::cell::{MAX_LENGTH, Place, Style, read_cell, variable_number};
use super::diagnostic::{Diagnostic, Diagnostics};
use super::robot_file::{MAX_BYTES, MAX_ROWS};
use super::units::Quantity;
use super::{Convention, Description, JointKind, Parameter, Row, Variable};
use crate::geometry::Transform;
use code::{Definition, calls, definitions, statements, without_comments};
use denavit_symbolic::{Expr, Symbol};
use links::{LINKS, Link, Moves, Role};
use std::collections::HashMap;
use std::ops::Range;

/// The functions that make a robot of links.
const ROBOTS: [&str; 2] = ["SerialLink", "DHRobot"];
/// How deep names may stand for names.
const MAX_DEPTH: usize = 10;

/// Reads the robot that a program makes; of several, `which` counts from 1.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_program(
    text: &str,
    language: Language,
    which: Option<usize>,
) -> Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut out = Diagnostics::default();
    if text.len() > MAX_BYTES {
        out.error(0..0, format!("the text has {} bytes; {MAX_BYTES} are allowed", text.len()));
        return out.finish(None);
    }
    let plain = without_comments(text, language);
    let statements = statements(&plain);
    let definitions = definitions(&plain, &statements);
    let mut program = Program { text: &plain, statements, definitions, out: &mut out };
    let description = program.robot(which);
    out.finish(description)
}

/// The language of a text in which two links at least are made.
pub(super) fn makes_robot(text: &str) -> Option<Language> {
    let is_python = ["import ", "np.", "DHRobot", "rtb."].iter().any(|word| text.contains(word));
    let language = if is_python { Language::Python } else { Language::Matlab };
    let plain = without_comments(text, language);
    let links = calls(&plain, &statements(&plain), &LINKS.map(|l| l.0));
    (links.len() > 1).then_some(language)
}

/// A program being read.
struct Program<'p> {
    /// Without its comments.
    text: &'p str,
    statements: Vec<Range<usize>>,
    definitions: Vec<Definition>,
    out: &'p mut Diagnostics,
}

/// What the rows of a robot are made of.
struct Robot {
    name: Option<String>,
    links: Vec<Link>,
    span: Range<usize>,
}

impl Program<'_> {
    fn robot(&mut self, which: Option<usize>) -> Option<Description> {
        let robots = self.robots();
        let chosen = match (robots.len(), which) {
            (0, _) => {
                self.out.error(0..0, "no robot is made in this program").hint(
                    "`Link`, `Revolute`, `PrismaticMDH`, … in a `SerialLink` or `DHRobot`, or `dhparams` of a `rigidBodyTree` are read",
                );
                return None;
            }
            (1, None) => robots.into_iter().next()?,
            (count, None) => {
                let message = format!("the program makes {count} robots");
                self.out.error(robots[1].span.clone(), message).hint("choose one with --table, from 1");
                return None;
            }
            (_, Some(k)) => match k.checked_sub(1).and_then(|k| robots.into_iter().nth(k)) {
                Some(robot) => robot,
                None => {
                    self.out.error(0..0, format!("there is no robot {k}"));
                    return None;
                }
            },
        };
        self.description(chosen)
    }

    /// All robots that are made.
    fn robots(&mut self) -> Vec<Robot> {
        let made = calls(self.text, &self.statements, &ROBOTS);
        let links = calls(self.text, &self.statements, &LINKS.map(|l| l.0));
        let mut found: Vec<Robot> = vec![];
        for call in &made {
            let name = call.arguments.iter().find(|a| a.key.as_deref() == Some("name"));
            let name = name.and_then(|a| code::quoted(&self.text[a.value.clone()])).map(str::to_string);
            for left in call
                .arguments
                .iter()
                .filter(|a| matches!(a.key.as_deref(), Some("base" | "tool" | "gravity")))
            {
                let key = left.key.as_deref().unwrap_or_default();
                self.out.warning(left.value.clone(), format!("`{key}` is not read"));
            }
            let Some(first) = call.arguments.first().filter(|a| a.key.is_none()) else { continue };
            let links = self.links_of(&first.value, &links);
            if !links.is_empty() {
                found.push(Robot { name, links, span: call.span.clone() });
            }
        }
        if let Some(robot) = self.rigid_body_tree() {
            found.push(robot);
        }
        if found.is_empty() && !links.is_empty() {
            let span = links[0].span.clone();
            found.push(Robot {
                name: None,
                links: links.iter().filter_map(|c| self.link(c)).collect(),
                span,
            });
        }
        found
    }

    /// What the name of a table or a list is said to be, if it is one.
    fn defined(&self, name: &str, before: usize) -> Option<Range<usize>> {
        let found = self.definitions.iter().rfind(|d| d.name == name && d.value.start < before);
        found.map(|d| d.value.clone())
    }

    fn description(&mut self, robot: Robot) -> Option<Description> {
        let Robot { name, links, span } = robot;
        if links.len() > MAX_ROWS {
            self.out.error(span, format!("more than {MAX_ROWS} rows"));
            return None;
        }
        let convention = links.first()?.convention;
        if let Some(other) = links.iter().find(|l| l.convention != convention) {
            self.out
                .error(other.span.clone(), "standard and modified links in one robot")
                .hint("write all in one convention");
            return None;
        }
        let mut rows = vec![];
        for link in &links {
            let number = rows.iter().filter(|r: &&Row| r.variable.is_some()).count() + 1;
            rows.push(self.row(link, number)?);
        }
        let mut parameters: Vec<Parameter> = vec![];
        let symbols = rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha]).flat_map(Expr::symbols);
        for symbol in symbols.filter(|s| variable_number(&s.name()).is_none()) {
            if !parameters.iter().any(|p| p.symbol == symbol) {
                parameters.push(Parameter { symbol, value: None });
            }
        }
        let said = match convention {
            Convention::Craig => "modified links: craig",
            _ => "links as a toolbox takes them unless told otherwise: standard",
        };
        self.out.note(span, said);
        Some(Description {
            name: name.unwrap_or_else(|| "robot".into()),
            source: None,
            convention,
            parameters,
            rows,
            base: Transform::identity(),
            tool: Transform::identity(),
            poses: vec![],
            gravity: None,
        })
    }

    fn row(&mut self, link: &Link, number: usize) -> Option<Row> {
        let mut cell = |role: Role, quantity: Quantity| -> Option<Expr> {
            match link.cells.get(&role) {
                Some(span) => self.formula(span, quantity),
                None => Some(Expr::int(0)),
            }
        };
        let (a, alpha) = (cell(Role::A, Quantity::Length)?, cell(Role::Alpha, Quantity::Angle)?);
        let kind = match link.moves {
            Moves::Turns => Some(JointKind::Revolute),
            Moves::Slides => Some(JointKind::Prismatic),
            Moves::Nothing => None,
        };
        let own = |quantity: JointKind| kind == Some(quantity);
        // The joint's own parameter is its variable.
        let theta = if own(JointKind::Revolute) { Expr::int(0) } else { cell(Role::Theta, Quantity::Angle)? };
        let d = if own(JointKind::Prismatic) { Expr::int(0) } else { cell(Role::D, Quantity::Length)? };
        let mut row = Row { theta, d, a, alpha, ..Row::still() };
        let Some(kind) = kind else { return Some(row) };
        let quantity = if kind == JointKind::Revolute { Quantity::Angle } else { Quantity::Length };
        let offset = cell(Role::Offset, quantity)?;
        let symbol = Symbol::new(&format!("q{number}"));
        let q = Expr::symbol(&symbol.name());
        let moved = if link.is_flipped { offset - q } else { q + offset };
        match kind {
            JointKind::Revolute => row.theta = moved,
            JointKind::Prismatic => row.d = moved,
        }
        row.variable = Some(Variable { symbol, kind });
        if let Some([low, high]) = &link.limits {
            let ends = [self.formula(low, quantity), self.formula(high, quantity)];
            if let [Some(low), Some(high)] = ends
                && [low, high].iter().all(|e| e.symbols().is_empty())
            {
                row.limits = Some([low, high]);
            }
        }
        Some(row)
    }

    /// A length or an angle, with what the program says for the names in it.
    fn formula(&mut self, span: &Range<usize>, quantity: Quantity) -> Option<Expr> {
        let text = self.spelled(&self.text[span.clone()], span.start, 0);
        let place = Place { span: span.clone(), start: None };
        let value = read_cell(&text, &place, &Style::plain(quantity), self.out)?;
        if let Some((name, at)) = value.symbols.iter().find(|s| variable_number(&s.0).is_some()) {
            self.out.error(at.clone(), format!("the joint variable `{name}` beside the joint's own"));
            return None;
        }
        Some(value.expr)
    }

    /// A formula as cells have it, names replaced by what they are said to be.
    fn spelled(&self, text: &str, before: usize, depth: usize) -> String {
        let mut spelled = String::new();
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            if spelled.len() > MAX_LENGTH {
                return spelled;
            }
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            if !(first.is_alphabetic() || first == '_') {
                let number =
                    rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').len();
                // The exponent of `1e-3` is no name.
                let exponent =
                    rest[number..].strip_prefix(['e', 'E']).filter(|_| number > 0).map_or(0, |r| {
                        let sign = usize::from(r.starts_with(['+', '-']));
                        let digits = r[sign..].bytes().take_while(u8::is_ascii_digit).count();
                        if digits > 0 { 1 + sign + digits } else { 0 }
                    });
                let length = if number > 0 { number + exponent } else { first.len_utf8() };
                let (part, behind) = rest.split_at(length);
                let (part, behind) = match (part, behind.as_bytes().first()) {
                    ("*", Some(b'*')) => ("^", &behind[1..]),
                    (".", Some(b'*' | b'/' | b'^')) => ("", behind),
                    _ => (part, behind),
                };
                spelled.push_str(part);
                rest = behind;
                continue;
            }
            let length = rest.find(|c: char| !is_word(c)).unwrap_or(rest.len());
            let (word, behind) = rest.split_at(length);
            rest = behind;
            let is_module =
                matches!(word, "np" | "numpy" | "math" | "sp" | "sympy" | "m") && behind.starts_with('.');
            if is_module {
                rest = &behind[1..];
            } else if let Some(inside) = self.in_radians(word, behind) {
                let inner = self.spelled(&behind[1..inside], before, depth);
                spelled += &format!("(({inner})*pi/180)");
                rest = &behind[inside + 1..];
            } else {
                let known = self.defined(word, before).filter(|_| depth < MAX_DEPTH && word != "pi");
                let value =
                    known.map(|v| (v.start, &self.text[v])).filter(|v| !v.1.contains(['[', '"', '\'', '{']));
                match value {
                    // What a name is said to be by `symbols` is itself.
                    Some((start, value)) if !value.contains("sym") => {
                        spelled += &format!("({})", self.spelled(value, start, depth + 1));
                    }
                    _ => spelled.push_str(word),
                }
            }
        }
        spelled
    }

    /// Where the bracket behind a function of degrees closes.
    fn in_radians(&self, word: &str, behind: &str) -> Option<usize> {
        if !matches!(word, "deg2rad" | "radians") || !behind.starts_with('(') {
            return None;
        }
        let mut depth = 0_usize;
        behind.char_indices().find_map(|(i, c)| {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                _ => {}
            }
            (depth == 0).then_some(i)
        })
    }
}

/// The cells of a link by what they are.
type Cells = HashMap<Role, Range<usize>>;
