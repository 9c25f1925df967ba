//! Letters of their own for the rates of joints: `xdot = −s1 (…) u1 + c1 u2`. Which letter is which joint's rate is seen from a
//! velocity that is right with them; from then on, and in what stands before, they are these.

use super::{Scalar, Walk};
use crate::facts::Sense;
use crate::lexis::read;
use denavit_reading::document::Statement;
use denavit_reading::slip::Points;
use denavit_symbolic::{Expr, Symbol, equal};
use std::ops::Range;

/// More letters in one formula are none of rates.
const MAX_LETTERS: usize = 7;
/// More statements are not looked at again.
const MAX_WAITING: usize = 60;

/// A velocity in letters that are not known yet.
pub(super) struct Waiting {
    statement: Statement,
    subject: usize,
}

impl Walk<'_> {
    /// Looks for the rates behind the unknown letters of a velocity. True if they are found: then names are read anew.
    pub(super) fn finds_rates(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Broken(span, _)] = read else { return false };
        let wanted = left.value();
        if !self.subject.velocity().contains(&wanted) {
            return false;
        }
        let Some(found) = self.letters_of_rates(statement, span, wanted) else {
            if self.waiting.len() < MAX_WAITING {
                self.waiting.push(Waiting { statement: statement.clone(), subject: self.number });
            }
            return false;
        };
        let variables = self.subject.description.variables();
        let joint = |rate: &Expr| self.subject.rates().iter().position(|r| r == rate);
        let named = |(letter, rate): &(Symbol, Expr)| {
            Some([letter.name().to_string(), variables[joint(rate)?].symbol.name().to_string()])
        };
        let read_as = found.iter().filter_map(named).collect();
        self.rates_told = Some((statement.span.clone(), Sense::Rates(read_as)));
        for (letter, rate) in found {
            self.lexis.define(&letter.name(), rate);
        }
        self.cells.borrow_mut().clear();
        let (own, others) =
            std::mem::take(&mut self.waiting).into_iter().partition(|w| w.subject == self.number);
        self.waiting = others;
        let own: Vec<Waiting> = own;
        for before in own {
            let span = &before.statement.span;
            self.assertions.retain(|a| a.span != *span);
            self.skipped.retain(|s| s.0 != *span);
            self.scalars(&before.statement, None);
        }
        true
    }

    /// The rates for which the unknown letters of a formula stand if it is this velocity, where only one choice makes it so.
    fn letters_of_rates(
        &self,
        statement: &Statement,
        span: &Range<usize>,
        wanted: Expr,
    ) -> Option<Vec<(Symbol, Expr)>> {
        let rates = self.subject.rates();
        let open = self.lexis.names.clone().open(true);
        let printed = read(self.text, span, &open).ok()?.value();
        let d = &self.subject.description;
        let joints = self.subject.joints();
        let is_known = |s: &Symbol| {
            let e = Expr::from(*s);
            joints.contains(&e) || rates.contains(&e) || d.parameter(*s).is_some()
        };
        let is_rate = |s: &Symbol| rates.contains(&(*s).into());
        let symbols = printed.symbols();
        if symbols.iter().all(is_known) {
            return None;
        }
        // What is a rate already stands for itself.
        let letters: Vec<Symbol> = symbols.iter().copied().filter(|s| !is_known(s) || is_rate(s)).collect();
        if letters.len() > MAX_LETTERS.min(rates.len()) {
            return None;
        }
        let zero = Expr::int(0);
        let alone = |e: Expr, all: &[Expr], k: usize| {
            e.substitute(|s| all.iter().position(|a| *a == s.into()).map(|i| Expr::int(i64::from(i == k))))
        };
        let own: Vec<Expr> = letters.iter().map(|s| (*s).into()).collect();
        let mut points = Points::new(31);
        let none = points.value(zero);
        // Without rates nothing moves.
        if points.value(alone(printed, &own, usize::MAX)) != none {
            return None;
        }
        let printed_of: Vec<_> = (0..own.len()).map(|k| points.value(alone(printed, &own, k))).collect();
        let wanted_of: Vec<_> = (0..rates.len()).map(|j| points.value(alone(wanted, &rates, j))).collect();
        let is_itself = |k: usize, j: usize| !rates.contains(&own[k]) || rates[j] == own[k];
        let fits =
            |k: usize, j: usize| is_itself(k, j) && printed_of[k].is_some() && printed_of[k] == wanted_of[j];
        let mut choices: Vec<Vec<usize>> = vec![];
        choose(own.len(), rates.len(), &fits, &mut vec![], &mut choices);
        // Each other joint stands still, or does not move the hand that way.
        let is_alone = self.speaks_of_some_alone(statement);
        choices.retain(|c| is_alone || (0..rates.len()).all(|j| c.contains(&j) || wanted_of[j] == none));
        // `u2` is no other joint's: a formula that needs it as that has them exchanged.
        let number = |s: &Symbol| s.name().chars().next_back().and_then(|c| c.to_digit(10));
        choices.retain(|c| {
            letters.iter().zip(c).all(|(s, j)| is_rate(s) || number(s).is_none_or(|k| k as usize == j + 1))
        });
        let [choice] = &choices[..] else { return None };
        let found = letters.iter().zip(choice).filter(|(s, _)| !is_rate(s));
        let found: Vec<(Symbol, Expr)> = found.map(|(s, &j)| (*s, rates[j])).collect();
        let renamed = printed.substitute(|s| found.iter().find(|f| f.0 == s).map(|f| f.1));
        let moved = wanted.substitute(|s| {
            let j = rates.iter().position(|r| *r == s.into())?;
            (!choice.contains(&j)).then_some(zero)
        });
        equal(renamed, moved).is_equal().then_some(found)
    }
}

/// All ways to give each of so many letters a joint of its own that fits.
fn choose(
    letters: usize,
    joints: usize,
    fits: &dyn Fn(usize, usize) -> bool,
    taken: &mut Vec<usize>,
    found: &mut Vec<Vec<usize>>,
) {
    const MOST: usize = 100;
    let k = taken.len();
    if k == letters {
        found.push(taken.clone());
        return;
    }
    for j in (0..joints).filter(|j| fits(k, *j)) {
        if !taken.contains(&j) && found.len() < MOST {
            taken.push(j);
            choose(letters, joints, fits, taken, found);
            taken.pop();
        }
    }
}
