//! A computed value against the right one, and what cannot be held against one.

use super::Program;
use super::followed::entries_of;
use super::stated::in_radians;
use crate::note::{Unread, Unreadable};
use crate::numbers::{Answer, half_unit};
use crate::subject::Subject;
use crate::walk::{Pair, Piece, is_measured};
use denavit_reading::code::{Cell, Reading};
use denavit_symbolic::{Expr, Node, Rational, Symbol, equal};

impl Program<'_> {
    /// A computed value against the right one; lengths that the program has as numbers are numbers in both.
    pub(super) fn piece(&self, place: Option<(usize, usize)>, cell: &Cell, wanted: Expr) -> Piece {
        let value = in_radians(cell.value);
        let joints = self.subject.joints();
        let moves = wanted.symbols().iter().any(|s| joints.contains(&(*s).into()));
        let is_number = moves && value.symbols().is_empty() && is_measured(value);
        let line_end =
            self.text[cell.span.end..].find('\n').map_or(self.text.len(), |i| cell.span.end + i + 1);
        let at = self.at.iter().rev().find(|p| p.0 <= line_end).map(|p| &p.1);
        if is_number
            && let Some(at) = at.filter(|at| at.knows(wanted, self.subject))
            && let Ok(printed) = value.eval(|_| None)
        {
            let half = half_unit(self.text.get(cell.span.clone()).unwrap_or_default());
            let answer = Answer { printed, half, wanted, at: at.clone(), constant: Some(value) };
            return Piece::Number { place, span: cell.span.clone(), answer };
        }
        if is_number {
            let errors = vec![Unread::new(cell.span.clone(), Unreadable::NoConfiguration)];
            return Piece::Unreadable { place, span: cell.span.clone(), errors };
        }
        let d = &self.subject.description;
        let uses = |e: Expr| e.symbols().iter().any(|s| d.parameter(*s).is_some());
        let wanted = self.with_numbers(wanted, value);
        // A length that the program has under another name, or one that the robot has not: a tool's.
        // Rates and loads stand in what is wanted.
        let of_wanted = wanted.symbols();
        let is_known =
            |s: &Symbol| joints.contains(&(*s).into()) || d.parameter(*s).is_some() || of_wanted.contains(s);
        let differs = || !equal(value, wanted).is_equal();
        let foreign = value.symbols().into_iter().find(|s| !is_known(s));
        let has_lengths = Expr::postorder(&[value]).iter().any(|e| match e.node() {
            Node::Number(r) => !(&r * &Rational::from(2)).is_integer(),
            _ => false,
        });
        let is_lost = |s: &Symbol| has_lengths && d.parameter(*s).is_some() && !uses(value);
        let lost = wanted.symbols().into_iter().find(is_lost);
        // What is made of a pose in numbers is a formula of the joints only at that pose.
        let moved =
            |e: Expr| e.symbols().into_iter().filter(|s| joints.contains(&(*s).into())).collect::<Vec<_>>();
        let (own, other) = (moved(value), moved(wanted));
        let is_apart = !own.is_empty() && !other.is_empty() && !own.iter().any(|s| other.contains(s));
        let is_measured = |e: &Expr| match e.node() {
            Node::Number(r) => !(&r * &Rational::from(1000)).is_integer(),
            _ => false,
        };
        let at_pose = is_apart && Expr::postorder(&[value]).iter().any(is_measured);
        let apart = own.first().copied().filter(|_| at_pose);
        // A length of the program's own beside all of the robot's, as that of a tool.
        let numbers = |e: Expr| -> Vec<Rational> {
            let all = Expr::postorder(&[e]).into_iter().filter_map(|e| e.as_number());
            all.filter(|r| !(r * &Rational::from(2)).is_integer()).map(|r| r.abs()).collect()
        };
        let (mine, theirs) = (numbers(value), numbers(wanted));
        let has_more = theirs.iter().all(|r| mine.contains(r)) && mine.iter().any(|r| !theirs.contains(r));
        if has_more && foreign.is_none() && !self.knows_all(&mine) && differs() {
            let why = Unreadable::Unknown(self.text.get(cell.span.clone()).unwrap_or_default().to_string());
            let errors = vec![Unread::new(cell.span.clone(), why)];
            return Piece::Unreadable { place, span: cell.span.clone(), errors };
        }
        if let Some(name) = foreign.or(lost).or(apart).filter(|_| differs()) {
            let errors = vec![Unread::new(cell.span.clone(), Unreadable::Unknown(name.name().to_string()))];
            return Piece::Unreadable { place, span: cell.span.clone(), errors };
        }
        let is_written = value == cell.value && self.text.get(cell.span.clone()).is_some();
        let printed = cell.syntax.clone().filter(|_| is_written);
        Piece::Pair(Pair { place, span: cell.span.clone(), printed, value, wanted, also: vec![] })
    }

    /// What is wanted with the numbers that the program has for lengths, where what is printed has none of these as letters.
    pub(super) fn with_numbers(&self, wanted: Expr, printed: Expr) -> Expr {
        let d = &self.subject.description;
        if printed.symbols().iter().any(|s| d.parameter(*s).is_some()) {
            return wanted;
        }
        wanted.substitute(|s| {
            let given = self.given.iter().rev().find(|g| g.0 == s).map(|g| g.1);
            given.or_else(|| d.exact_value(s))
        })
    }
}

/// Why a function is not judged of which nothing says in what its angles are.
pub(super) fn angles_open() -> Unreadable {
    let message = "whether the joints are in degrees or in radians is not told here".into();
    Unreadable::Syntax { message, hint: Some("turn them into radians in each function, or in none".into()) }
}

/// True if joints occur in what a function computes.
pub(super) fn is_moved(function: &Reading, subject: &Subject) -> bool {
    let assigned = function.assigned.iter().map(|a| &a.value);
    let values = assigned.chain(function.returned.iter().map(|r| &r.value));
    let joints = subject.joints();
    let mut symbols = values.flat_map(entries_of).flat_map(|e| e.symbols());
    symbols.any(|s| joints.contains(&s.into()))
}
