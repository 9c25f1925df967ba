//! A document's dynamics read in one way: its names, its formulas, and how its bodies and its gravity are read for most of them to be right.

use super::bodies::bodies;
use super::model::{Coordinates, Model, Ten, moving_rows};
use super::statements::{Read, statements};
use super::vote::{Symbols, Test, Vote, vote};
use super::words::{Role, names, words};
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit_reading::document::Statement;
use denavit_symbolic::{Expr, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// Arms with more joints are not judged: their formulas are no ones that people print.
const MAX_JOINTS: usize = 4;

/// A way to read a document's dynamics.
pub(super) struct Attempt {
    pub coordinates: Coordinates,
    pub read: Read,
    /// Of each piece without a row and of each row: its test.
    pub test_of_piece: Vec<Option<usize>>,
    pub test_of_row: Vec<usize>,
    pub tests: Vec<Test>,
    pub vote: Vote,
    pub bodies: Vec<Vec<Ten>>,
    pub gravities: Vec<[Expr; 3]>,
    /// The bodies are the robot's own.
    pub is_given: bool,
    pub rows: Vec<usize>,
}

impl Attempt {
    /// The arm of a reading.
    pub fn model(&self, subject: &Subject, reading: usize) -> Option<Model> {
        let reading = &self.vote.best[reading];
        let bodies: Vec<Ten> = reading.bodies.iter().zip(&self.bodies).map(|(k, all)| all[*k]).collect();
        let gravity = self.gravities[reading.gravity];
        Model::new(&subject.description, &self.rows, &bodies, gravity, self.coordinates)
    }

    /// How many tests are right.
    pub fn score(&self) -> usize {
        self.vote.best.first().map_or(0, |b| b.score)
    }

    /// The tests that are right in some reading, whatever the rest of the document says; each by itself.
    pub fn right_alone(&self, subject: &Subject, tests: &[usize]) -> Vec<usize> {
        let n = self.rows.len();
        let symbols = Symbols::new(n);
        let generic: Vec<Ten> = symbols.bodies.iter().map(|b| b.map(Expr::from)).collect();
        let gravity = symbols.gravity.map(Expr::from);
        let model = Model::new(&subject.description, &self.rows, &generic, gravity, self.coordinates);
        let Some(model) = model else { return vec![] };
        let is_right = |t: &usize| {
            let test = std::slice::from_ref(&self.tests[*t]);
            vote(&model, &symbols, test, &self.bodies, &self.gravities).is_some_and(|v| v.is_any_right)
        };
        tests.iter().copied().filter(is_right).collect()
    }

    fn is_perfect(&self) -> bool {
        self.vote.best.first().is_some_and(|b| b.right.iter().all(|r| *r)) && self.read.unread.is_empty()
    }
}

/// The way to read in which most is right; the more usual of those that are as good.
pub(super) fn best(text: &str, subject: &Subject, all: &[Statement]) -> Option<Attempt> {
    let d = &subject.description;
    let rows = moving_rows(d)?;
    let n = rows.len();
    if n > MAX_JOINTS {
        return None;
    }
    let sources = all.iter().map(|s| text.get(s.span.clone()).unwrap_or_default());
    let mentioned: BTreeSet<String> = sources.flat_map(words).collect();
    let symbols = Symbols::new(n);
    let generic: Vec<Ten> = symbols.bodies.iter().map(|b| b.map(Expr::from)).collect();
    let gravity = symbols.gravity.map(Expr::from);
    let own = subject.vocabulary();
    let letters = ['l', 'L', 'a', 'd', 'r'].into_iter().filter(|letter| {
        let named = |k: usize| format!("{letter}{}", k + 1);
        let is_new = |w: String| mentioned.contains(&w) && own.lookup(&w).is_none_or(|e| e.is_zero());
        (0..n).any(|k| is_new(named(k)))
    });
    let lengths: Vec<Option<char>> = std::iter::once(None).chain(letters.map(Some)).collect();
    let variables = d.variables();
    let is_planar = n > 1
        && variables.iter().all(|v| v.kind == JointKind::Revolute)
        && d.rows.iter().skip(usize::from(!d.convention.begins_with_joint())).all(|r| r.alpha.is_zero());
    let coordinates: &[Coordinates] = match is_planar {
        true => &[Coordinates::Joints, Coordinates::Absolute, Coordinates::AbsoluteWithTorques],
        false => &[Coordinates::Joints],
    };
    let mut found: Option<Attempt> = None;
    for &coordinates in coordinates {
        let model = Model::new(d, &rows, &generic, gravity, coordinates)?;
        for &letter in &lengths {
            let names = names(subject, &model.state, &rows, &mentioned, letter);
            let roles = names.roles.clone();
            let read = statements(text, all, names, &model.state);
            let Some(attempt) = attempted(text, subject, &rows, &symbols, &model, coordinates, read, &roles)
            else {
                continue;
            };
            if found.as_ref().is_none_or(|f| attempt.score() > f.score()) {
                found = Some(attempt);
            }
            if found.as_ref().is_some_and(Attempt::is_perfect) {
                return found;
            }
        }
    }
    found
}

#[expect(clippy::too_many_arguments, reason = "what one way to read rests on")]
fn attempted(
    text: &str,
    subject: &Subject,
    rows: &[usize],
    symbols: &Symbols,
    model: &Model,
    coordinates: Coordinates,
    read: Read,
    roles: &BTreeMap<Symbol, Role>,
) -> Option<Attempt> {
    let d = &subject.description;
    let n = rows.len();
    let meaning = |s: Symbol| read.given.get(&s).copied().unwrap_or(s.into());
    let is_given = d.has_masses();
    let bodies: Vec<Vec<Ten>> = rows
        .iter()
        .enumerate()
        .map(|(k, &row)| {
            let nothing = [Expr::int(0); 10];
            match is_given {
                true => vec![d.rows[row].body().map_or(nothing, |b| b.parameters())],
                false => bodies(d, row, k, k + 1 == n, roles, &meaning),
            }
        })
        .collect();
    let (gravities, told) = gravities(text, subject, roles);
    let mut tests: Vec<Test> = vec![];
    let mut test_of_piece = vec![None; read.pieces.len()];
    for (k, piece) in read.pieces.iter().enumerate() {
        if piece.row.is_none() {
            test_of_piece[k] = Some(tests.len());
            tests.push(Test { value: piece.value, candidates: piece.candidates.clone() });
        }
    }
    let mut test_of_row = vec![];
    for row in &read.rows {
        test_of_row.push(tests.len());
        tests.push(Test {
            value: row.value,
            candidates: vec![super::quantity::Quantity::Velocity(row.joint)],
        });
    }
    let mut vote = vote(model, symbols, &tests, &bodies, &gravities)?;
    // Among readings that are as good, the words decide.
    if vote.best.iter().any(|b| b.gravity < told) {
        vote.best.retain(|b| b.gravity < told);
    }
    let rows = rows.to_vec();
    Some(Attempt {
        coordinates,
        read,
        test_of_piece,
        test_of_row,
        tests,
        vote,
        bodies,
        gravities,
        is_given,
        rows,
    })
}

/// The accelerations of gravity that a document may mean, the more usual ones first, and how many of them its words or the robot tell.
fn gravities(text: &str, subject: &Subject, roles: &BTreeMap<Symbol, Role>) -> (Vec<[Expr; 3]>, usize) {
    let o = Expr::int(0);
    let g = roles.iter().find(|(_, r)| **r == Role::Gravity).map(|(s, _)| Expr::from(*s));
    if let Some(given) = subject.description.gravity {
        // Its size has a name in formulas.
        let along: Vec<usize> = (0..3).filter(|&i| !given[i].is_zero()).collect();
        if let (Some(g), &[i]) = (g, &along[..])
            && let Some(number) = given[i].as_number()
        {
            let mut named = [o; 3];
            named[i] = if number.is_negative() { -g } else { g };
            return (vec![named, given], 2);
        }
        return (vec![given], 1);
    }
    let Some(g) = g else { return (vec![[o; 3]], 1) };
    let told = told(text);
    let mut axes: [(usize, bool); 6] = [(1, true), (2, true), (0, true), (0, false), (1, false), (2, false)];
    axes.sort_by_key(|a| Some(*a) != told);
    let mut found: Vec<[Expr; 3]> = axes
        .iter()
        .map(|&(axis, is_down)| {
            let mut v = [o; 3];
            v[axis] = if is_down { -g } else { g };
            v
        })
        .collect();
    found.push([o; 3]);
    (found, usize::from(told.is_some()))
}

/// The direction in which a sentence says that gravity acts: the axis, and whether against it.
fn told(text: &str) -> Option<(usize, bool)> {
    const WORDS: [&str; 9] = [
        "gravit",
        "schwerkraft",
        "schwerebeschl",
        "erdbeschl",
        "pesanteur",
        "gravedad",
        "gravidade",
        "gravità",
        "weight",
    ];
    let lower = text.to_lowercase();
    let mut found: Option<(usize, bool)> = None;
    for word in WORDS {
        for (at, _) in lower.match_indices(word).take(50) {
            // No sentence is longer that says it.
            let mut first = at.saturating_sub(300);
            while !lower.is_char_boundary(first) {
                first += 1;
            }
            let start = lower[first..at].rfind(['.', '\n']).map_or(first, |k| first + k + 1);
            let mut last = (at + 300).min(lower.len());
            while !lower.is_char_boundary(last) {
                last -= 1;
            }
            let end = lower[at..last].find(['.', '\n']).map_or(last, |k| at + k);
            let sentence: String =
                lower[start..end].chars().filter(|c| !matches!(c, '$' | '{' | '}' | '\\' | '_')).collect();
            let sentence = ["hat", "vec", "mathbf"].iter().fold(sentence, |s, look| s.replace(look, ""));
            for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                for minus in ["-", "−", "–"] {
                    for (k, _) in sentence.match_indices(&format!("{minus}{letter}")) {
                        let behind = sentence[k + minus.len() + 1..].chars().next();
                        if behind.is_some_and(char::is_alphabetic) {
                            continue;
                        }
                        match found {
                            Some(other) if other != (axis, true) => return None,
                            _ => found = Some((axis, true)),
                        }
                    }
                }
            }
        }
    }
    found
}
