//! Entries r_ij of the rotation that was printed last, where they are not those of the hand: `R_7^4 = […]`, from which
//! `cos θ_6 = r_33`.

use super::{Assertion, Pair, Piece, Walk};
use crate::facts::About;
use crate::lexis::read;
use crate::matrix::Matrix;
use denavit_reading::document::{Part, Statement};
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, equal};
use std::rc::Rc;

/// So far behind the matrix, in bytes, its entries are spoken of.
const NEAR: usize = 300;
/// Letters of entries.
const LETTERS: [&str; 4] = ["r", "t", "R", "m"];

impl Walk<'_> {
    /// Keeps a rotation, or a transform, in print.
    pub(super) fn keep_printed(&mut self, statement: &Statement) {
        let grids = statement.sides.iter().rev().flat_map(|s| &s.parts).filter_map(|p| match p {
            Part::Matrix(grid) => Some(grid),
            Part::Text(_) => None,
        });
        let printed = grids.filter_map(|grid| self.printed(grid));
        let is_rotation = |m: &Matrix| matches!(m.shape(), Some((3, 3 | 4) | (4, 4)));
        if let Some(matrix) = printed.into_iter().find(is_rotation) {
            self.printed_last = Some((matrix, statement.span.end));
        }
    }

    /// Takes an equation that holds for the entries of the matrix printed last, and not for those of the hand.
    pub(super) fn is_of_last_matrix(&mut self, statement: &Statement) -> bool {
        let Some((matrix, end)) = &self.printed_last else { return false };
        let source = plain_name(self.source(&statement.span));
        let place = |k: usize| (k / 3, k % 3);
        let names =
            || (0..9).map(place).flat_map(|(r, c)| LETTERS.map(|l| (format!("{l}{}{}", r + 1, c + 1), r, c)));
        let is_near = statement.span.start.checked_sub(*end).is_some_and(|d| d < NEAR);
        if !is_near || statement.sides.len() < 2 || !names().any(|(n, ..)| source.contains(&n)) {
            return false;
        }
        let vocabulary =
            names().fold(self.lexis.names.clone(), |v: Vocabulary, (name, r, c)| match matrix.entry(r, c) {
                Some(entry) => v.alias(&name, entry),
                None => v,
            });
        let values = |names: &Vocabulary| -> Option<Vec<Expr>> {
            let side =
                |s: &denavit_reading::document::Side| Some(read(self.text, &s.span, names).ok()?.value());
            statement.sides.iter().map(side).collect()
        };
        let holds = |all: &[Expr]| all.iter().skip(1).all(|e| equal(all[0], *e).is_equal());
        let Some(there) = values(&vocabulary).filter(|all| holds(all)) else { return false };
        if values(&self.lexis.names).is_some_and(|all| holds(&all)) {
            return false;
        }
        let pairs = statement.sides.iter().zip(&there).skip(1);
        let pieces = pairs.map(|(side, value)| {
            let (span, wanted) = (side.span.clone(), there[0]);
            Piece::Pair(Pair { place: None, span, printed: None, value: *value, wanted, also: vec![] })
        });
        let pieces = pieces.collect();
        let names = Some(Rc::new(vocabulary));
        let assertion = Assertion { pieces, names, ..self.assertion(statement, About::Equation) };
        self.assertions.push(assertion);
        true
    }
}
