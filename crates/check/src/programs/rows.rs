//! The function of a row of a table, `dh(theta, d, a, alpha)`.

use super::names_in;
use crate::facts::{About, Meaning};
use crate::lexis::Lexis;
use crate::matrix::Matrix;
use crate::walk::{Assertion, Pair, Piece};
use denavit::description::{Convention, Screw};
use denavit::geometry::Axis;
use denavit_reading::code::{RowFunction, Value};
use denavit_symbolic::equal;
use std::rc::Rc;

/// A matrix with more wrong entries is none of a row.
const MOST_WRONG: usize = 5;

/// The transform of a row as a function gives it, held against the convention to which it is nearest, the robot's first.
pub(super) fn row_function(
    text: &str,
    function: &RowFunction,
    convention: Convention,
    number: usize,
    lexis: &Lexis,
) -> Option<Assertion> {
    let returned = function.reading.returned.first()?;
    let Value::Matrix(rows) = &returned.value else { return None };
    if rows.len() != 4 || rows.iter().any(|r| r.len() != 4) {
        return None;
    }
    let [theta, alpha] = function.angles;
    let [first, second] = function.lengths;
    let mut best: Option<(usize, Matrix)> = None;
    let standard = convention.begins_with_joint();
    for begins_with_joint in [standard, !standard] {
        for (along_x, along_z) in [(first, second), (second, first)] {
            let z = Screw { axis: Axis::Z, angle: theta, length: along_z }.transform();
            let x = Screw { axis: Axis::X, angle: alpha, length: along_x }.transform();
            let wanted = Matrix::of(&if begins_with_joint { z * x } else { x * z });
            let differs = |&(r, c): &(usize, usize)| {
                wanted.entry(r, c).is_none_or(|w| !equal(rows[r][c].value, w).is_equal())
            };
            let count = (0..16).map(|k| (k / 4, k % 4)).filter(differs).count();
            if best.as_ref().is_none_or(|b| count < b.0) {
                best = Some((count, wanted));
            }
        }
    }
    let (_, wanted) = best.filter(|b| b.0 <= MOST_WRONG)?;
    let mut pieces = vec![];
    for (r, row) in rows.iter().enumerate() {
        for (c, cell) in row.iter().enumerate() {
            let printed = cell.syntax.clone().filter(|_| text.get(cell.span.clone()).is_some());
            pieces.push(Piece::Pair(Pair {
                place: Some((r + 1, c + 1)),
                span: cell.span.clone(),
                printed,
                value: cell.value,
                wanted: wanted.entry(r, c)?,
                also: vec![],
            }));
        }
    }
    let own = names_in(&function.reading, lexis);
    let names = [theta, alpha, first, second].iter().fold(own, |names, e| {
        let name = e.as_symbol().map_or_else(String::new, |s| s.name().trim_end_matches("_i").to_string());
        names.alias(&name, *e)
    });
    Some(Assertion {
        span: returned.span.clone(),
        name: function.reading.name.clone(),
        about: About::Matrix(Meaning::Row),
        pieces,
        remarks: vec![],
        subject: number,
        whole: None,
        names: Some(Rc::new(names)),
        reference: None,
        spoken: None,
    })
}
