//! Formulas that are judged together: rows of C, and what uses a helper that is wrong.

use super::author::Author;
use super::points;
use super::quantity::Quantity;
use super::repair::Repairer;
use super::statements::Piece;
use super::verdict::{By, Fared, Said, Verdicts, WrongHelper, wrongs};
use crate::facts::Unproved;
use crate::outcome::Slip;
use denavit_symbolic::{Equality, Expr, Symbol, equal};

/// One entry of a row of C that makes the row right, if the others are as printed.
struct Mended {
    cost: u32,
    at: usize,
    wanted: Expr,
    slips: Vec<Slip>,
    /// The row with it, and what it gives.
    identity: [Expr; 2],
}

impl Verdicts<'_> {
    /// A row of C that does not give the velocity torque.
    pub(super) fn row(&self, r: usize, said: &mut [Option<Said>], repairer: &mut Repairer, author: &Author) {
        let read = &self.attempt.read;
        let (row, test) = (&read.rows[r], self.attempt.test_of_row[r]);
        let n = row.pieces.len();
        let is_open = self.fared(test) == Fared::Either
            || self.attempt.score() == 0 && !self.attempt.is_given
            || self.attempt.is_cut()
            || !self.is_pinned(test);
        let truth: Option<Vec<Expr>> =
            (0..n).map(|j| self.model.value(Quantity::CoriolisEntry(row.joint, j))).collect();
        let (Some(truth), Some(whole)) = (truth, self.model.value(Quantity::Velocity(row.joint))) else {
            return row.pieces.iter().for_each(|&p| said[p] = Some(Said::Open(Unproved::NotFound)));
        };
        if is_open {
            return row.pieces.iter().for_each(|&p| said[p] = Some(Said::Open(Unproved::OpenReading)));
        }
        let wrong = wrongs(said);
        let follows = author.wants(Quantity::Velocity(row.joint), row.pieces[0], &wrong);
        if let Some((_, by)) = follows.into_iter().find(|(wanted, _)| equal(row.value, *wanted).is_equal()) {
            for (j, &p) in row.pieces.iter().enumerate() {
                said[p] = Some(Said::Carried { by: By::Piece(by), wanted: truth[j] });
            }
            return;
        }
        let rates = &self.model.state.qd;
        let mut off: Vec<usize> = vec![];
        for (j, &p) in row.pieces.iter().enumerate() {
            let value = read.pieces[p].value;
            match equal(value, truth[j]) {
                Equality::Equal { conditions } => {
                    said[p] =
                        Some(Said::Right { identity: Some([value, truth[j]]), unless_zero: conditions });
                }
                _ => off.push(j),
            }
        }
        // One entry that makes the row right, if the others are as printed; or each by its own symbol.
        let mut best: Option<Mended> = None;
        let mut each: Vec<(u32, usize, Vec<Slip>)> = vec![];
        for &j in &off {
            let p = row.pieces[j];
            let rest = row
                .pieces
                .iter()
                .enumerate()
                .filter(|(i, _)| *i != j)
                .fold(Expr::int(0), |sum, (i, &p)| sum + read.pieces[p].value * Expr::from(rates[i]));
            let by_row = (whole - rest) / Expr::from(rates[j]);
            if let Some((cost, slips, value)) = repairer.slips(&read.pieces[p], by_row)
                && best.as_ref().is_none_or(|b| cost < b.cost)
            {
                let identity = [rest + value * Expr::from(rates[j]), whole];
                best = Some(Mended { cost, at: j, wanted: value, slips, identity });
            }
            if let Some((cost, slips, _)) = repairer.slips(&read.pieces[p], truth[j]) {
                each.push((cost, j, slips));
            }
        }
        let all: u32 = each.iter().map(|e| e.0).sum();
        if each.len() == off.len() && best.as_ref().is_none_or(|b| all <= b.cost) {
            for (_, j, slips) in each {
                said[row.pieces[j]] = Some(Said::Wrong { wanted: truth[j], slips });
            }
            return;
        }
        if let Some(Mended { at, wanted, slips, identity, .. }) = best {
            said[row.pieces[at]] = Some(Said::Wrong { wanted, slips });
            for &j in off.iter().filter(|j| **j != at) {
                // Right with the others as they should be: C is not the only matrix that gives the torques.
                said[row.pieces[j]] = Some(Said::Right { identity: Some(identity), unless_zero: vec![] });
            }
            return;
        }
        // The row is wrong, whichever entry is.
        for (k, &j) in off.iter().enumerate() {
            said[row.pieces[j]] = Some(match k {
                0 => Said::Wrong { wanted: truth[j], slips: vec![] },
                _ => Said::Open(Unproved::NotFound),
            });
        }
    }

    /// The wrong number of a point on which a formula rests that is right with what that should be; and what is right.
    pub(super) fn rests_on(&self, piece: &Piece, said: &[Option<Said>]) -> Option<(usize, Expr)> {
        let read = &self.attempt.read;
        for (name, &(by, kind)) in &read.defined {
            let Some(Said::Wrong { wanted, .. }) = &said[by] else { continue };
            let names = points::with(read.vocabulary.clone(), kind, name, *wanted, &self.model.state);
            let Ok(syntax) = crate::lexis::read(self.text, &piece.span, &names) else { continue };
            for &quantity in &piece.candidates {
                let truth = self.model.value(quantity)?;
                let (truth, found) = self.compared(syntax.value(), truth, quantity);
                if found.is_equal() {
                    return Some((by, truth));
                }
            }
        }
        None
    }

    /// Blames a helper if one change of it makes all right that is wrong and uses it.
    pub(super) fn helper(
        &self,
        h: usize,
        said: &mut [Option<Said>],
        helpers: &mut Vec<WrongHelper>,
        repairer: &mut Repairer,
    ) {
        let read = &self.attempt.read;
        let helper = &read.helpers[h];
        let symbol = Symbol::new(&format!("helper {}", helper.name));
        let names = read.vocabulary.clone().alias(&helper.name, symbol.into());
        let value = |k: usize| -> Option<Expr> {
            let syntax = crate::lexis::read(self.text, &read.pieces[k].span, &names).ok()?;
            let printed = syntax.value();
            // A scaled matrix is worked out.
            read.pieces[k].syntax.as_ref()?;
            Some(printed)
        };
        let with = |e: Expr, by: Expr| e.substitute(|s| (s == symbol).then_some(by));
        // What is wrong, as a pair of formulas in the helper and what it should be.
        let mut pairs: Vec<(Vec<usize>, Expr, Expr)> = vec![];
        for (k, piece) in read.pieces.iter().enumerate() {
            let (None, Some(test)) = (&said[k], self.attempt.test_of_piece[k]) else { continue };
            if self.fared(test) != Fared::Wrong || !self.is_pinned(test) || piece.candidates.len() != 1 {
                continue;
            }
            let (Some(value), Some(wanted)) = (value(k), self.model.value(piece.candidates[0])) else {
                continue;
            };
            if value.symbols().contains(&symbol) && !piece.candidates[0].is_up_to_constant() {
                pairs.push((vec![k], value, wanted));
            }
        }
        for (r, row) in read.rows.iter().enumerate() {
            let test = self.attempt.test_of_row[r];
            if row.pieces.iter().any(|p| said[*p].is_some())
                || self.fared(test) != Fared::Wrong
                || !self.is_pinned(test)
            {
                continue;
            }
            let mut sum = Expr::int(0);
            let mut is_read = true;
            for (&p, &rate) in row.pieces.iter().zip(&self.model.state.qd) {
                match value(p) {
                    Some(v) => sum = sum + v * Expr::from(rate),
                    None => is_read = false,
                }
            }
            let wanted = self.model.value(Quantity::Velocity(row.joint));
            if let (true, Some(wanted)) = (is_read && sum.symbols().contains(&symbol), wanted) {
                pairs.push((row.pieces.clone(), sum, wanted));
            }
        }
        let Some((_, first, wanted)) = pairs.first() else { return };
        let Some(slope) = crate::jacobians::derivative(*first, symbol.into()) else { return };
        if slope.symbols().contains(&symbol) || slope.is_zero() {
            return;
        }
        let should = (*wanted - with(*first, Expr::int(0))) / slope;
        let piece = Piece {
            statement: helper.statement,
            place: None,
            span: helper.span.clone(),
            syntax: Some(helper.syntax.clone()),
            value: helper.value,
            candidates: vec![],
            row: None,
            is_nameless: false,
            gears: vec![],
            symbol: None,
            uses: vec![],
        };
        let Some((_, slips, should)) = repairer.slips(&piece, should) else { return };
        if !pairs.iter().all(|(_, value, wanted)| equal(with(*value, should), *wanted).is_equal()) {
            return;
        }
        // What is right with the helper as it is printed stays so with the other, or the helper is not at fault.
        let is_kept = |k: usize| match value(k) {
            Some(e) if e.symbols().contains(&symbol) => {
                equal(with(e, should), read.pieces[k].value).is_equal()
            }
            _ => true,
        };
        if !(0..said.len()).filter(|&k| matches!(said[k], Some(Said::Right { .. }))).all(is_kept) {
            return;
        }
        for (pieces, ..) in &pairs {
            for &p in pieces {
                let truth = match read.pieces[p].candidates[..] {
                    [q] => self.model.value(q),
                    _ => None,
                };
                let value = read.pieces[p].value;
                let wanted = truth.unwrap_or(value);
                said[p] = Some(match equal(value, wanted) {
                    Equality::Equal { conditions } => {
                        Said::Right { identity: Some([value, wanted]), unless_zero: conditions }
                    }
                    _ => Said::Carried { by: By::Helper(h), wanted },
                });
            }
        }
        helpers.push((h, should, slips));
    }
}
