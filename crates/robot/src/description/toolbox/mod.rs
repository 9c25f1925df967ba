//! Robots as programs make them with the toolboxes for MATLAB and Python: `Link`, `Revolute`, `PrismaticMDH`, … in a `SerialLink` or
//! `DHRobot` (Corke's Robotics Toolbox), or rows of a `rigidBodyTree` (MATLAB's).
//!
//! A program is followed as far as its robots need it: assignments, loops over known values, conditions that are known, its own
//! functions. What is not followed is an error where a robot needs it, never a guess. Lengths and angles are formulas of numbers and of
//! names that the program gives no value. What a toolbox takes for granted holds: angles in radians, the standard convention unless
//! `modified` or a name with MDH says otherwise; the value of the joint's own parameter is that of its variable and does not count.

mod bodies;
mod code;
mod functions;
mod links;
mod names;
mod parse;
mod places;
mod ranges;
mod run;
mod signs;
mod statements;
mod value;

pub use code::Language;

use super::cell::{Place, Style, read_cell, variable_number};
use super::diagnostic::{Diagnostic, Diagnostics, Severity};
use super::robot_file::{MAX_BYTES, MAX_ROWS};
use super::units::Quantity;
use super::{Convention, Description, JointKind, Parameter, Row, Variable};
use crate::geometry::Transform;
use denavit_symbolic::{Expr, Symbol};
use links::{LINKS, Link, Made, Moves, Role};
use parse::{Act, Statement};
use run::Run;
use value::{Formula, Lost, Value};

/// What to do about what is not followed.
const HINT: &str = "write the links out one by one with their values, or give a table";

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
    let statements = parse::program(text, language);
    let (robots, links, findings) = robots(text, language, &statements);
    for finding in findings {
        out.add(finding);
    }
    let description = chosen(&robots, which, &mut out).and_then(|robot| described(robot, &links, &mut out));
    out.finish(description)
}

/// The language of a text in which two links at least are made.
pub(super) fn makes_robot(text: &str) -> Option<Language> {
    if text.len() > MAX_BYTES {
        return None;
    }
    let is_python = ["import ", "np.", "DHRobot", "rtb."].iter().any(|word| text.contains(word));
    let language = if is_python { Language::Python } else { Language::Matlab };
    let words = code::tokens(text, language);
    let is_link = |pair: &[code::Token]| {
        pair[0].kind == code::Kind::Name
            && LINKS.iter().any(|l| l.0 == &text[pair[0].span.clone()])
            && text[pair[1].span.clone()] == *"("
    };
    (words.windows(2).filter(|pair| is_link(pair)).count() > 1).then_some(language)
}

/// All robots that a program makes, with the links that they name and what was found.
///
/// A program that makes none by itself may say how: its classes and functions are called then, those first that need no values; then
/// it is run as the main program. Without any, its links are a robot.
fn robots(
    text: &str,
    language: Language,
    statements: &[Statement],
) -> (Vec<Made>, Vec<Link>, Vec<Diagnostic>) {
    let mut last = None;
    for (is_main, calls) in
        [(false, Calls::None), (false, Calls::Ready), (true, Calls::None), (true, Calls::All)]
    {
        let mut run = Run::new(text, language, is_main);
        run.define(statements);
        run.block(statements);
        run.call_definitions(statements, calls);
        let tree = run.tree();
        run.store.robots.extend(tree);
        if !run.store.robots.is_empty() {
            run.store.robots.retain(|r| !r.is_part);
            // What is not followed behind a robot may change it.
            if let Some(lost) = &run.lost
                && run.store.robots.iter().any(|r| r.lost.is_none())
            {
                let (span, words) = (lost.span.clone(), lost.message.to_string());
                run.find(Severity::Warning, &span, &words);
            }
            return (run.store.robots, run.store.links, run.findings);
        }
        last = Some(run);
    }
    let Some(mut run) = last else { return (vec![], vec![], vec![]) };
    let loose = run.loose();
    (loose.into_iter().collect(), run.store.links, run.findings)
}

/// Which functions of a program are called although it does not.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Calls {
    None,
    /// Those that need no values and that nothing else calls.
    Ready,
    All,
}

impl<'p> Run<'p> {
    fn call_definitions(&mut self, statements: &'p [Statement], calls: Calls) {
        if calls == Calls::None {
            return;
        }
        self.is_asked = false;
        let used = self.names_called();
        for statement in statements {
            match &statement.act {
                Act::Class(_, body) => drop(self.instance(body, vec![], &statement.span)),
                Act::Function(function) => {
                    let needs = self.is_python() && function.parameters.iter().any(|p| p.1.is_none());
                    let is_ready = !needs && used.get(function.name.as_str()).is_none_or(|n| *n < 2);
                    if is_ready || calls == Calls::All {
                        self.call_own(function, vec![], &statement.span);
                    }
                }
                _ => {}
            }
        }
    }

    /// How often each name stands before a bracket.
    fn names_called(&self) -> std::collections::HashMap<&'p str, usize> {
        let text = self.text;
        let words = code::tokens(text, self.language);
        let mut found = std::collections::HashMap::new();
        for pair in words.windows(2) {
            if pair[0].kind == code::Kind::Name && text[pair[1].span.clone()] == *"(" {
                *found.entry(&text[pair[0].span.clone()]).or_insert(0) += 1;
            }
        }
        found
    }

    /// The robot of links that are in no robot: those of the one list of them, or all in their order.
    fn loose(&mut self) -> Option<Made> {
        let first = self.store.links.first()?.span.clone();
        let mut lists: Vec<(String, Value)> = self
            .values()
            .filter(|(_, v)| match v {
                Value::Matrix(rows) => rows.iter().flatten().any(|v| matches!(v, Value::Link(_))),
                Value::List(k) => self.store.lists[*k].items.iter().any(|v| matches!(v, Value::Link(_))),
                _ => false,
            })
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        let several = Lost { span: first.clone(), message: "which links make the robot is not said".into() };
        let made = |links: Result<Vec<usize>, Lost>| {
            let (links, lost) = match links {
                Ok(links) => (links, None),
                Err(lost) => (vec![], Some(lost)),
            };
            Some(Made { name: None, links, span: first.clone(), lost, is_part: false })
        };
        if let Some(lost) = self.lost.clone() {
            return made(Err(lost));
        }
        if let Some((_, list)) = lists.pop() {
            if !lists.is_empty() {
                return made(Err(several));
            }
            let links = self.links_of(&list, &first, Convention::Standard, 0);
            return made(links);
        }
        // Each link has a place of its own, and names that count do so in order.
        let mut spans: Vec<usize> = self.store.links.iter().map(|l| l.span.start).collect();
        let is_sorted = spans.is_sorted();
        spans.dedup();
        let mut numbers: Vec<(usize, u32)> = self
            .values()
            .filter_map(|(name, value)| match value {
                Value::Link(k) => {
                    Some((*k, name.trim_start_matches(|c: char| !c.is_ascii_digit()).parse().ok()?))
                }
                _ => None,
            })
            .collect();
        numbers.sort_unstable();
        match self.links_lost.clone() {
            Some(lost) => made(Err(lost)),
            None if is_sorted
                && spans.len() == self.store.links.len()
                && numbers.is_sorted_by_key(|n| n.1) =>
            {
                made(Ok((0..self.store.links.len()).collect()))
            }
            None => made(Err(several)),
        }
    }
}

/// The robot that is asked for.
fn chosen<'r>(robots: &'r [Made], which: Option<usize>, out: &mut Diagnostics) -> Option<&'r Made> {
    match (robots, which) {
        ([], _) => {
            out.error(0..0, "no robot is made in this program").hint(
                "`Link`, `Revolute`, `PrismaticMDH`, … in a `SerialLink` or `DHRobot`, or `dhparams` of a `rigidBodyTree` are read",
            );
            None
        }
        ([one], None) => Some(one),
        (several, None) => {
            let message = format!("the program makes {} robots", several.len());
            out.error(several[1].span.clone(), message).hint("choose one with --table, from 1");
            None
        }
        (several, Some(k)) => {
            let found = k.checked_sub(1).and_then(|k| several.get(k));
            if found.is_none() {
                out.error(0..0, format!("there is no robot {k}"));
            }
            found
        }
    }
}

fn described(robot: &Made, all: &[Link], out: &mut Diagnostics) -> Option<Description> {
    let span = robot.span.clone();
    let mut fail = |lost: &Lost| {
        out.error(lost.span.clone(), lost.message.to_string()).hint(HINT);
    };
    if let Some(lost) = &robot.lost {
        fail(lost);
        return None;
    }
    let links: Vec<&Link> = robot.links.iter().filter_map(|k| all.get(*k)).collect();
    if links.len() > MAX_ROWS {
        out.error(span, format!("more than {MAX_ROWS} rows"));
        return None;
    }
    let faults: Vec<&Lost> = links.iter().filter_map(|l| l.lost.as_ref()).collect();
    if !faults.is_empty() {
        faults.into_iter().for_each(fail);
        return None;
    }
    let Some(first) = links.first() else {
        out.error(span, "a robot without links").hint(HINT);
        return None;
    };
    let convention = first.convention;
    if let Some(other) = links.iter().find(|l| l.convention != convention) {
        out.error(other.span.clone(), "standard and modified links in one robot")
            .hint("write all in one convention");
        return None;
    }
    let mut rows = vec![];
    for link in links {
        let number = rows.iter().filter(|r: &&Row| r.variable.is_some()).count() + 1;
        rows.push(row(link, number, out)?);
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
    out.note(span, said);
    Some(Description {
        name: robot.name.clone().unwrap_or_else(|| "robot".into()),
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

fn row(link: &Link, number: usize, out: &mut Diagnostics) -> Option<Row> {
    let mut cell = |role: Role, quantity: Quantity| -> Option<Expr> {
        match link.cells.get(&role) {
            Some(formula) => read_formula(formula, quantity, out),
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
        let ends = [low, high].map(|end| read_formula(end, quantity, out));
        match ends {
            [Some(low), Some(high)] if [low, high].iter().all(|e| e.symbols().is_empty()) => {
                row.limits = Some([low, high]);
            }
            [Some(_), Some(_)] => {
                out.warning(low.span.clone(), "limits with names in them are not read");
            }
            _ => return None,
        }
    }
    Some(row)
}

/// A length or an angle.
fn read_formula(formula: &Formula, quantity: Quantity, out: &mut Diagnostics) -> Option<Expr> {
    let place = Place { span: formula.span.clone(), start: None };
    let value = read_cell(&formula.text, &place, &Style::plain(quantity), out)?;
    if let Some((name, at)) = value.symbols.iter().find(|s| variable_number(&s.0).is_some()) {
        out.error(at.clone(), format!("the joint variable `{name}` beside the joint's own"));
        return None;
    }
    Some(value.expr)
}
