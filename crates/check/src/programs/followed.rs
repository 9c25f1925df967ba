//! What of a program follows from something wrong before: its value is right if that were right.

use super::stated::in_radians;
use super::{Followed, words};
use crate::walk::{Assertion, Piece};
use denavit_reading::code::{Code, Value};
use denavit_reading::slip::Points;
use denavit_symbolic::{Expr, equal};
use std::ops::Range;

/// The right entries of a matrix or scalar that is wrong, and where it is written.
pub(super) fn mended_by(assertion: &Assertion) -> Option<(usize, Vec<Expr>)> {
    let mut points = Points::new(31);
    let mut is_wrong = false;
    let mut entries = vec![];
    for piece in &assertion.pieces {
        let Piece::Pair(pair) = piece else { return None };
        is_wrong |= points.value(pair.value) != points.value(pair.wanted);
        entries.push(pair.wanted);
    }
    is_wrong.then_some((assertion.span.start, entries))
}

pub(super) fn entries_of(value: &Value) -> Vec<Expr> {
    match value {
        Value::Scalar(cell) => vec![cell.value],
        Value::Matrix(rows) => rows.iter().flatten().map(|c| c.value).collect(),
    }
}

/// The value that is written at a place, given or got.
fn value_at(codes: &[Code], span: &Range<usize>) -> Option<Vec<Expr>> {
    let functions = || codes.iter().flat_map(|c| &c.functions);
    let assigned = functions().flat_map(|f| &f.assigned).filter(|a| a.span == *span);
    let returned = functions().flat_map(|f| &f.returned).filter(|r| r.span == *span);
    assigned.map(|a| &a.value).chain(returned.map(|r| &r.value)).last().map(entries_of)
}

/// What is wrong, but right if what is wrong before were right.
pub(super) fn followed(
    source: &str,
    codes: &[Code],
    right: &[Code],
    assertions: &[Assertion],
) -> Vec<Followed> {
    let mut points = Points::new(37);
    let mut found: Vec<Followed> = vec![];
    let mut wrong: Vec<&Assertion> = assertions.iter().filter(|a| mended_by(a).is_some()).collect();
    wrong.sort_by_key(|a| a.span.start);
    for assertion in &wrong {
        let Some(values) = value_at(right, &assertion.span) else { continue };
        let same = value_at(codes, &assertion.span);
        if values.len() != assertion.pieces.len() || same.as_ref() == Some(&values) {
            continue;
        }
        let follows: Vec<bool> = values
            .iter()
            .zip(&assertion.pieces)
            .map(|(v, piece)| match piece {
                Piece::Pair(pair) => {
                    points.value(in_radians(*v)) == points.value(pair.wanted)
                        && equal(in_radians(*v), pair.wanted).is_equal()
                }
                _ => false,
            })
            .collect();
        let by = cause(&wrong, assertion.span.start, source.get(assertion.span.clone()));
        if let Some(by) = by.filter(|by| by.span != assertion.span && follows.iter().any(|f| *f)) {
            found.push(Followed { span: assertion.span.clone(), by: by.span.clone(), follows });
        }
    }
    found
}

/// The wrong claim that a formula rests on: one that it names, or the first.
pub(super) fn cause<'a>(
    wrong: &[&'a Assertion],
    before: usize,
    formula: Option<&str>,
) -> Option<&'a Assertion> {
    let earlier = || wrong.iter().copied().filter(|a| a.span.start < before);
    let named = |a: &&Assertion| formula.is_some_and(|f| words(f).any(|w| w == a.name));
    earlier().rfind(named).or_else(|| earlier().next())
}
