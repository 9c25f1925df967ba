//! Links as their constructors say them, and what is set of them later.

use super::parse::{Argument, Form};
use super::run::Run;
use super::value::{Formula, Lost, Value, formula};
use crate::description::Convention;
use crate::description::diagnostic::Severity;
use std::collections::HashMap;
use std::ops::Range;

/// What a cell of a link is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Role {
    Theta,
    D,
    A,
    Alpha,
    Offset,
}

/// How a link moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Moves {
    Turns,
    Slides,
    Nothing,
}

/// A link.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub cells: HashMap<Role, Formula>,
    pub moves: Moves,
    pub convention: Convention,
    pub is_flipped: bool,
    pub limits: Option<[Formula; 2]>,
    pub span: Range<usize>,
    /// Something said of it is not followed.
    pub lost: Option<Lost>,
}

/// A robot that the program makes.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub name: Option<String>,
    pub links: Vec<usize>,
    pub span: Range<usize>,
    pub lost: Option<Lost>,
    /// Another robot is made of it.
    pub is_part: bool,
}

/// A joint of a `rigidBodyTree`.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub moves: Moves,
    pub row: Option<(Vec<Formula>, Convention)>,
    pub limits: Option<[Formula; 2]>,
    pub span: Range<usize>,
    pub lost: Option<Lost>,
}

/// The functions that make a robot of links.
pub(super) const ROBOTS: [&str; 2] = ["SerialLink", "DHRobot"];

/// Functions that make a link: how it moves and in which convention it is, if the name says so.
pub(super) const LINKS: [(&str, Option<Moves>, Option<Convention>); 8] = [
    ("Link", None, None),
    ("DHLink", None, None),
    ("Revolute", Some(Moves::Turns), None),
    ("Prismatic", Some(Moves::Slides), None),
    ("RevoluteDH", Some(Moves::Turns), Some(Convention::Standard)),
    ("PrismaticDH", Some(Moves::Slides), Some(Convention::Standard)),
    ("RevoluteMDH", Some(Moves::Turns), Some(Convention::Craig)),
    ("PrismaticMDH", Some(Moves::Slides), Some(Convention::Craig)),
];

/// The order of a row of Corke's toolboxes, and of MATLAB's own.
const CORKE: [Role; 4] = [Role::Theta, Role::D, Role::A, Role::Alpha];
pub(super) const TREE: [Role; 4] = [Role::A, Role::Alpha, Role::D, Role::Theta];

/// What of a link says nothing of where it is.
const BESIDE: [&str; 15] = [
    "m", "r", "I", "Jm", "B", "Tc", "G", "name", "mesh", "inertia", "mass", "com", "friction", "jtype",
    "geometry",
];

/// Words of MATLAB's constructors that stand alone.
const WORDS: [&str; 11] =
    ["standard", "modified", "std", "mod", "revolute", "prismatic", "fixed", "dh", "mdh", "sym", "flip"];

/// What a robot is given beside its links: where it stands and what it holds.
const NOT_READ: [&str; 3] = ["base", "tool", "gravity"];

/// What is said with a name, or without: its value and place.
type Said = (Option<String>, Value, Range<usize>);

fn role(name: &str) -> Option<Role> {
    Some(match name {
        "theta" => Role::Theta,
        "d" => Role::D,
        "a" => Role::A,
        "alpha" => Role::Alpha,
        "offset" => Role::Offset,
        _ => return None,
    })
}

impl Run<'_> {
    /// The arguments of a constructor; of MATLAB's, words in quotes name what follows them.
    fn said(&mut self, arguments: &[Argument]) -> Vec<Said> {
        let mut found: Vec<Said> = vec![];
        let mut key: Option<(String, Range<usize>)> = None;
        for argument in arguments {
            let span = argument.value.span.clone();
            if matches!(&argument.value.form, Form::Unary(s, _) if s.starts_with('*')) {
                let unknown = self.unknown(&span);
                found.push((None, unknown, span));
                continue;
            }
            let value = self.value(&argument.value);
            if let Some((key, _)) = key.take() {
                found.push((Some(key), value, span));
                continue;
            }
            match &value {
                _ if argument.key.is_some() => found.push((argument.key.clone(), value, span)),
                Value::Text(word) if !self.is_python() && !WORDS.contains(&&**word) => {
                    key = Some((word.to_string(), span));
                }
                _ => found.push((None, value, span)),
            }
        }
        if let Some((_, span)) = key {
            let unknown = self.unknown(&span);
            found.push((None, unknown, span));
        }
        found
    }

    /// The number that is said, with the place where it is.
    fn cell(&self, value: &Value, span: &Range<usize>) -> Result<Formula, Lost> {
        match value {
            Value::Unknown(lost) => Err(lost.clone()),
            Value::None => Ok(Formula::integer(0, span.clone())),
            other => match formula(other) {
                Some(f) => Ok(Formula { span: span.clone(), ..f }),
                None => Err(self.lost(span, "is no number that is followed")),
            },
        }
    }

    /// The two ends of a range.
    pub(super) fn ends(&self, value: &Value, span: &Range<usize>) -> Result<Option<[Formula; 2]>, Lost> {
        let items = match value {
            Value::None => return Ok(None),
            Value::Matrix(rows) if rows.iter().all(Vec::is_empty) => return Ok(None),
            other => self.store.items(other),
        };
        let items =
            items.map_err(|lost| lost.unwrap_or_else(|| self.lost(span, "is no range that is followed")))?;
        match items.as_slice() {
            [low, high] => Ok(Some([self.cell(low, span)?, self.cell(high, span)?])),
            _ => Err(self.lost(span, "is no range of two ends")),
        }
    }

    /// The link of a row of numbers: θ d a α, then 1 where it slides, then an offset.
    fn of_row(&mut self, row: &[Value], span: &Range<usize>, convention: Convention) -> Link {
        let mut link = Link {
            cells: HashMap::new(),
            moves: Moves::Turns,
            convention,
            is_flipped: false,
            limits: None,
            span: span.clone(),
            lost: None,
        };
        if !(4..=6).contains(&row.len()) {
            let message = format!("a row of {} values: theta d a alpha, sigma, offset", row.len());
            link.lost = Some(Lost { span: span.clone(), message: message.into() });
            return link;
        }
        let roles = CORKE.into_iter().map(Some).chain([None, Some(Role::Offset)]);
        for (role, value) in roles.zip(row) {
            let place = match value {
                Value::Number(f) if span.start <= f.span.start && f.span.end <= span.end => f.span.clone(),
                _ => span.clone(),
            };
            let cell = self.cell(value, &place);
            match (role, cell) {
                (Some(role), Ok(cell)) => drop(link.cells.insert(role, cell)),
                (None, Ok(cell)) => match cell.number {
                    Some(1.0) => link.moves = Moves::Slides,
                    Some(0.0) => {}
                    _ => link.lost = Some(self.lost(&place, "is neither 0 nor 1")),
                },
                (_, Err(lost)) => drop(link.lost.get_or_insert(lost)),
            }
        }
        link
    }

    /// The link that a constructor makes.
    pub fn link_made(&mut self, name: &str, arguments: &[Argument], span: &Range<usize>) -> Value {
        let (_, moves, convention) = LINKS.iter().find(|l| l.0 == name).copied().unwrap_or(LINKS[0]);
        let said = self.said(arguments);
        let has = |words: &[&str]| {
            said.iter().any(|(key, value, _)| {
                key.is_none() && matches!(value, Value::Text(t) if words.contains(&&**t))
            })
        };
        let truth = |key: &str| {
            let found = said.iter().find(|s| s.0.as_deref() == Some(key));
            found.map(|s| self.store.truth(&s.1).ok_or_else(|| self.lost(&s.2, "is not followed")))
        };
        let mut lost: Option<Lost> = None;
        let mut flag = |found: Option<Result<bool, Lost>>| match found {
            Some(Ok(b)) => Some(b),
            Some(Err(e)) => {
                lost.get_or_insert(e);
                None
            }
            None => None,
        };
        let modified = [flag(truth("mdh")), flag(truth("modified"))];
        let is_modified = has(&["modified", "mod"]) || modified.contains(&Some(true));
        let sigma = flag(truth("sigma"));
        let is_flipped = has(&["flip"]) || flag(truth("flip")) == Some(true);
        let convention =
            convention.or(is_modified.then_some(Convention::Craig)).unwrap_or(Convention::Standard);
        let moves = moves
            .or(has(&["prismatic"]).then_some(Moves::Slides))
            .or(has(&["revolute"]).then_some(Moves::Turns))
            .or(sigma.map(|slides| if slides { Moves::Slides } else { Moves::Turns }));
        let mut link = Link {
            cells: HashMap::new(),
            moves: Moves::Turns,
            convention,
            is_flipped,
            limits: None,
            span: span.clone(),
            lost,
        };
        let mut is_row = false;
        // Values without names, in the order of the constructors of Python.
        let mut order = match name {
            "DHLink" => vec![Role::D, Role::Alpha, Role::Theta, Role::A],
            "PrismaticDH" | "PrismaticMDH" | "Prismatic" => {
                vec![Role::Theta, Role::A, Role::Alpha, Role::Offset]
            }
            "RevoluteDH" | "RevoluteMDH" | "Revolute" => vec![Role::D, Role::A, Role::Alpha, Role::Offset],
            _ => vec![],
        }
        .into_iter();
        let is_python = self.is_python();
        for (key, value, place) in said {
            match key.as_deref() {
                Some("flip" | "sigma" | "mdh" | "modified") => {}
                Some(key) => self.say_of_link(&mut link, key, &value, &place),
                None => match &value {
                    Value::Unknown(lost) => drop(link.lost.get_or_insert(lost.clone())),
                    Value::Matrix(_) | Value::List(_) if name == "Link" => {
                        let row = self.store.items(&value).unwrap_or_default();
                        let row = self.of_row(&row, &place, convention);
                        is_row = true;
                        link.cells = row.cells;
                        link.moves = moves.unwrap_or(row.moves);
                        link.lost = link.lost.or(row.lost);
                    }
                    Value::Text(words) if !is_python || WORDS.contains(&&**words) => {}
                    _ => match order.next() {
                        Some(role) => match self.cell(&value, &place) {
                            Ok(cell) => drop(link.cells.insert(role, cell)),
                            Err(lost) => drop(link.lost.get_or_insert(lost)),
                        },
                        None => {
                            let message = "what does this value say?";
                            self.find(Severity::Error, &place, message);
                        }
                    },
                },
            }
        }
        if !is_row {
            // A link that says θ and no d slides.
            let slides = link.cells.contains_key(&Role::Theta) && !link.cells.contains_key(&Role::D);
            link.moves = moves.unwrap_or(if slides { Moves::Slides } else { Moves::Turns });
        }
        self.store.links.push(link);
        Value::Link(self.store.links.len() - 1)
    }

    /// What a name says of a link.
    fn say_of_link(&mut self, link: &mut Link, key: &str, value: &Value, place: &Range<usize>) {
        if let Some(role) = role(key) {
            match self.cell(value, place) {
                Ok(cell) => drop(link.cells.insert(role, cell)),
                Err(lost) => drop(link.lost.get_or_insert(lost)),
            }
        } else if key == "qlim" {
            match self.ends(value, place) {
                Ok(ends) => link.limits = ends,
                Err(lost) => {
                    let message = format!("{}: the limits are not read", lost.message);
                    self.find(Severity::Warning, &lost.span, &message);
                }
            }
        } else if BESIDE.contains(&key) {
            let message = "masses and drives of a program are not read";
            if !["name", "mesh", "geometry"].contains(&key)
                && !self.findings.iter().any(|d| d.message == message)
            {
                self.find(Severity::Note, place, message);
            }
        } else {
            self.find(Severity::Warning, place, &format!("`{key}` is unknown here: it is left"));
        }
    }

    /// What is known of a link.
    pub fn of_link(&self, k: usize, name: &str, span: &Range<usize>) -> Value {
        let link = &self.store.links[k];
        match (&link.lost, role(name)) {
            (Some(lost), _) => Value::Unknown(lost.clone()),
            (None, Some(role)) => {
                let cell =
                    link.cells.get(&role).cloned().unwrap_or_else(|| Formula::integer(0, span.clone()));
                Value::Number(Formula { span: span.clone(), ..cell })
            }
            _ => self.unknown(span),
        }
    }

    /// `L(2).offset = value`
    pub fn set_of_link(&mut self, k: usize, name: &str, value: Value, span: &Range<usize>) {
        self.change(&Value::Link(k));
        if let Some(lost) = self.lost.clone() {
            // Behind what is not followed it is not known whether the program gets here.
            return self.store.lose(&Value::Link(k), &lost);
        }
        let mut link = self.store.links[k].clone();
        match name {
            "flip" | "mdh" | "sigma" => match self.store.truth(&value) {
                Some(b) if name == "flip" => link.is_flipped = b,
                Some(b) if name == "mdh" => {
                    link.convention = if b { Convention::Craig } else { Convention::Standard };
                }
                Some(b) => link.moves = if b { Moves::Slides } else { Moves::Turns },
                None => drop(link.lost.get_or_insert(self.lost(span, "is not followed"))),
            },
            _ if role(name).is_some() || name == "qlim" || BESIDE.contains(&name) => {
                self.say_of_link(&mut link, name, &value, span);
            }
            _ => drop(link.lost.get_or_insert(self.lost(span, "is not followed"))),
        }
        self.store.links[k] = link;
    }

    /// `robot.base = value`
    pub fn set_of_robot(&mut self, k: usize, name: &str, value: Value, span: &Range<usize>) {
        match name {
            _ if NOT_READ.contains(&name) => self.not_read(name, &value, span),
            "name" => {
                if let Value::Text(text) = value {
                    self.store.robots[k].name = Some(text.to_string());
                }
            }
            "qlim" => self.find(Severity::Warning, span, "limits of the robot set afterwards are not read"),
            "links" | "offset" | "mdh" => {
                self.change(&Value::Robot(k));
                let lost = self.lost(span, "is not followed");
                self.store.lose(&Value::Robot(k), &lost);
            }
            _ => {}
        }
    }

    pub fn not_read(&mut self, name: &str, value: &Value, span: &Range<usize>) {
        if *value != Value::None {
            self.find(Severity::Warning, span, &format!("`{name}` is not read"));
        }
    }

    /// The robot that a constructor makes, or that of a class in its own.
    pub fn robot_made(&mut self, arguments: &[Argument], span: &Range<usize>, of_class: bool) -> Value {
        let mut said = self.said(arguments);
        if of_class && said.first().is_some_and(|s| matches!(&s.1, Value::Number(f) if &*f.text == "self")) {
            said.remove(0);
        }
        let is_links = |s: &Said| s.0.is_none() || matches!(s.0.as_deref(), Some("links"));
        let first = said.iter().position(is_links);
        let Some(first) = first.map(|k| said.remove(k)) else { return Value::None };
        if of_class && !self.holds_links(&first.1) {
            // Of another class.
            return Value::None;
        }
        let is_modified = said
            .iter()
            .any(|s| s.0.is_none() && matches!(&s.1, Value::Text(t) if ["modified", "mdh"].contains(&&**t)));
        let convention = if is_modified { Convention::Craig } else { Convention::Standard };
        let robot = self.robot_in(&first.1, &first.2, convention, span);
        let Value::Robot(k) = robot else { return robot };
        for (key, value, place) in said {
            match key.as_deref() {
                Some("name") => {
                    if let Value::Text(text) = &value {
                        self.store.robots[k].name = Some(text.to_string());
                    }
                }
                Some(key) if NOT_READ.contains(&key) => self.not_read(key, &value, &place),
                Some("offset" | "qlim") => {
                    let lost = self.lost(&place, "is not followed");
                    self.store.lose(&Value::Robot(k), &lost);
                }
                _ => {}
            }
        }
        if of_class {
            self.assign("self", Value::Robot(k));
        }
        Value::Robot(k)
    }

    /// True for what may be a list of links.
    fn holds_links(&self, value: &Value) -> bool {
        match value {
            Value::Link(_) | Value::Robot(_) | Value::Unknown(_) => true,
            Value::List(k) => {
                let list = &self.store.lists[*k];
                list.lost.is_some() || list.items.iter().any(|v| self.is_link(v))
            }
            Value::Matrix(rows) => rows.iter().flatten().any(|v| self.is_link(v)),
            _ => false,
        }
    }

    fn is_link(&self, value: &Value) -> bool {
        matches!(value, Value::Link(_) | Value::Robot(_) | Value::Unknown(_))
    }

    /// The robot of a value.
    pub fn robot_of(&mut self, value: &Value, span: &Range<usize>) -> Value {
        self.robot_in(value, span, Convention::Standard, span)
    }

    fn robot_in(
        &mut self,
        value: &Value,
        place: &Range<usize>,
        convention: Convention,
        span: &Range<usize>,
    ) -> Value {
        let found = self.links_of(value, place, convention, 0);
        let (links, lost) = match found {
            Ok(links) => (links, None),
            Err(lost) => (vec![], Some(lost)),
        };
        let lost = self.lost.clone().or(lost);
        self.store.robots.push(Made { name: None, links, span: span.clone(), lost, is_part: false });
        Value::Robot(self.store.robots.len() - 1)
    }

    /// The links that a value holds.
    pub fn links_of(
        &mut self,
        value: &Value,
        place: &Range<usize>,
        convention: Convention,
        depth: usize,
    ) -> Result<Vec<usize>, Lost> {
        let not_followed = |run: &Self| run.lost(place, "is no list of links that is followed");
        let is_number = |v: &Value| formula(v).is_some();
        match value {
            Value::Unknown(lost) => Err(lost.clone()),
            Value::Link(k) => Ok(vec![*k]),
            Value::Robot(k) => match &self.store.robots[*k].lost {
                Some(lost) => Err(lost.clone()),
                None => {
                    self.store.robots[*k].is_part = true;
                    Ok(self.store.robots[*k].links.clone())
                }
            },
            Value::Matrix(rows)
                if rows.iter().flatten().all(is_number) && rows.iter().any(|r| !r.is_empty()) =>
            {
                let rows = std::rc::Rc::clone(rows);
                Ok(rows.iter().map(|row| self.pushed_row(row, place, convention)).collect())
            }
            Value::Matrix(_) | Value::List(_) if depth < 3 => {
                let items =
                    self.store.items(value).map_err(|lost| lost.unwrap_or_else(|| not_followed(self)))?;
                if !items.is_empty() && items.iter().all(is_number) {
                    return Ok(vec![self.pushed_row(&items, place, convention)]);
                }
                let mut found = vec![];
                for item in items {
                    found.extend(self.links_of(&item, place, convention, depth + 1)?);
                    if self.step(found.len() / 8 + 1, place) {
                        return Err(not_followed(self));
                    }
                }
                Ok(found)
            }
            _ => Err(not_followed(self)),
        }
    }

    fn pushed_row(&mut self, row: &[Value], place: &Range<usize>, convention: Convention) -> usize {
        let inside: Vec<&Range<usize>> =
            row.iter().filter_map(|v| if let Value::Number(f) = v { Some(&f.span) } else { None }).collect();
        let start = inside.iter().map(|s| s.start).min();
        let end = inside.iter().map(|s| s.end).max();
        let span = start.zip(end).map_or(place.clone(), |(start, end)| start..end);
        let link = self.of_row(row, &span, convention);
        self.store.links.push(link);
        self.store.links.len() - 1
    }
}
