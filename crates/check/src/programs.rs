//! What straight-line code computes, as claims about the robot: matrices and scalars whose names say what they are, and
//! what a function returns.

use super::facts::{About, Meaning};
use super::jacobians::Told;
use super::lexis::Lexis;
use super::matrix::Matrix;
use super::note::{Unread, Unreadable};
use super::subject::Subject;
use super::walk::{Assertion, Pair, Piece, is_measured};
use denavit::forward::Reference;
use denavit_reading::code::{Assigned, Cell, Code, Dialect, Reading, Value, read};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;
use std::rc::Rc;

/// The claims of a program, and what of it could not be read.
pub(super) fn assertions(
    text: &str,
    span: &Range<usize>,
    language: Dialect,
    subject: &Subject,
    lexis: &Lexis,
    number: usize,
) -> (Vec<Assertion>, Vec<Unread>) {
    let joints: Vec<Expr> = subject.description.variables().iter().map(|v| v.symbol.into()).collect();
    let meaning = |name: &str| lexis.names.lookup(name).filter(|_| !lexis.is_by_custom(name));
    let Code { functions, refusals } = read(text, span.clone(), language, &meaning, &joints);
    let mut refusals: Vec<Unread> = refusals.into_iter().map(Unread::from).collect();
    let mut found = vec![];
    for function in &functions {
        let names = Rc::new(names_in(function, lexis));
        let given = functions.iter().filter(|f| f.name.is_empty() || f.name == function.name);
        let given = given.flat_map(|f| given_in(f, subject, lexis)).collect();
        let program = Program { text, subject, lexis, number, names, given };
        let before = found.len();
        found.extend(program.assigned(function));
        found.extend(program.returned(function));
        if found.len() == before && !function.returned.is_empty() {
            let why = Unreadable::NothingTold(function.name.clone());
            refusals.push(Unread::new(function.span.clone(), why));
        }
    }
    (found, refusals)
}

/// Lengths of the robot that a program sets to numbers.
fn given_in(function: &Reading, subject: &Subject, lexis: &Lexis) -> Vec<(Symbol, Expr)> {
    let of = |a: &Assigned| {
        let Value::Scalar(cell) = &a.value else { return None };
        let symbol = lexis.names.lookup(&a.name)?.as_symbol()?;
        let is_length = subject.description.parameter(symbol).is_some();
        (is_length && cell.value.symbols().is_empty()).then_some((symbol, cell.value))
    };
    function.assigned.iter().filter_map(of).collect()
}

/// The names of the document and those that a function gives its scalars.
fn names_in(function: &Reading, lexis: &Lexis) -> Vocabulary {
    function.assigned.iter().fold(lexis.names.clone(), |names, a| match &a.value {
        Value::Scalar(cell) if a.name.chars().all(char::is_alphanumeric) => names.alias(&a.name, cell.value),
        _ => names,
    })
}

struct Program<'a> {
    text: &'a str,
    subject: &'a Subject,
    lexis: &'a Lexis,
    number: usize,
    names: Rc<Vocabulary>,
    /// Lengths that the program has as numbers.
    given: Vec<(Symbol, Expr)>,
}

impl Program<'_> {
    /// The last values of variables whose names say what they are.
    fn assigned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        for (i, a) in function.assigned.iter().enumerate() {
            let is_last = !function.assigned[i + 1..].iter().any(|b| b.name == a.name);
            // What is returned under that name is judged there.
            let is_returned = function.returned.iter().any(|r| r.name.as_deref() == Some(a.name.as_str()));
            if is_last
                && !is_returned
                && !(is_of_part(function) && matches!(a.name.to_lowercase().as_str(), "x" | "y" | "z"))
                && a.name.contains(|c: char| c.is_ascii_digit() || c == 'x' || c == 'y' || c == 'z')
            {
                found.extend(self.named(&a.name, &a.name, &a.span, &a.value));
            }
        }
        found
    }

    fn returned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        for r in &function.returned {
            let shown = r.name.clone().unwrap_or_else(|| format!("{}(…)", function.name));
            let named = r.name.as_ref().and_then(|name| self.named(name, &shown, &r.span, &r.value));
            found.extend(named.or_else(|| match &r.value {
                Value::Matrix(rows) => self.pose(function, &shown, &r.span, rows),
                Value::Scalar(_) => None,
            }));
        }
        found
    }

    /// A variable whose name has a meaning.
    fn named(&self, name: &str, shown: &str, span: &Range<usize>, value: &Value) -> Option<Assertion> {
        match value {
            // A name for another one says nothing.
            Value::Scalar(cell) if cell.value.as_symbol().is_some() => None,
            Value::Scalar(cell) => {
                let axis = ["x", "y", "z"].iter().position(|a| *a == name.to_lowercase());
                let wanted = match axis.filter(|_| self.lexis.names.lookup(name).is_none()) {
                    Some(r) => self.subject.pose().translation.0[r],
                    None => self.lexis.names.lookup(name).filter(|_| self.lexis.is_right(name))?,
                };
                let pieces = vec![self.piece(None, cell, wanted)];
                Some(self.assertion(shown, About::Entry, span, pieces, None))
            }
            Value::Matrix(rows) => {
                let name = self.lexis.lone_name(name, &(0..name.len()))?;
                if name.is_bare() {
                    return None;
                }
                let (matrix, about) = self.lexis.matrix(self.subject, &name)?;
                let pieces = self.compare(rows, &matrix)?;
                Some(self.assertion(shown, About::Matrix(about?), span, pieces, Some(matrix)))
            }
        }
    }

    /// What a function gives back without a telling name: by its shape the hand's pose, rotation, position or Jacobian.
    fn pose(
        &self,
        function: &Reading,
        shown: &str,
        span: &Range<usize>,
        rows: &[Vec<Cell>],
    ) -> Option<Assertion> {
        if is_of_part(function) {
            return None;
        }
        let pose = self.subject.pose();
        let columns = rows.first()?.len();
        let joints = self.subject.description.variables().len();
        let is_jacobian = function.name.to_lowercase().contains("jac") || shown.starts_with('J');
        let hand = Meaning::Frame { of: Reference::Tool, seen_from: Reference::Frame(0) };
        let (matrix, about) = match (rows.len(), columns) {
            (n, m) if is_jacobian && m == joints && n <= 6 => {
                let values = Matrix(rows.iter().map(|r| r.iter().map(|c| Some(c.value)).collect()).collect());
                let (matrix, jacobian) = self.subject.nearest_jacobian(&values, &Told::default())?;
                (matrix, Meaning::Jacobian(jacobian))
            }
            (4, 4) => (Matrix::of(&pose), hand),
            (3, 3) => (Matrix::of_rotation(&pose.rotation), Meaning::Rotation(hand.into())),
            (3, 1) => (Matrix::column(&pose.translation), Meaning::Position),
            _ => return None,
        };
        let pieces = self.compare(rows, &matrix)?;
        Some(self.assertion(shown, About::Matrix(about), span, pieces, Some(matrix)))
    }

    fn compare(&self, rows: &[Vec<Cell>], matrix: &Matrix) -> Option<Vec<Piece>> {
        let mut pieces = vec![];
        for (r, row) in rows.iter().enumerate() {
            for (c, cell) in row.iter().enumerate() {
                let wanted = matrix.entry(r, c)?;
                pieces.push(self.piece(Some((r + 1, c + 1)), cell, wanted));
            }
        }
        Some(pieces)
    }

    /// A computed value against the right one; lengths that the program has as numbers are numbers in both.
    fn piece(&self, place: Option<(usize, usize)>, cell: &Cell, wanted: Expr) -> Piece {
        let joints = self.subject.joints();
        let moves = wanted.symbols().iter().any(|s| joints.contains(&(*s).into()));
        if moves && cell.value.symbols().is_empty() && is_measured(cell.value) {
            let errors = vec![Unread::new(cell.span.clone(), Unreadable::NoConfiguration)];
            return Piece::Unreadable { place, span: cell.span.clone(), errors };
        }
        let d = &self.subject.description;
        let uses = |e: Expr| e.symbols().iter().any(|s| d.parameter(*s).is_some());
        let wanted = match uses(cell.value) {
            true => wanted,
            false => wanted.substitute(|s| {
                let given = self.given.iter().rev().find(|g| g.0 == s).map(|g| g.1);
                given.or_else(|| d.exact_value(s))
            }),
        };
        let printed = cell.syntax.clone().filter(|_| self.text.get(cell.span.clone()).is_some());
        Piece::Pair(Pair { place, span: cell.span.clone(), printed, value: cell.value, wanted, also: vec![] })
    }

    fn assertion(
        &self,
        name: &str,
        about: About,
        span: &Range<usize>,
        pieces: Vec<Piece>,
        whole: Option<Matrix>,
    ) -> Assertion {
        Assertion {
            span: span.clone(),
            name: name.to_string(),
            about,
            pieces,
            remarks: vec![],
            subject: self.number,
            whole,
            names: Some(Rc::clone(&self.names)),
            reference: None,
            spoken: None,
        }
    }
}

/// True for a function whose name says that it is about a part of the arm, not about the hand.
fn is_of_part(function: &Reading) -> bool {
    const PARTS: [&str; 18] = [
        "wrist",
        "elbow",
        "shoulder",
        "knee",
        "ankle",
        "hip",
        "axis",
        "axes",
        "center",
        "centre",
        "poignet",
        "coude",
        "epaule",
        "handgelenk",
        "ellbogen",
        "schulter",
        "muneca",
        "codo",
    ];
    let name = function.name.to_lowercase();
    PARTS.iter().any(|part| name.contains(part))
}
