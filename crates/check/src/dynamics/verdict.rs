//! The verdict on each formula of dynamics: proved by the robot's own, refuted with the slip in it, carried from what is wrong before it, or
//! left open where nothing says how it is meant.

use super::attempt::Attempt;
use super::author::Author;
use super::model::Model;
use super::quantity::Quantity;
use super::repair::Repairer;
use super::statements::Piece;
use super::told;
use super::vote::{agree, values};
use crate::facts::{SlipKind, Unproved};
use crate::formula::Formula;
use crate::judge::counterexample;
use crate::outcome::{Entry, Finding, Slip, Wrong};
use crate::subject::Subject;
use crate::tools::edge;
use denavit_reading::document::Statement;
use denavit_symbolic::readable::literals;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, Rational, Symbol, equal};
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
/// No more of the text before a formula is looked at.
const MAX_WORDS: usize = 250;
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

pub(super) struct Verdicts<'a> {
    pub(super) text: &'a str,
    statements: &'a [Statement],
    subject: &'a Subject,
    pub(super) attempt: &'a Attempt,
    pub(super) model: Model,
    /// The formulas that were refuted so far.
    refuted: Cell<usize>,
}

/// How a test fared in the readings that are as good as the best.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Fared {
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
            if self.attempt.is_disputed(&piece.span) || self.attempt.is_measured && !self.is_supported(test) {
                said[k] = Some(Said::Open(Unproved::OpenReading));
                continue;
            }
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
        for h in (0..read.helpers.len()).filter(|_| !self.attempt.is_open()) {
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

    pub(super) fn fared(&self, test: usize) -> Fared {
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
    pub(super) fn compared(&self, value: Expr, wanted: Expr, quantity: Quantity) -> (Expr, Equality) {
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
    pub(super) fn is_pinned(&self, test: usize) -> bool {
        let best = &self.attempt.vote.best;
        let Some(&quantity) = self.attempt.tests[test].candidates.first() else { return false };
        !self.attempt.vote.is_many
            && best.iter().all(|b| agree(&b.wanted[test], &best[0].wanted[test], quantity))
    }

    /// What the readings that are as good want of a quantity, each once.
    fn all_wanted(&self, test: usize, quantity: Quantity) -> Vec<Expr> {
        let best = &self.attempt.vote.best;
        let first = quantity;
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
        if self.fared(test) == Fared::Either
            && let Some(&of) = self.attempt.vote.against.first()
        {
            return Said::Open(Unproved::AgainstWords(of));
        }
        if self.fared(test) == Fared::Either
            || self.attempt.score() == 0 && !self.attempt.is_given
            || self.attempt.is_cut()
        {
            return Said::Open(Unproved::OpenReading);
        }
        if piece.is_nameless
            || self.has_lone_gear(k)
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
        if let Some((by, wanted)) = self.rests_on(piece, said) {
            return Said::Carried { by: By::Piece(by), wanted };
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
        // Printed right elsewhere, or behind words that say so, it may be meant for a special case, unless it is a small slip away.
        let is_case = !piece.gears.is_empty()
            || self.is_right_elsewhere(k, test)
            || told::is_special_case(&self.words_around(piece));
        match best {
            Some((_, _, slips)) if is_case && !slips.iter().all(is_small) => {
                Said::Open(Unproved::OpenReading)
            }
            None if is_case => Said::Open(Unproved::OpenReading),
            // There is no slip to show where nothing should stand.
            Some((_, wanted, _)) if wanted.is_zero() => Said::Wrong { wanted, slips: vec![] },
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

    /// True for a formula with the ratio of a gear that no other has which is right: what it is the ratio of is open.
    fn has_lone_gear(&self, k: usize) -> bool {
        let (read, right) = (&self.attempt.read, &self.attempt.vote.best[0].right);
        let others = || {
            let all = read.pieces.iter().zip(&self.attempt.test_of_piece).enumerate();
            all.filter(move |(i, (_, test))| *i != k && test.is_some_and(|t| right[t])).map(|(_, (p, _))| p)
        };
        read.pieces[k].gears.iter().any(|gear| !others().any(|p| p.gears.contains(gear)))
    }

    /// The words before a formula, on its line and up to the formula on a line before it, and behind it on its line.
    fn words_around(&self, piece: &Piece) -> String {
        let own = &self.statements[piece.statement].span;
        let line = self.text.get(..own.start).and_then(|before| before.rfind('\n')).unwrap_or(0);
        let ends = self.statements.iter().map(|s| s.span.end).filter(|end| *end <= line);
        let first = ends.max().unwrap_or(0).max(own.start.saturating_sub(MAX_WORDS));
        let first = edge(self.text, first);
        let behind = self.text.get(own.end..).and_then(|rest| rest.lines().next()).unwrap_or("");
        let behind: String = behind.chars().take(MAX_WORDS).collect();
        format!("{} {behind}", self.text.get(first..own.start).unwrap_or(""))
    }

    /// True where the document prints the same quantity again, right.
    fn is_right_elsewhere(&self, k: usize, test: usize) -> bool {
        let read = &self.attempt.read;
        let right = &self.attempt.vote.best[0].right;
        let mut others = read.pieces.iter().zip(&self.attempt.test_of_piece);
        others.any(|(p, t)| {
            t.is_some_and(|t| t != test && right[t]) && p.candidates == read.pieces[k].candidates
        })
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
        let is_twice = self.is_right_elsewhere(k, test);
        let mut kin =
            others.iter().filter(|(_, t)| vote.links[*t].iter().any(|l| vote.links[test].contains(l)));
        let is_apart = kin.all(|(p, _)| heading(p) != heading(piece));
        (is_twice || is_apart) && self.attempt.is_right_alone(test)
    }

    /// True for a formula with names that mean nothing as the document is read: friction, equal masses, another arm.
    fn has_foreign(&self, piece: &Piece) -> bool {
        let attempt = self.attempt;
        let reading = &attempt.vote.best[0];
        let mut known: Vec<Symbol> = attempt.gravities.iter().flatten().flat_map(|e| e.symbols()).collect();
        for (k, all) in reading.bodies.iter().zip(&attempt.candidates.bodies) {
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

    /// True for what is right in a special case that is not spoken of here: without gravity or at rest, where no torque of the document and nothing
    /// of its kind has gravity or rates; with a joint at a right angle that does not occur.
    fn is_special(&self, piece: &Piece) -> bool {
        let &[quantity] = &piece.candidates[..] else { return false };
        let Some(wanted) = self.model.value(quantity) else { return false };
        let (printed, right) = (piece.value.symbols(), wanted.symbols());
        let state = &self.model.state;
        let gravity: Vec<Symbol> =
            self.attempt.gravities.iter().flatten().flat_map(|e| e.symbols()).collect();
        // Torques, and others of its kind: `V_2 = 0` below `V_1` with its rates.
        let is_kin = |q: &Quantity| {
            matches!(q, Quantity::Torque(_)) || std::mem::discriminant(q) == std::mem::discriminant(&quantity)
        };
        let kin = self.attempt.read.pieces.iter().filter(|p| matches!(&p.candidates[..], [q] if is_kin(q)));
        let spoken: Vec<Symbol> = kin.flat_map(|p| p.value.symbols()).collect();
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
        // Multiples of 15°, in numbers.
        let is_fixed = |q: &Symbol| {
            let printed = values(piece.value, state);
            (-11..=12).any(|k| {
                let angle = Expr::pi() * Expr::from(Rational::new(k, 12));
                let held = values(still.substitute(|s| (s == *q).then_some(angle)), state);
                matches!((printed, held), (Some(a), Some(b)) if agree(&a, &b, quantity))
            })
        };
        // A zero among formulas in which the joint moves is meant for all its values, and so is what stands beside another of its kind
        // that is right for all of them, unless the words between are about a case.
        let read = &self.attempt.read;
        let right_kin: Vec<Symbol> = read
            .pieces
            .iter()
            .zip(&self.attempt.test_of_piece)
            .filter(|(p, t)| {
                let is_of_kind = matches!(&p.candidates[..], [q] if std::mem::discriminant(q) == std::mem::discriminant(&quantity));
                is_of_kind && t.is_some_and(|t| self.attempt.vote.best[0].right[t])
            })
            .flat_map(|(p, _)| p.value.symbols())
            .collect();
        let is_case = told::is_case(&self.words_around(piece));
        let is_meant =
            |q: &&Symbol| !(piece.value.is_zero() && spoken.contains(q) || !is_case && right_kin.contains(q));
        state.q.iter().filter(|q| !printed.contains(q) && right.contains(q)).filter(is_meant).any(is_fixed)
    }
}

/// True for a slip that does not make a formula that of a special case.
fn is_small(slip: &Slip) -> bool {
    use denavit_reading::slip::Slip as Kind;
    let is_small = |kind: &Kind| {
        matches!(
            kind,
            Kind::Sign | Kind::SineForCosine | Kind::Index | Kind::Exponent | Kind::Bracket | Kind::Exchanged
        )
    };
    matches!(&slip.kind, SlipKind::Formula(kind) if is_small(kind))
}

/// The pieces that are wrong so far.
pub(super) fn wrongs(said: &[Option<Said>]) -> Vec<Option<usize>> {
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
