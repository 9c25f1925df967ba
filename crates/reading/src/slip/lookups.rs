//! What the lexicon has for the value that a part should have, for its quotient by the value printed, and for their
//! difference; and the same for runs of neighbours.

use super::changes::{SIGN, foreign};
use super::edit::Edit;
use super::field::{self, ONE, Value, ZERO};
use super::lexicon::{Entry, Lexicon};
use super::search::{Hit, Work};
use super::tree::{Kind, Needed, Tree};
use super::{Slip, changes};
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::rational::Rational;
use rustc_hash::FxHashSet;

/// The largest numerator and denominator of a number that is put in where none stood.
const MAX_NUMBER: i64 = 12;
/// Runs are no longer than this.
const MAX_RUN: usize = 6;
/// In sums and products of more parts no runs are tried.
const MAX_KIDS: usize = 60;

pub(super) struct Lookups<'a> {
    pub tree: &'a Tree,
    pub values: &'a [Value],
    pub needed: &'a [Needed],
    pub lexicon: &'a Lexicon,
    pub home: &'a FxHashSet<Expr>,
    pub hits: Vec<Hit>,
}

impl Lookups<'_> {
    fn hit(&mut self, cost: u32, slip: Slip, edit: Edit) {
        self.hits.push(Hit { cost, slips: vec![slip], edits: vec![edit] });
    }

    /// As above, with a sign of the term changed as well.
    fn hit_with_sign(&mut self, cost: u32, slip: Slip, edit: Edit, part: usize) {
        let flip = Edit::Flip(self.tree.term(part));
        self.hits.push(Hit { cost: cost + SIGN + 5, slips: vec![Slip::Sign, slip], edits: vec![flip, edit] });
    }

    fn foreign(&self, entry: &Entry) -> u32 {
        foreign(self.lexicon.expr(entry), self.home)
    }

    /// Looks up what one part should be.
    pub fn part(&mut self, part: usize, work: &mut Work) {
        let Some((n, d)) = self.needed[part] else { return };
        if !work.spend(4) {
            return;
        }
        let x = self.values[part];
        let Some(wanted) = field::reciprocal(&d).map(|i| field::product(&n, &i)) else { return };
        if wanted == x {
            return;
        }
        let kind = self.tree.parts[part].kind.clone();
        let parent = self.tree.parts[part].parent.map(|p| self.tree.parts[p].kind.clone());
        let is_whole = self.tree.is_whole(part);
        if let Kind::Leaf(e) = kind {
            self.number(part, e, &wanted);
        }
        if !matches!(kind, Kind::Bracket) || parent.is_none() {
            self.replaced(part, wanted);
        }
        // A lost factor shows at the whole product, a lost term at the whole sum.
        let is_product = match (&kind, &parent) {
            (Kind::Product(_), _) => true,
            (Kind::Sum(_), _) => is_whole,
            (_, Some(Kind::Product(places))) => places.contains(&true),
            (_, Some(Kind::Power(_))) => false,
            _ => true,
        };
        if is_product && !field::has_zero(&x) {
            self.factor(part, &kind, &x, &wanted);
        }
        if matches!(kind, Kind::Sum(_)) || is_whole {
            let missing = field::difference(&wanted, &x);
            if let Some((entry, is_minus)) = self.lexicon.lookup(missing) {
                // A bracket around a single term has lost another one.
                let base = if matches!(kind, Kind::Sum(_)) || parent.is_none() { 18 } else { 14 };
                let cost = base + 5 * entry.size() + self.foreign(entry);
                let entry = entry.clone();
                self.hit(cost, Slip::LostTerm, Edit::Term(part, entry, is_minus));
            } else if let Some((n, d)) = small(&missing) {
                let entry = Entry::Phrase(Rational::new(n.abs(), d).into(), 1);
                self.hit(26, Slip::LostTerm, Edit::Term(part, entry, n < 0));
            }
        }
    }

    fn number(&mut self, part: usize, e: Expr, wanted: &Value) {
        let Some(old) = e.as_number() else { return };
        let Some((n, d)) = field::as_fraction(wanted) else { return };
        let now = Rational::new(n.abs(), d);
        let is_factor =
            self.tree.place(part).is_some_and(|(p, _)| matches!(self.tree.parts[p].kind, Kind::Product(_)));
        // A factor 1 is not printed.
        if n == 0 || now == old || now.is_one() && is_factor {
            return;
        }
        let cost = 18 + 4 * u32::from(d != 1);
        match n < 0 {
            false => self.hit(cost, Slip::Number, Edit::Number(part, now)),
            true => self.hit_with_sign(cost, Slip::Number, Edit::Number(part, now), part),
        }
    }

    /// Something else that stands in the place of the part.
    fn replaced(&mut self, part: usize, wanted: Value) {
        let Some((parent, i)) = self.tree.place(part) else {
            // The whole formula is another one.
            if let Some((entry, is_minus)) = self.lexicon.lookup(wanted) {
                let cost = 25 + 10 * entry.size().max(self.tree.parts[part].size);
                let entry = entry.clone();
                self.hit(cost, Slip::Replaced, Edit::Whole(entry, is_minus));
            }
            return;
        };
        self.run_replaced(parent, i..i + 1, wanted, self.tree.parts[part].size);
    }

    fn run_replaced(&mut self, parent: usize, range: std::ops::Range<usize>, wanted: Value, size: u32) {
        let Some((entry, is_minus)) = self.lexicon.lookup(wanted) else { return };
        let first = self.tree.parts[parent].kids[range.start];
        let is_single = range.len() == 1;
        let own = if is_single { self.tree.leaf(first) } else { None };
        let single = self.lexicon.expr(entry);
        let (base, slip) = match (own, entry) {
            (Some(e), Entry::Product(atoms)) if atoms.len() == 1 => {
                (super::lexicon::distance(e, single), changes::replaced(e, single))
            }
            _ => (14 + 10 * entry.size().max(size), Slip::Replaced),
        };
        let cost = base + self.foreign(entry) + if is_minus { SIGN + 5 } else { 0 };
        let is_sum = matches!(self.tree.parts[parent].kind, Kind::Sum(_));
        let (slips, was_minus) = match &self.tree.parts[parent].kind {
            Kind::Sum(signs) => (vec![slip], signs[range.start]),
            _ => (vec![slip], false),
        };
        // The sign of a term stands before it; a run has the value with the sign.
        let minus = if is_sum && is_single { is_minus != was_minus } else { is_minus };
        let entry = entry.clone();
        self.hits.push(Hit { cost, slips, edits: vec![Edit::Replace(parent, range, entry, minus)] });
    }

    fn factor(&mut self, part: usize, kind: &Kind, x: &Value, wanted: &Value) {
        let outside = if matches!(kind, Kind::Sum(_)) { 12 } else { 0 };
        let Some(inverse) = field::reciprocal(x) else { return };
        let ratio = field::product(wanted, &inverse);
        if let Some((entry, is_minus)) = self.lexicon.lookup(ratio) {
            let cost = 13 + 7 * entry.size() + self.foreign(entry) + outside;
            let entry = entry.clone();
            let is_one = matches!(&entry, Entry::Product(atoms) if atoms.is_empty());
            match (is_one, is_minus) {
                (true, _) => {} // a sign: one of the small changes
                (false, false) => self.hit(cost, Slip::LostFactor, Edit::Factor(part, entry)),
                (false, true) => self.hit_with_sign(cost, Slip::LostFactor, Edit::Factor(part, entry), part),
            }
        } else if let Some((n, d)) = small(&ratio) {
            let number = |r: Rational| Entry::Phrase(r.into(), 1);
            let edit = match d {
                1 => Edit::Factor(part, number(Rational::from(n.abs()))),
                _ if n.abs() == 1 => Edit::Divisor(part, Rational::from(d).into()),
                _ => Edit::Factor(part, number(Rational::new(n.abs(), d))),
            };
            match n < 0 {
                false => self.hit(21 + outside, Slip::LostFactor, edit),
                true => self.hit_with_sign(21 + outside, Slip::LostFactor, edit, part),
            }
        } else if let Some((entry, false)) = field::reciprocal(&ratio).and_then(|r| self.lexicon.lookup(r))
            && let (1, e) = (entry.size(), self.lexicon.expr(entry))
            && matches!(e.node(), Node::Symbol(_) | Node::Sin(_) | Node::Cos(_))
        {
            let cost = 40 + self.foreign(entry) + outside;
            self.hit(cost, Slip::LostFactor, Edit::Divisor(part, e));
        }
    }

    /// Looks up what runs of neighbouring terms or factors should be.
    pub fn runs(&mut self, parent: usize, work: &mut Work) {
        let part = &self.tree.parts[parent];
        let count = part.kids.len();
        let Some((n, d)) = self.needed[parent] else { return };
        if !(3..=MAX_KIDS).contains(&count) {
            return;
        }
        for from in 0..count {
            for to in from + 2..=count.min(from + MAX_RUN) {
                if to - from == count || !work.spend(8 + count as u64) {
                    continue;
                }
                let kids = &part.kids;
                let size = kids[from..to].iter().map(|&k| self.tree.parts[k].size).sum::<u32>();
                let Some(wanted) = run_needed(self.tree, self.values, parent, from..to, (&n, &d)) else {
                    continue;
                };
                match (&part.kind, wanted == ONE, wanted == ZERO) {
                    (Kind::Product(_), true, _) => {
                        let edits = kids[from..to].iter().map(|&k| Edit::Delete(k)).collect();
                        self.hits.push(Hit { cost: 13 + 7 * size, slips: vec![Slip::ExtraFactor], edits });
                    }
                    (Kind::Sum(_), _, true) if from > 0 => {
                        let edits = kids[from..to].iter().map(|&k| Edit::Delete(k)).collect();
                        self.hits.push(Hit { cost: 20 + 3 * size, slips: vec![Slip::ExtraTerm], edits });
                    }
                    _ => self.run_replaced(parent, from..to, wanted, size),
                }
            }
        }
    }
}

/// The value that a run of factors or terms should have.
fn run_needed(
    tree: &Tree,
    values: &[Value],
    parent: usize,
    run: std::ops::Range<usize>,
    (n, d): (&Value, &Value),
) -> Option<Value> {
    let part = &tree.parts[parent];
    match &part.kind {
        Kind::Sum(signs) => {
            let rest = (0..part.kids.len()).filter(|i| !run.contains(i)).fold(ZERO, |s, i| {
                let x = &values[part.kids[i]];
                if signs[i] { field::difference(&s, x) } else { field::sum(&s, x) }
            });
            let whole = field::product(n, &field::reciprocal(d)?);
            Some(field::difference(&whole, &rest))
        }
        Kind::Product(places) if !places.contains(&true) => {
            let others = (0..part.kids.len()).filter(|i| !run.contains(i));
            let others = others.fold(ONE, |p, i| field::product(&p, &values[part.kids[i]]));
            Some(field::product(n, &field::reciprocal(&field::product(d, &others))?))
        }
        _ => None,
    }
}

fn small(value: &Value) -> Option<(i64, i64)> {
    field::as_fraction(value).filter(|&(n, d)| n != 0 && n.abs() <= MAX_NUMBER && d <= MAX_NUMBER)
}
