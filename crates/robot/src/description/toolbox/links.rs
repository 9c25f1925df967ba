//! Links as their constructors say them.

use super::code::{Argument, Call, calls, matrix, quoted};
use super::{Cells, Program, Robot};
use crate::description::{Convention, MAX_ROWS};
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
    pub cells: Cells,
    pub moves: Moves,
    pub convention: Convention,
    pub is_flipped: bool,
    pub limits: Option<[Range<usize>; 2]>,
    pub span: Range<usize>,
}

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
const TREE: [Role; 4] = [Role::A, Role::Alpha, Role::D, Role::Theta];

/// What of a link says nothing of where it is.
const BESIDE: [&str; 14] =
    ["m", "r", "I", "Jm", "B", "Tc", "G", "name", "mesh", "inertia", "mass", "com", "friction", "jtype"];

impl Program<'_> {
    /// The links that the first argument of a robot is: a list of constructors or names, one name, or a table of numbers.
    pub(super) fn links_of(&mut self, value: &Range<usize>, all: &[Call]) -> Vec<Link> {
        let inside: Vec<&Call> =
            all.iter().filter(|c| value.start <= c.span.start && c.span.end <= value.end).collect();
        if !inside.is_empty() {
            return inside.into_iter().filter_map(|c| self.link(c)).collect();
        }
        let text = self.text[value.clone()].trim();
        let is_name = |t: &str| !t.is_empty() && t.chars().all(|c| c.is_alphanumeric() || c == '_');
        if is_name(text) {
            // Constructors in a list of this name, or of its entries.
            let begins = |target: &str| {
                target == text
                    || target.strip_prefix(text).is_some_and(|rest| rest.starts_with(['(', '[', '{', '.']))
            };
            let own: Vec<&Call> =
                all.iter().filter(|c| begins(&c.target) && c.span.start < value.start).collect();
            if !own.is_empty() {
                return own.into_iter().filter_map(|c| self.link(c)).collect();
            }
            return match self.defined(text, value.start) {
                Some(value) if !is_name(self.text[value.clone()].trim()) => self.links_of(&value, all),
                _ => vec![],
            };
        }
        let Some(rows) = matrix(self.text, value.clone()) else { return vec![] };
        if rows.len() > MAX_ROWS {
            self.out.error(value.clone(), format!("more than {MAX_ROWS} rows"));
            return vec![];
        }
        let names: Vec<&str> = rows.iter().flatten().map(|e| self.text[e.clone()].trim()).collect();
        let of_name = |name: &str| {
            let plain: String = name.split_whitespace().collect();
            all.iter().rfind(|c| c.target == plain && c.span.start < value.start)
        };
        let named: Option<Vec<&Call>> = names.iter().map(|n| of_name(n)).collect();
        match named.filter(|n| !n.is_empty()) {
            Some(named) => named.into_iter().filter_map(|c| self.link(c)).collect(),
            None => rows.iter().filter_map(|row| self.of_row(row, None, None)).collect(),
        }
    }

    /// The link of a row of numbers: θ d a α, then 1 where it slides, then an offset.
    fn of_row(
        &mut self,
        row: &[Range<usize>],
        moves: Option<Moves>,
        convention: Option<Convention>,
    ) -> Option<Link> {
        let span = row.first()?.start..row.last()?.end;
        if !(4..=6).contains(&row.len()) {
            let message = format!("a row of {} values: theta d a alpha, sigma, offset", row.len());
            self.out.error(span, message);
            return None;
        }
        let mut cells: Cells = CORKE.into_iter().zip(row.iter().cloned()).collect();
        let slides = row.get(4).is_some_and(|v| self.text[v.clone()].trim().trim_end_matches(".0") == "1");
        cells.extend(row.get(5).map(|v| (Role::Offset, v.clone())));
        let moves = moves.unwrap_or(if slides { Moves::Slides } else { Moves::Turns });
        let convention = convention.unwrap_or(Convention::Standard);
        Some(Link { cells, moves, convention, is_flipped: false, limits: None, span })
    }

    /// The link that a constructor makes.
    pub(super) fn link(&mut self, call: &Call) -> Option<Link> {
        let (_, moves, convention) = *LINKS.iter().find(|l| l.0 == call.name)?;
        let word = |a: &Argument| quoted(&self.text[a.value.clone()]).filter(|_| a.key.is_none());
        let has =
            |wanted: &[&str]| call.arguments.iter().any(|a| word(a).is_some_and(|w| wanted.contains(&w)));
        let is = |key: &str, value: &str| {
            call.arguments
                .iter()
                .any(|a| a.key.as_deref() == Some(key) && self.text[a.value.clone()].trim() == value)
        };
        let is_modified =
            has(&["modified", "mod"]) || is("mdh", "1") || is("mdh", "True") || is("modified", "True");
        let convention = convention.or(is_modified.then_some(Convention::Craig));
        let moves = moves
            .or(has(&["prismatic"]).then_some(Moves::Slides))
            .or(has(&["revolute"]).then_some(Moves::Turns))
            .or((is("sigma", "1")).then_some(Moves::Slides))
            .or((is("sigma", "0")).then_some(Moves::Turns));
        let mut cells = Cells::new();
        let mut link = None;
        let mut limits = None;
        let mut is_flipped = false;
        // Values without names, in the order of the constructors of Python.
        let mut order = match call.name.as_str() {
            "DHLink" => vec![Role::D, Role::Alpha, Role::Theta, Role::A],
            "PrismaticDH" | "PrismaticMDH" | "Prismatic" => {
                vec![Role::Theta, Role::A, Role::Alpha, Role::Offset]
            }
            "RevoluteDH" | "RevoluteMDH" | "Revolute" => vec![Role::D, Role::A, Role::Alpha, Role::Offset],
            _ => vec![],
        }
        .into_iter();
        for argument in &call.arguments {
            let text = self.text[argument.value.clone()].trim();
            match argument.key.as_deref() {
                Some("theta") => drop(cells.insert(Role::Theta, argument.value.clone())),
                Some("d") => drop(cells.insert(Role::D, argument.value.clone())),
                Some("a") => drop(cells.insert(Role::A, argument.value.clone())),
                Some("alpha") => drop(cells.insert(Role::Alpha, argument.value.clone())),
                Some("offset") => drop(cells.insert(Role::Offset, argument.value.clone())),
                Some("qlim") => {
                    let ends = matrix(self.text, argument.value.clone()).map(|rows| rows.concat());
                    limits = ends.and_then(|ends| <[Range<usize>; 2]>::try_from(ends).ok());
                }
                Some("flip") => is_flipped = matches!(text, "True" | "true" | "1"),
                Some("sigma" | "mdh" | "modified") => {}
                Some(key) if BESIDE.contains(&key) => {
                    let message = "masses and drives of a program are not read";
                    let is_said = self.out.list().iter().any(|d| d.message == message);
                    if !is_said && key != "name" && key != "mesh" {
                        self.out.note(argument.value.clone(), message);
                    }
                }
                Some(key) => {
                    self.out.warning(argument.value.clone(), format!("`{key}` is unknown here: it is left"));
                }
                None if text.starts_with('[') && call.name == "Link" => {
                    let row = matrix(self.text, argument.value.clone())?.concat();
                    link = Some(self.of_row(&row, moves, convention)?);
                }
                None if quoted(text).is_some() => {}
                None => match order.next() {
                    Some(role) => drop(cells.insert(role, argument.value.clone())),
                    None => {
                        self.out
                            .error(argument.value.clone(), "what does this value say?")
                            .hint("give it a name, as in d=0.3");
                    }
                },
            }
        }
        if let Some(link) = link {
            return Some(Link { limits, is_flipped, span: call.span.clone(), ..link });
        }
        // A link that says θ and no d slides.
        let slides = cells.contains_key(&Role::Theta) && !cells.contains_key(&Role::D);
        let moves = moves.unwrap_or(if slides { Moves::Slides } else { Moves::Turns });
        let convention = convention.unwrap_or(Convention::Standard);
        Some(Link { cells, moves, convention, is_flipped, limits, span: call.span.clone() })
    }

    /// The rows of `dhparams` that joints of a `rigidBodyTree` are set by.
    pub(super) fn rigid_body_tree(&mut self) -> Option<Robot> {
        let set = calls(self.text, &self.statements, &["setFixedTransform"]);
        let first = set.iter().find(|c| c.arguments.len() >= 3)?;
        let last = quoted(&self.text[first.arguments.last()?.value.clone()])?;
        let convention = match last {
            "dh" => Convention::Standard,
            "mdh" => Convention::Craig,
            _ => return None,
        };
        let used = &self.text[first.arguments[1].value.clone()];
        let rows = self.defined(used.split('(').next()?.trim(), first.span.start)?;
        let rows = matrix(self.text, rows)?;
        let joints = calls(self.text, &self.statements, &["rigidBodyJoint"]);
        let kind = |c: &Call| match c.arguments.get(1).and_then(|a| quoted(&self.text[a.value.clone()])) {
            Some("revolute" | "continuous") => Moves::Turns,
            Some("prismatic") => Moves::Slides,
            _ => Moves::Nothing,
        };
        let kinds: Vec<Moves> = joints.iter().map(kind).collect();
        let mut links = vec![];
        for (k, row) in rows.iter().enumerate() {
            let span = row.first()?.start..row.last()?.end;
            if row.len() != 4 {
                self.out.error(span, format!("a row of {} values: a alpha d theta", row.len()));
                return None;
            }
            // In a loop one call stands for all.
            let moves = if kinds.len() == 1 { kinds.first() } else { kinds.get(k) };
            let Some(&moves) = moves else {
                self.out.error(span, "no `rigidBodyJoint` belongs to this row");
                return None;
            };
            let cells = TREE.into_iter().zip(row.iter().cloned()).collect();
            links.push(Link { cells, moves, convention, is_flipped: false, limits: None, span });
        }
        Some(Robot { name: None, links, span: first.span.clone() })
    }
}
