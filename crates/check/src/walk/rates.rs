//! Velocities and loads of the hand that a document gives, and the rates of joints in numbers.

use super::matrices::elements;
use super::words::RATES;
use super::{Cell, Reference, Scalar, Walk};
use crate::jacobians::Part as Rows;
use crate::matrix::Matrix;
use crate::names::Name;
use denavit_reading::document::{Part, Statement};
use denavit_symbolic::{Expr, Symbol};

impl Walk<'_> {
    /// The letters of a load that the document gives as a vector, `f = (0, 0, -W)`, stand for themselves.
    pub(super) fn declare_load(&mut self, statement: &Statement) {
        let [left, right] = &statement.sides[..] else { return };
        let is_load = self.lone(left).is_some_and(|n| matches!(n.base.as_str(), "f" | "F" | "w" | "W" | "h"));
        if !is_load {
            return;
        }
        let [Part::Matrix(grid), ..] = &right.parts[..] else {
            // `F = N u`: what follows is about a load that is not known, but for one in brackets that is read with the torques.
            if !self.source(&right.span).starts_with('(') {
                self.load = None;
            }
            return;
        };
        if elements(grid) > 6 {
            return;
        }
        let cells = self.cells(grid);
        let mut free: Vec<String> = vec![];
        for (cell, span) in cells.iter().flatten().zip(grid.rows.iter().flatten()) {
            if matches!(cell, Cell::Formulas(_) | Cell::LeftOut) {
                continue;
            }
            let bare = span.start + self.text[span.clone()].len()
                - self.text[span.clone()].trim_start_matches(['-', '−', ' ', '+']).len();
            if let Some(name) = self.lexis.lone_name(self.text, &(bare..span.end)) {
                free.push(format!("{}{}", name.base, name.sub));
            }
        }
        if !free.is_empty() {
            for name in free {
                self.lexis.define(&name, Expr::symbol(&name));
            }
            self.cells.borrow_mut().clear();
        }
        // Components that have names of their own are these from here on.
        let letter = self.lone(left).map(|n| n.base).unwrap_or_default();
        let Some(values) = self.printed(grid).map(|m| m.0.concat()) else { return };
        let components = ["x", "y", "z"].map(|axis| Symbol::new(&format!("{letter}{axis}")));
        let is_same = |(s, v): (&Symbol, &Option<Expr>)| *v == Some((*s).into());
        if components.iter().zip(&values).any(|pair| !is_same(pair)) {
            let given = components.iter().zip(values);
            self.load = Some(given.filter_map(|(s, v)| Some((*s, v?))).collect());
        }
    }

    /// True for a statement that only gives a load: `F = (0, 0, -W)`.
    pub(super) fn is_load_given(&self, statement: &Statement) -> bool {
        let [left, right] = &statement.sides[..] else { return false };
        let [Part::Matrix(grid)] = &right.parts[..] else { return false };
        let is_load = self.lone(left).is_some_and(|n| {
            matches!(n.base.as_str(), "f" | "F") && [&n.left, &n.sub, &n.sup].iter().all(|i| i.is_empty())
        });
        let joints = self.subject.joints();
        let is_still =
            |e: &Option<Expr>| e.is_some_and(|e| e.symbols().iter().all(|s| !joints.contains(&(*s).into())));
        is_load && self.printed(grid).is_some_and(|m| m.0.iter().flatten().all(is_still))
    }

    /// A torque under the load that was given last; nothing where that is not known.
    pub(super) fn under_load(&self, wanted: Expr) -> Option<Expr> {
        let is_component = |s: &Symbol| {
            let name = s.name();
            matches!(&*name, "Fx" | "Fy" | "Fz" | "fx" | "fy" | "fz")
        };
        if !wanted.symbols().iter().any(is_component) {
            return Some(wanted);
        }
        let load = self.load.as_ref()?;
        Some(wanted.substitute(|s| load.iter().find(|l| l.0 == s).map(|l| l.1)))
    }

    /// Keeps a component of the velocity that a question asks joint rates for: `Which joint rates give vx = 0.2 m/s, vy = 0?`
    pub(super) fn is_velocity_sought(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        const MOST: usize = 80;
        let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
        let (of, value) = (left.value(), right.value());
        if of.symbols().is_empty() || !value.symbols().is_empty() {
            return false;
        }
        let Some(row) = self.subject.velocity().iter().position(|v| *v == of) else { return false };
        let rest = self.text.get(statement.span.end..).unwrap_or_default();
        let is_question = rest.find(['?', '\n']).is_some_and(|at| at < MOST && rest[at..].starts_with('?'));
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default().to_lowercase();
        if !is_question || !RATES.iter().any(|words| line.contains(words)) {
            return false;
        }
        for rate in self.subject.rates() {
            rate.symbols().into_iter().for_each(|s| self.at.forget(s));
        }
        self.sought.insert(row, value);
        self.taken.push(statement.span.clone());
        true
    }

    /// The velocity of the hand that the document gives as numbers: `v = (0.1, 0, 0)`.
    pub(super) fn velocity_given(&self) -> Option<Matrix> {
        let sought = |rows: Vec<usize>| -> Option<Vec<Vec<Option<Expr>>>> {
            rows.iter().map(|r| Some(vec![Some(*self.sought.get(r)?)])).collect()
        };
        if let Some(column) = self.subject.task(Rows::Any).and_then(sought) {
            return Some(Matrix(column));
        }
        let name = Name { base: "v".into(), ..Name::default() };
        let v = self.lexis.defined(&name)?;
        // `v = (0.1, 0, 0)` is a column.
        let v = if v.shape()?.0 == 1 { v.transposed() } else { v.clone() };
        let is_number = |e: &Option<Expr>| e.is_some_and(|e| e.symbols().is_empty());
        (v.shape()? == (self.subject.joints().len(), 1) && v.0.iter().flatten().all(is_number)).then_some(v)
    }

    /// A formula in the joints' rates by those that the given velocity of the hand takes, where it is in numbers.
    pub(super) fn with_rates(&self, wanted: Expr) -> Expr {
        let rates = self.subject.rates();
        let is_rate = |s: &Symbol| rates.contains(&(*s).into());
        let is_open = wanted.symbols().iter().any(|s| is_rate(s) && self.at.length(*s).is_none());
        let Some(v) = self.velocity_given().filter(|_| is_open) else { return wanted };
        let jacobian = self.subject.square_jacobian(Rows::Any).and_then(|j| j.inverse());
        let Some(values) = jacobian.and_then(|j| j.times(&v)) else { return wanted };
        wanted.substitute(|s| {
            let k = rates.iter().position(|r| *r == s.into())?;
            values.entry(k, 0)
        })
    }

    /// The joint rates that a velocity takes, where a statement is about them: `\dot q = J^{-1} v`.
    pub(super) fn rates_of(&self, statement: &Statement) -> Option<Reference> {
        let [Part::Text(name)] = &statement.sides.first()?.parts[..] else { return None };
        let plain = crate::custom::plain(self.source(name));
        if !matches!(plain.as_str(), "dotq" | "dotθ" | "qdot" | "θdot" | "q\u{307}" | "θ\u{307}") {
            return None;
        }
        let jacobian = self.subject.square_jacobian(Rows::Any)?;
        let matrix = jacobian.inverse()?.times(&self.velocity_given()?)?;
        Some(Reference { matrix, about: None })
    }

    /// A velocity where words say that only the joints move whose rates are printed.
    pub(super) fn of_moving(&self, statement: &Statement, read: &[Scalar], wanted: Expr) -> Expr {
        let rates = self.subject.rates();
        let is_rate = |e: &Expr| rates.contains(e);
        let says_only = self.speaks_of_some_alone(statement);
        if !wanted.symbols().iter().any(|s| is_rate(&(*s).into())) {
            return wanted;
        }
        let printed: Vec<Expr> = read
            .iter()
            .skip(1)
            .filter_map(|s| if let Scalar::Formula(_, s) = s { Some(s.value()) } else { None })
            .flat_map(|e| e.symbols())
            .map(Expr::from)
            .filter(is_rate)
            .collect();
        // A formula without rates, where all are 1.
        let moves = |e: Expr| e.symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
        let is_formula = read.iter().skip(1).any(|s| matches!(s, Scalar::Formula(_, s) if moves(s.value())));
        let are_units = || {
            let mut words = self.words_around(statement);
            words.any(|w| w.contains("1 rad/s") || w.contains("unit rate") || w.contains("unit speed"))
        };
        if printed.is_empty() && is_formula && are_units() {
            return wanted.substitute(|s| is_rate(&s.into()).then(|| Expr::int(1)));
        }
        match printed.is_empty() || !says_only {
            true => wanted,
            false => wanted.substitute(|s| {
                let e = Expr::from(s);
                (is_rate(&e) && !printed.contains(&e)).then(|| Expr::int(0))
            }),
        }
    }

    /// The words of a statement's paragraph, its heading and its sentence.
    fn words_around(&self, statement: &Statement) -> impl Iterator<Item = String> {
        let around = [&statement.prose, &statement.heading].into_iter().flatten();
        let around = around.filter_map(|s| self.text.get(s.clone()));
        around.chain([self.sentence_before(statement)]).map(str::to_lowercase).collect::<Vec<_>>().into_iter()
    }

    /// True where words say that only some joints move.
    pub(super) fn speaks_of_some_alone(&self, statement: &Statement) -> bool {
        const ONLY: [&str; 8] = ["only ", "alone", " nur ", "allein", "seule", "solo ", "sola ", "solamente"];
        self.words_around(statement).any(|w| ONLY.iter().any(|o| w.contains(o)))
    }

    /// True where words before a statement ask for rates, or give a velocity that is wanted.
    pub(super) fn asks_for_rates(&self, statement: &Statement) -> bool {
        const WANTED: [&str; 12] = [
            "with ",
            "for ",
            "want",
            "should",
            "soll",
            "gewünscht",
            "pour ",
            "avec ",
            "para ",
            "per ",
            "desir",
            "given",
        ];
        let words = self.sentence_before(statement).to_lowercase();
        // `with 1 rad/s on the shoulder`: these are the rates.
        let are_told = ["rad/s", "deg/s", "°/s"].iter().any(|u| words.contains(u));
        RATES.iter().chain(WANTED.iter().filter(|_| !are_told)).any(|w| words.contains(w))
    }

    /// What stands before a statement in its sentence, or in the part of it behind a semicolon.
    fn sentence_before(&self, statement: &Statement) -> &str {
        const FAR: usize = 300;
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let start = before.char_indices().rev().nth(FAR).map_or(0, |c| c.0);
        let before = &before[start..];
        let part = before.rsplit("\n\n").next().unwrap_or(before);
        let part = part.rsplit(". ").next().unwrap_or(part);
        part.rsplit(';').next().unwrap_or(part)
    }
}
