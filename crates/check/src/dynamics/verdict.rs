//! The verdict on each formula of dynamics: proved by the robot's own, refuted with the slip in it, carried from what is wrong before it, or
//! left open where nothing says how it is meant.

use super::attempt::Attempt;
use super::author::Author;
use super::model::Model;
use super::quantity::Quantity;
use super::repair::Repairer;
use super::statements::Piece;
use super::vote::agree;
use crate::facts::Unproved;
use crate::formula::Formula;
use crate::judge::counterexample;
use crate::outcome::{Entry, Finding, Slip, Wrong};
use crate::subject::Subject;
use denavit_reading::document::Statement;
use denavit_symbolic::readable::literals;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, Symbol, equal};
use std::cell::Cell;
use std::rc::Rc;

/// What is said of a piece.
pub(super) enum Said {
    Right {
        identity: Option<[Expr; 2]>,
        unless_zero: Vec<Expr>,
    },
    Wrong {
        wanted: Expr,
        slips: Vec<Slip>,
    },
    /// Wrong, and right given what another piece, or a helper, has wrong.
    Carried {
        by: By,
        wanted: Expr,
    },
    Open(Unproved),
}

/// What is wrong before.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum By {
    Piece(usize),
    Helper(usize),
}

/// No more formulas are refuted.
const MAX_REFUTED: usize = 60;
/// No more readings are asked for a slip.
const MAX_READINGS: usize = 6;
/// No formula with more literals is shown.
const MAX_SHOWN: u64 = 300;

/// A helper that is wrong, by its number, with what it should be and the slips that explain it.
pub(super) type WrongHelper = (usize, Expr, Vec<Slip>);

/// Judges the pieces of an attempt; and of helpers those that are wrong, with what they should be.
pub(super) fn verdicts(
    text: &str,
    statements: &[Statement],
    subject: &Subject,
    attempt: &Attempt,
) -> Option<(Vec<Said>, Vec<WrongHelper>)> {
    let model = attempt.model(subject, 0)?;
    let judge = Verdicts { text, statements, subject, attempt, model, refuted: Cell::new(0) };
    Some(judge.all())
}

struct Verdicts<'a> {
    text: &'a str,
    statements: &'a [Statement],
    subject: &'a Subject,
    attempt: &'a Attempt,
    model: Model,
    /// The formulas that were refuted so far.
    refuted: Cell<usize>,
}

/// How a test fared in the readings that are as good as the best.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fared {
    Right,
    Wrong,
    Either,
}

impl Verdicts<'_> {
    fn all(&self) -> (Vec<Said>, Vec<WrongHelper>) {
        let read = &self.attempt.read;
        let mut said: Vec<Option<Said>> = read.pieces.iter().map(|_| None).collect();
        let mut repairer = Repairer::new(self.text, self.subject, read, &self.model.state);
        for (k, piece) in read.pieces.iter().enumerate() {
            let Some(test) = self.attempt.test_of_piece[k] else { continue };
            if self.fared(test) == Fared::Right {
                let found = self.proved(piece);
                if let Said::Right { .. } = found {
                    repairer.learn(piece);
                }
                said[k] = Some(found);
            }
        }
        for (r, row) in read.rows.iter().enumerate() {
            if self.fared(self.attempt.test_of_row[r]) == Fared::Right {
                let wanted = self.model.value(Quantity::Velocity(row.joint));
                let proof = wanted.map(|w| (w, equal(row.value, w)));
                for &p in &row.pieces {
                    said[p] = Some(match &proof {
                        Some((w, Equality::Equal { conditions })) => {
                            Said::Right { identity: Some([row.value, *w]), unless_zero: conditions.clone() }
                        }
                        _ => Said::Open(Unproved::NotFound),
                    });
                    repairer.learn(&read.pieces[p]);
                }
            }
        }
        // A helper at fault explains what uses it.
        let mut helpers: Vec<(usize, Expr, Vec<Slip>)> = vec![];
        for h in 0..read.helpers.len() {
            self.helper(h, &mut said, &mut helpers, &mut repairer);
        }
        let author = Author::new(&self.model, read);
        for k in 0..said.len() {
            if said[k].is_some() {
                continue;
            }
            match read.pieces[k].row {
                Some(r) => self.row(r, &mut said, &mut repairer, &author),
                None => said[k] = Some(self.refuted(k, &said, &mut repairer, &author)),
            }
        }
        let open = || Said::Open(Unproved::NotFound);
        (said.into_iter().map(|s| s.unwrap_or_else(open)).collect(), helpers)
    }

    fn fared(&self, test: usize) -> Fared {
        let best = &self.attempt.vote.best;
        let right = best.iter().filter(|b| b.right[test]).count();
        match right {
            0 => Fared::Wrong,
            _ if right == best.len() => Fared::Right,
            _ => Fared::Either,
        }
    }

    /// What is right in the numbers of the vote, by proof.
    fn proved(&self, piece: &Piece) -> Said {
        for &quantity in &piece.candidates {
            let Some(wanted) = self.model.value(quantity) else { continue };
            let (wanted, found) = self.compared(piece.value, wanted, quantity);
            if let Equality::Equal { conditions } = found {
                return Said::Right { identity: Some([piece.value, wanted]), unless_zero: conditions };
            }
        }
        Said::Open(Unproved::NotFound)
    }

    /// Whether a formula is what is wanted; energies may differ by a constant, which is added.
    fn compared(&self, value: Expr, wanted: Expr, quantity: Quantity) -> (Expr, Equality) {
        let wanted = match quantity.is_up_to_constant() {
            true => wanted + self.at_rest(value - wanted),
            false => wanted,
        };
        (wanted, equal(value, wanted))
    }

    fn at_rest(&self, e: Expr) -> Expr {
        let s = &self.model.state;
        e.substitute(|x| (s.q.contains(&x) || s.qd.contains(&x)).then(|| Expr::int(0)))
    }

    /// True if all readings that are as good want the same of a test.
    fn is_pinned(&self, test: usize) -> bool {
        let best = &self.attempt.vote.best;
        let quantity = self.attempt.tests[test].candidates[0];
        best.iter().all(|b| agree(&b.wanted[test], &best[0].wanted[test], quantity))
    }

    /// What the readings that are as good want of a quantity, each once.
    fn all_wanted(&self, test: usize, quantity: Quantity) -> Vec<Expr> {
        let best = &self.attempt.vote.best;
        let first = self.attempt.tests[test].candidates[0];
        let mut seen: Vec<usize> = vec![];
        for k in 0..best.len() {
            if seen.len() < MAX_READINGS
                && !seen.iter().any(|&s| agree(&best[s].wanted[test], &best[k].wanted[test], first))
            {
                seen.push(k);
            }
        }
        let of = |k: usize| match k {
            0 => self.model.value(quantity),
            _ => self.attempt.model(self.subject, k)?.value(quantity),
        };
        seen.into_iter().filter_map(of).collect()
    }

    /// True if other formulas bear out how the links are read on which a test depends.
    fn is_supported(&self, test: usize) -> bool {
        let vote = &self.attempt.vote;
        let best = &vote.best[0];
        let bears = |link: &usize| {
            let right = (0..best.right.len()).filter(|&t| t != test && best.right[t]);
            right.into_iter().any(|t| vote.links[t].contains(link))
        };
        self.attempt.is_given || vote.links[test].iter().all(bears)
    }

    /// A piece that is wrong in some or all readings.
    fn refuted(&self, k: usize, said: &[Option<Said>], repairer: &mut Repairer, author: &Author) -> Said {
        let piece = &self.attempt.read.pieces[k];
        let Some(test) = self.attempt.test_of_piece[k] else { return Said::Open(Unproved::NotFound) };
        self.refuted.set(self.refuted.get() + 1);
        if self.refuted.get() > MAX_REFUTED {
            return Said::Open(Unproved::NotFound);
        }
        if self.fared(test) == Fared::Either || !self.attempt.vote.is_any_right && !self.attempt.is_given {
            return Said::Open(Unproved::OpenReading);
        }
        if piece.is_nameless
            || self.has_foreign(piece)
            || self.has_damping(piece)
            || self.is_special(piece)
            || self.is_elsewhere(k, test)
        {
            return Said::Open(Unproved::OpenReading);
        }
        let wrong = wrongs(said);
        for &quantity in &piece.candidates {
            let by = author.wants(quantity, k, &wrong).into_iter().find_map(|(wanted, by)| {
                self.compared(piece.value, wanted, quantity).1.is_equal().then_some(by)
            });
            if let (Some(by), Some(truth)) = (by, self.model.value(quantity)) {
                return Said::Carried { by: By::Piece(by), wanted: truth };
            }
        }
        let is_pinned = self.is_pinned(test) && self.is_supported(test);
        let mut best: Option<(u32, Expr, Vec<Slip>)> = None;
        for &quantity in &piece.candidates {
            for wanted in self.all_wanted(test, quantity) {
                let (wanted, _) = self.compared(piece.value, wanted, quantity);
                let found = repairer.slips(piece, wanted);
                if let Some((cost, slips, _)) = found
                    && best.as_ref().is_none_or(|b| cost < b.0)
                {
                    best = Some((cost, wanted, slips));
                }
            }
        }
        match best {
            Some((_, wanted, slips)) => Said::Wrong { wanted, slips },
            None if is_pinned && piece.candidates.len() == 1 => match self.model.value(piece.candidates[0]) {
                Some(wanted) => {
                    let (wanted, _) = self.compared(piece.value, wanted, piece.candidates[0]);
                    Said::Wrong { wanted, slips: vec![] }
                }
                None => Said::Open(Unproved::OpenReading),
            },
            None => Said::Open(Unproved::OpenReading),
        }
    }

    /// True for what is right of other bodies, where the document may have turned to such: it prints the same quantity twice, or a heading
    /// stands between.
    fn is_elsewhere(&self, k: usize, test: usize) -> bool {
        let (read, vote) = (&self.attempt.read, &self.attempt.vote);
        let piece = &read.pieces[k];
        let heading = |p: &Piece| self.statements[p.statement].heading.clone();
        let others: Vec<(&Piece, usize)> = read
            .pieces
            .iter()
            .zip(&self.attempt.test_of_piece)
            .filter_map(|(p, t)| Some((p, (*t)?)))
            .filter(|(_, t)| *t != test && vote.best[0].right[*t])
            .collect();
        let is_twice = others.iter().any(|(p, _)| p.candidates == piece.candidates);
        let mut kin =
            others.iter().filter(|(_, t)| vote.links[*t].iter().any(|l| vote.links[test].contains(l)));
        let is_apart = kin.all(|(p, _)| heading(p) != heading(piece));
        (is_twice || is_apart) && !self.attempt.right_alone(self.subject, &[test]).is_empty()
    }

    /// True for a formula with names that mean nothing as the document is read: friction, equal masses, another arm.
    fn has_foreign(&self, piece: &Piece) -> bool {
        let attempt = self.attempt;
        let reading = &attempt.vote.best[0];
        let mut known: Vec<Symbol> = attempt.gravities.iter().flatten().flat_map(|e| e.symbols()).collect();
        for (k, all) in reading.bodies.iter().zip(&attempt.bodies) {
            known.extend(all[*k].iter().flat_map(|e| e.symbols()));
        }
        known.extend(self.subject.description.parameters.iter().map(|p| p.symbol));
        let state = &self.model.state;
        known.extend(state.q.iter().chain(&state.qd).chain(&state.qdd));
        piece.value.symbols().iter().any(|s| !known.contains(s))
    }

    /// True for a formula with a coefficient of damping: what it stands in changes its sign with the rates, which nothing does in the
    /// equations of bodies.
    fn has_damping(&self, piece: &Piece) -> bool {
        let state = &self.model.state;
        let symbols = piece.value.symbols();
        let backwards = |e: Expr| e.substitute(|s| state.qd.contains(&s).then(|| -Expr::from(s)));
        let is_damping = |s: &Symbol| {
            let without = piece.value.substitute(|x| (x == *s).then(|| Expr::int(0)));
            let part = piece.value - without;
            !equal(part, Expr::int(0)).is_equal() && equal(part, -backwards(part)).is_equal()
        };
        let moves = |s: &&Symbol| [&state.q, &state.qd, &state.qdd].iter().any(|all| all.contains(s));
        let is_own = |s: &&Symbol| self.subject.description.parameters.iter().any(|p| p.symbol == **s);
        let has_rates = symbols.iter().any(|s| state.qd.contains(s));
        let is_even =
            !matches!(piece.candidates.first(), Some(Quantity::Momentum(_) | Quantity::CoriolisEntry(..)));
        has_rates && is_even && symbols.iter().filter(|s| !moves(s) && !is_own(s)).any(is_damping)
    }

    /// True for what is right in a special case that is not spoken of here: without gravity or at rest, where no torque of the document has
    /// gravity or rates; with a joint at a right angle that does not occur.
    fn is_special(&self, piece: &Piece) -> bool {
        let &[quantity] = &piece.candidates[..] else { return false };
        let Some(wanted) = self.model.value(quantity) else { return false };
        let (printed, right) = (piece.value.symbols(), wanted.symbols());
        let state = &self.model.state;
        let gravity: Vec<Symbol> =
            self.attempt.gravities.iter().flatten().flat_map(|e| e.symbols()).collect();
        let torques =
            self.attempt.read.pieces.iter().filter(|p| matches!(p.candidates[..], [Quantity::Torque(_)]));
        let spoken: Vec<Symbol> = torques.flat_map(|p| p.value.symbols()).collect();
        let mut zero: Vec<Symbol> = vec![];
        for group in [&gravity, &state.qd, &state.qdd] {
            let is_missing =
                !group.iter().any(|s| printed.contains(s)) && group.iter().any(|s| right.contains(s));
            if is_missing && !group.iter().any(|s| spoken.contains(s)) {
                zero.extend(group.iter().copied());
            }
        }
        let still = wanted.substitute(|s| zero.contains(&s).then(|| Expr::int(0)));
        if !zero.is_empty() && equal(piece.value, still).is_equal() {
            return true;
        }
        let quarter = Expr::pi() / Expr::int(2);
        let is_fixed = |q: &Symbol| {
            let values = [Expr::int(0), quarter, -quarter, Expr::pi()];
            values
                .into_iter()
                .any(|v| equal(piece.value, still.substitute(|s| (s == *q).then_some(v))).is_equal())
        };
        state.q.iter().filter(|q| !printed.contains(q) && right.contains(q)).any(is_fixed)
    }

    /// A row of C that does not give the velocity torque.
    fn row(&self, r: usize, said: &mut [Option<Said>], repairer: &mut Repairer, author: &Author) {
        let read = &self.attempt.read;
        let (row, test) = (&read.rows[r], self.attempt.test_of_row[r]);
        let n = row.pieces.len();
        let is_open = self.fared(test) == Fared::Either
            || !self.attempt.vote.is_any_right && !self.attempt.is_given
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
            if equal(value, truth[j]).is_equal() {
                said[p] = Some(Said::Right { identity: Some([value, truth[j]]), unless_zero: vec![] });
            } else {
                off.push(j);
            }
        }
        // One entry that makes the row right, if the others are as printed; or each by its own symbol.
        let mut best: Option<(u32, usize, Expr, Vec<Slip>)> = None;
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
                && best.as_ref().is_none_or(|b| cost < b.0)
            {
                best = Some((cost, j, value, slips));
            }
            if let Some((cost, slips, _)) = repairer.slips(&read.pieces[p], truth[j]) {
                each.push((cost, j, slips));
            }
        }
        let all: u32 = each.iter().map(|e| e.0).sum();
        if each.len() == off.len() && best.as_ref().is_none_or(|b| all <= b.0) {
            for (_, j, slips) in each {
                said[row.pieces[j]] = Some(Said::Wrong { wanted: truth[j], slips });
            }
            return;
        }
        if let Some((_, at, wanted, slips)) = best {
            said[row.pieces[at]] = Some(Said::Wrong { wanted, slips });
            for &j in off.iter().filter(|j| **j != at) {
                // Right with the others as they should be.
                said[row.pieces[j]] = Some(Said::Right { identity: None, unless_zero: vec![] });
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

    /// Blames a helper if one change of it makes all right that is wrong and uses it.
    fn helper(
        &self,
        h: usize,
        said: &mut [Option<Said>],
        helpers: &mut Vec<(usize, Expr, Vec<Slip>)>,
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
        };
        let Some((_, slips, should)) = repairer.slips(&piece, should) else { return };
        if !pairs.iter().all(|(_, value, wanted)| equal(with(*value, should), *wanted).is_equal()) {
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

/// The pieces that are wrong so far.
fn wrongs(said: &[Option<Said>]) -> Vec<Option<usize>> {
    let of = |(k, s): (usize, &Option<Said>)| match s {
        Some(Said::Wrong { .. }) => Some(k),
        Some(Said::Carried { by: By::Piece(by), .. }) => Some(*by),
        _ => None,
    };
    said.iter().enumerate().map(of).collect()
}

/// The entry of a claim for a piece. `claim_of` numbers the claims of pieces and helpers.
pub(super) fn entry(
    piece: &Piece,
    said: &Said,
    subject: &Subject,
    names: &Rc<Vocabulary>,
    claim_of: &dyn Fn(By) -> usize,
) -> Entry {
    let mut identities = vec![];
    let finding = match said {
        Said::Right { identity, unless_zero } => {
            identities.extend(*identity);
            Finding::Equal { unless_zero: unless_zero.iter().map(|e| Formula::new(*e, names)).collect() }
        }
        Said::Open(why) => Finding::Undecided { why: *why },
        Said::Carried { by, wanted } => {
            let correct = shown(*wanted, names).iter().map(ToString::to_string).collect();
            Finding::Carried { by: claim_of(*by), correct }
        }
        Said::Wrong { wanted, slips } => {
            Finding::Wrong(Box::new(wrong(piece.value, *wanted, slips, subject, names)))
        }
    };
    Entry { place: piece.place, span: piece.span.clone(), finding, identities }
}

pub(super) fn wrong(
    value: Expr,
    wanted: Expr,
    slips: &[Slip],
    subject: &Subject,
    names: &Rc<Vocabulary>,
) -> Wrong {
    let mut slips = slips.iter().cloned();
    let slip = slips.next();
    let correct = match &slip {
        Some(slip) => vec![slip.formula.clone()],
        None => shown(wanted, names).iter().map(ToString::to_string).collect(),
    };
    Wrong {
        correct,
        slip,
        rivals: slips.collect(),
        difference: shown(value - wanted, names),
        counterexample: counterexample(value, wanted, subject),
        ..Wrong::default()
    }
}

/// A formula simplified, unless it is too long to be shown.
fn shown(e: Expr, names: &Rc<Vocabulary>) -> Option<Formula> {
    if literals(e) > 20 * MAX_SHOWN {
        return None;
    }
    let simple = denavit_symbolic::readable::simplify(e, &e.symbols()).ok()?.expr;
    (literals(simple) <= MAX_SHOWN).then(|| Formula::new(simple, names))
}
