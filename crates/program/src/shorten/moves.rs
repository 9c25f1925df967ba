//! What may be saved, ordered by how much.

use super::net::{Net, Part, Term};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// A way to save operations.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Move {
    /// Take a factor out of a sum.
    Factor { sum: u32, factor: u32 },
    /// A value for two terms that several sums have, with equal signs or with opposite ones.
    Terms { first: u32, second: u32, is_sum: bool },
    /// A value for two factors that several products have.
    Factors(u32, u32),
}

/// What may be saved.
#[derive(Default)]
pub(super) struct Moves {
    /// By how much is saved, in ascending order. Of equal savings a factor comes first.
    ranked: BTreeMap<usize, Vec<Move>>,
    /// Where pairs stand.
    places: FxHashMap<Move, Vec<u32>>,
    /// The pairs of each value.
    pairs: Vec<Vec<Move>>,
    /// The factors of each sum, with their ranks.
    factors: Vec<Vec<(usize, Move)>>,
    /// Which values were read once.
    once: Vec<bool>,
}

/// Terms or factors up to which pairs of them are looked at.
const LONGEST: usize = 64;

impl Moves {
    /// Takes note of what has changed.
    pub fn refresh(&mut self, net: &mut Net) {
        self.pairs.resize(net.parts.len(), vec![]);
        self.factors.resize(net.parts.len(), vec![]);
        self.once.resize(net.parts.len(), false);
        let changes = net.changes();
        let mut stale = changes.clone();
        for &id in &changes {
            let pairs = pairs(net, id);
            if pairs != self.pairs[id as usize] {
                for pair in std::mem::replace(&mut self.pairs[id as usize], pairs.clone()) {
                    self.place(pair, |all| {
                        if let Ok(place) = all.binary_search(&id) {
                            all.remove(place);
                        }
                    });
                }
                for pair in pairs {
                    self.place(pair, |all| {
                        if let Err(place) = all.binary_search(&id) {
                            all.insert(place, id);
                        }
                    });
                }
            }
            // The factors of a sum are those of products that it alone reads.
            let is_once = net.is_used_once(id);
            if std::mem::replace(&mut self.once[id as usize], is_once) || is_once {
                stale.extend(net.readers(id));
            }
        }
        stale.sort_unstable();
        stale.dedup();
        for id in stale {
            net.visit();
            let factors = factors(net, id);
            for (rank, old) in std::mem::replace(&mut self.factors[id as usize], factors.clone()) {
                self.unrank(rank, old);
            }
            factors.into_iter().for_each(|(rank, new)| self.rank(rank, new));
        }
    }

    fn rank(&mut self, rank: usize, step: Move) {
        let equal = self.ranked.entry(rank).or_default();
        if let Err(place) = equal.binary_search(&step) {
            equal.insert(place, step);
        }
    }

    fn unrank(&mut self, rank: usize, step: Move) {
        let Some(equal) = self.ranked.get_mut(&rank) else { return };
        if let Ok(place) = equal.binary_search(&step) {
            equal.remove(place);
        }
        if equal.is_empty() {
            self.ranked.remove(&rank);
        }
    }

    fn place(&mut self, pair: Move, change: impl FnOnce(&mut Vec<u32>)) {
        let all = self.places.entry(pair).or_default();
        let before = all.len();
        change(all);
        let after = all.len();
        if after == 0 {
            self.places.remove(&pair);
        }
        if before > 1 {
            self.unrank(2 * (before - 1), pair);
        }
        if after > 1 {
            self.rank(2 * (after - 1), pair);
        }
    }

    /// One of those that save most, by a number.
    pub fn best(&self, number: u64) -> Option<Move> {
        let (_, equal) = self.ranked.last_key_value()?;
        equal.get((number % equal.len() as u64) as usize).copied()
    }

    pub fn apply(&self, step: Move, net: &mut Net) {
        match step {
            Move::Factor { sum, factor } => take_out(net, sum, factor),
            Move::Terms { first, second, is_sum } => {
                let places = self.places[&step].clone();
                let known = places.iter().copied().find(|&n| net.sum(n).is_some_and(|s| s.len() == 2));
                let sign = if is_sum { 1 } else { -1 };
                let pair = known.unwrap_or_else(|| net.new_sum(vec![(first, 1), (second, sign)]));
                let sign_in = |terms: &[Term]| terms.iter().find(|t| t.id == first).map_or(1, Term::sign);
                let own = net.sum(pair).map_or(1, sign_in);
                for n in places.into_iter().filter(|&n| n != pair) {
                    let terms = net.sum(n).unwrap_or_default();
                    let rest = terms.iter().filter(|t| t.id != first && t.id != second);
                    let mut all: Vec<(u32, i64)> = rest.map(|t| (t.id, t.sign())).collect();
                    all.push((pair, own * sign_in(terms)));
                    net.set_sum(n, all);
                }
            }
            Move::Factors(first, second) => {
                let places = self.places[&step].clone();
                let known = places.iter().copied().find(|&n| net.product(n).is_some_and(|p| p.len() == 2));
                let pair = known.unwrap_or_else(|| net.new_product(vec![first, second]));
                for n in places.into_iter().filter(|&n| n != pair) {
                    let mut factors = net.product(n).unwrap_or_default().to_vec();
                    for f in [first, second] {
                        if let Some(place) = factors.iter().position(|g| *g == f) {
                            factors.remove(place);
                        }
                    }
                    factors.push(pair);
                    net.set_product(n, factors);
                }
            }
        }
    }
}

/// The pairs of terms or factors of a value, of which one at least varies.
fn pairs(net: &Net, id: u32) -> Vec<Move> {
    if !net.varies(id) {
        return vec![];
    }
    let mut all = vec![];
    match &net.parts[id as usize] {
        Part::Sum(terms) if terms.len() <= LONGEST => {
            for (i, a) in terms.iter().enumerate() {
                for b in &terms[i + 1..] {
                    if net.varies(a.id) || net.varies(b.id) {
                        all.push(Move::Terms { first: a.id, second: b.id, is_sum: a.negative == b.negative });
                    }
                }
            }
        }
        Part::Product(factors) if factors.len() <= LONGEST => {
            for (i, a) in factors.iter().enumerate() {
                for b in &factors[i + 1..] {
                    if net.varies(*a) || net.varies(*b) {
                        all.push(Move::Factors(*a, *b));
                    }
                }
            }
            all.sort_unstable();
            all.dedup();
        }
        _ => {}
    }
    all
}

/// The products among a sum's terms that are read here alone, by their factors.
fn by_factor(net: &Net, terms: &[Term]) -> Vec<(u32, Term)> {
    let mut all: Vec<(u32, Term)> = vec![];
    for t in terms.iter().filter(|t| net.is_used_once(t.id)) {
        all.extend(net.product(t.id).unwrap_or_default().iter().map(|&f| (f, *t)));
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// The factors that may be taken out of a sum, with what that saves: twice the operations, and one.
fn factors(net: &Net, id: u32) -> Vec<(usize, Move)> {
    let Some(terms) = net.sum(id).filter(|_| net.varies(id)) else { return vec![] };
    let factors = |t: &Term| net.product(t.id).unwrap_or_default();
    let constants = |t: &Term| factors(t).iter().filter(|&&f| !net.varies(f)).count();
    let mut all = vec![];
    for products in by_factor(net, terms).chunk_by(|a, b| a.0 == b.0).filter(|c| c.len() > 1) {
        let factor = products[0].0;
        // A constant may be one with others that are constant.
        let is_saved = net.varies(factor) || products.iter().all(|(_, t)| constants(t) == 1);
        let mut saved = if is_saved { products.len() - 1 } else { 0 };
        // What is left of products without variables is added beforehand.
        let is_rest = |t: &Term| net.varies(factor) && factors(t).len() == constants(t) + 1;
        let is_term = usize::from(terms.binary_search_by_key(&factor, |t| t.id).is_ok());
        let constant = products.iter().filter(|(_, t)| is_rest(t)).count() + is_term;
        saved += constant.saturating_sub(1);
        if saved > 0 {
            all.push((2 * saved + 1, Move::Factor { sum: id, factor }));
        }
    }
    all
}

fn take_out(net: &mut Net, id: u32, factor: u32) {
    let terms = net.sum(id).unwrap_or_default().to_vec();
    let all = by_factor(net, &terms);
    let products: Vec<Term> = all.iter().filter(|(f, _)| *f == factor).map(|(_, t)| *t).collect();
    let mut inside: Vec<(u32, i64)> = vec![];
    for t in &products {
        let mut rest = net.product(t.id).unwrap_or_default().to_vec();
        if let Some(place) = rest.iter().position(|f| *f == factor) {
            rest.remove(place);
        }
        let rest = match rest[..] {
            [] => net.number(1),
            [one] => one,
            _ => net.new_product(rest),
        };
        inside.push((rest, t.sign()));
    }
    if let Some(own) = terms.iter().find(|t| t.id == factor) {
        inside.push((net.number(1), own.sign()));
    }
    let is_inside = |t: &Term| t.id == factor || products.binary_search(t).is_ok();
    let mut all: Vec<(u32, i64)> = terms.iter().filter(|t| !is_inside(t)).map(|t| (t.id, t.sign())).collect();
    let sum = net.new_sum(inside);
    let sum = net.shared(sum);
    let product = net.new_product(vec![factor, sum]);
    all.push((product, 1));
    net.set_sum(id, all);
}
