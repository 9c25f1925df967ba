//! A program as sums and products of any number of values.

use crate::graph::{Op, Stage};
use crate::program::Program;
use denavit_symbolic::Rational;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;

/// A term of a sum.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Term {
    pub id: u32,
    pub negative: bool,
}

/// What a value is.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Part {
    /// An operation of the program as it is.
    Kept,
    /// A number that the program has not.
    Number(Rational),
    /// Terms in ascending order, each once.
    Sum(Vec<Term>),
    /// Factors in ascending order, powers as often as they count.
    Product(Vec<u32>),
    /// Nobody reads it.
    Gone,
}

/// The values, by their numbers: those of the program's operations, then others.
pub(super) struct Net {
    pub parts: Vec<Part>,
    stages: Vec<Stage>,
    uses: Vec<u32>,
    /// What the operations that are kept read.
    kept: Vec<Vec<u32>>,
    /// Who reads a value.
    readers: Vec<FxHashSet<u32>>,
    numbers: FxHashMap<i64, u32>,
    /// What has become otherwise, or is read more or less often, since [`Net::changes`].
    changed: (Vec<bool>, Vec<u32>),
    /// What is to be looked at by [`Net::take_in`].
    untaken: BTreeSet<u32>,
    /// Whether each is part of a sum that reads it, and of a product, as its readers know it.
    is_part: Vec<[bool; 2]>,
    /// What may be part of others now, or not any more.
    touched: Vec<u32>,
    /// In which pass of [`Net::cancel`] each has become otherwise; those since the last one began.
    renewed: (Vec<u32>, Vec<u32>),
    pass: u32,
    /// Values looked at, all in all.
    #[cfg(test)]
    pub visits: usize,
}

/// Sums among the terms of a sum up to which two of them are written out together.
const PAIRED: usize = 32;

impl Net {
    pub fn new(program: &Program) -> Self {
        let mut net = Net {
            parts: vec![],
            stages: vec![],
            uses: vec![],
            kept: vec![],
            readers: vec![],
            numbers: FxHashMap::default(),
            changed: (vec![], vec![]),
            untaken: BTreeSet::new(),
            is_part: vec![],
            touched: vec![],
            renewed: (vec![], vec![]),
            pass: 1,
            #[cfg(test)]
            visits: 0,
        };
        for (_, stage) in program.ops() {
            net.push(Part::Gone, *stage);
        }
        for (id, (op, stage)) in (0..).zip(program.ops()) {
            let varies = *stage == Stage::Variable;
            match op {
                Op::Add(a, b) | Op::Sub(a, b) if varies => {
                    let sign = if matches!(op, Op::Add(..)) { 1 } else { -1 };
                    net.set_sum(id, vec![(*a, 1), (*b, sign)]);
                }
                Op::Mul(a, b) if varies => net.set_product(id, vec![*a, *b]),
                Op::Number(r) => {
                    net.parts[id as usize] = Part::Kept;
                    net.numbers.extend(r.to_integer().map(|n| (n, id)));
                }
                _ => {
                    net.kept[id as usize] = op.nodes().collect();
                    net.set(id, Part::Kept);
                }
            }
        }
        for (_, v) in program.outputs() {
            net.uses[v.node as usize] += 1;
            net.touched.push(v.node);
        }
        net.tell_readers();
        net
    }

    pub fn stage(&self, id: u32) -> Stage {
        self.stages[id as usize]
    }

    pub fn varies(&self, id: u32) -> bool {
        self.stage(id) == Stage::Variable
    }

    pub fn is_used_once(&self, id: u32) -> bool {
        self.uses[id as usize] == 1
    }

    pub fn sum(&self, id: u32) -> Option<&[Term]> {
        match &self.parts[id as usize] {
            Part::Sum(terms) => Some(terms),
            _ => None,
        }
    }

    pub fn product(&self, id: u32) -> Option<&[u32]> {
        match &self.parts[id as usize] {
            Part::Product(factors) => Some(factors),
            _ => None,
        }
    }

    pub fn operands(&self, id: u32) -> Vec<u32> {
        match &self.parts[id as usize] {
            Part::Kept => self.kept[id as usize].clone(),
            Part::Sum(terms) => terms.iter().map(|t| t.id).collect(),
            Part::Product(factors) => factors.clone(),
            Part::Number(_) | Part::Gone => vec![],
        }
    }

    fn push(&mut self, part: Part, stage: Stage) -> u32 {
        let id = self.parts.len() as u32;
        self.parts.push(part);
        self.stages.push(stage);
        self.uses.push(0);
        self.kept.push(vec![]);
        self.readers.push(FxHashSet::default());
        self.is_part.push([false; 2]);
        self.renewed.0.push(self.pass);
        self.renewed.1.push(id);
        self.changed.0.push(false);
        id
    }

    /// A further number.
    pub fn number(&mut self, n: i64) -> u32 {
        if let Some(&id) = self.numbers.get(&n) {
            return id;
        }
        let id = self.push(Part::Number(Rational::from(n)), Stage::Constant);
        self.numbers.insert(n, id);
        id
    }

    /// A further product.
    pub fn new_product(&mut self, factors: Vec<u32>) -> u32 {
        let stage = factors.iter().map(|&f| self.stage(f)).max().unwrap_or(Stage::Constant);
        let id = self.push(Part::Gone, stage);
        self.set_product(id, factors);
        id
    }

    /// A further sum.
    pub fn new_sum(&mut self, terms: Vec<(u32, i64)>) -> u32 {
        let stage = terms.iter().map(|t| self.stage(t.0)).max().unwrap_or(Stage::Constant);
        let id = self.push(Part::Gone, stage);
        self.set_sum(id, terms);
        id
    }

    pub fn set_product(&mut self, id: u32, mut factors: Vec<u32>) {
        factors.sort_unstable();
        self.set(id, Part::Product(factors));
    }

    /// Makes a value the sum of multiples of others.
    pub fn set_sum(&mut self, id: u32, terms: Vec<(u32, i64)>) {
        let mut all: Vec<Term> = collected(terms)
            .into_iter()
            .map(|(id, k)| {
                let id = match k.abs() {
                    1 => id,
                    n => {
                        let n = self.number(n);
                        self.new_product(vec![n, id])
                    }
                };
                Term { id, negative: k < 0 }
            })
            .collect();
        all.sort_unstable();
        self.set(id, Part::Sum(all));
    }

    fn set(&mut self, id: u32, part: Part) {
        let before = self.operands(id);
        for &o in &before {
            self.readers[o as usize].remove(&id);
        }
        self.parts[id as usize] = part;
        self.renewed.0[id as usize] = self.pass;
        self.renewed.1.push(id);
        self.untaken.insert(id);
        self.change(id);
        for o in self.operands(id) {
            self.readers[o as usize].insert(id);
            self.uses[o as usize] += 1;
            self.change(o);
        }
        before.into_iter().for_each(|o| self.release(o));
        self.tell_readers();
    }

    /// One reader less.
    fn release(&mut self, id: u32) {
        let mut released = vec![id];
        while let Some(o) = released.pop() {
            self.uses[o as usize] -= 1;
            self.change(o);
            let operands = self.operands(o);
            // Inputs and numbers may be read again.
            if self.uses[o as usize] == 0 && !operands.is_empty() {
                for &read in &operands {
                    self.readers[read as usize].remove(&o);
                }
                released.extend(operands);
                self.parts[o as usize] = Part::Gone;
            }
        }
    }

    /// Lets readers look again at what has become part of them, or is not any more.
    fn tell_readers(&mut self) {
        while let Some(id) = self.touched.pop() {
            let is_part = [self.is_part_of_sum(id), self.is_part_of_product(id)];
            if std::mem::replace(&mut self.is_part[id as usize], is_part) != is_part {
                self.untaken.extend(&self.readers[id as usize]);
            }
        }
    }

    /// Who reads a value.
    pub fn readers(&self, id: u32) -> impl Iterator<Item = u32> {
        self.readers[id as usize].iter().copied()
    }

    /// The number of an equal sum before this one, which is given up then.
    pub fn shared(&mut self, id: u32) -> u32 {
        let own = &self.parts[id as usize];
        let terms = self.sum(id).unwrap_or_default();
        let Some(rare) = terms.iter().min_by_key(|t| self.readers[t.id as usize].len()) else { return id };
        let equal = self.readers(rare.id).filter(|&o| o < id && self.parts[o as usize] == *own).min();
        match equal {
            Some(equal) => {
                self.uses[id as usize] += 1;
                self.release(id);
                self.tell_readers();
                equal
            }
            None => id,
        }
    }

    fn change(&mut self, id: u32) {
        self.touched.push(id);
        if !std::mem::replace(&mut self.changed.0[id as usize], true) {
            self.changed.1.push(id);
        }
    }

    /// What changed since this was last asked.
    pub fn changes(&mut self) -> Vec<u32> {
        for &id in &self.changed.1 {
            self.changed.0[id as usize] = false;
        }
        let mut all = std::mem::take(&mut self.changed.1);
        all.sort_unstable();
        all
    }

    /// Takes in what nobody else reads, and lets cancel what cancels.
    pub fn settle(&mut self) {
        while self.take_in() | self.cancel() {}
    }

    fn take_in(&mut self) -> bool {
        let mut any = false;
        // Readers mostly come behind what they read: what is taken in by them is not looked at any more.
        let mut before = self.parts.len() as u32;
        while let Some(&id) = self.untaken.range(..before).next_back() {
            self.untaken.remove(&id);
            before = id;
            self.visit();
            match &self.parts[id as usize] {
                Part::Sum(terms) if terms.iter().any(|t| self.is_part_of_sum(t.id)) => {
                    let mut pending: Vec<Term> = terms.clone();
                    let mut all = vec![];
                    while let Some(t) = pending.pop() {
                        match self.sum(t.id).filter(|_| self.is_part_of_sum(t.id)) {
                            Some(own) => pending.extend(
                                own.iter().map(|o| Term { negative: o.negative != t.negative, ..*o }),
                            ),
                            None => all.push((t.id, t.sign())),
                        }
                    }
                    self.set_sum(id, all);
                }
                Part::Product(factors) if factors.iter().any(|&f| self.is_part_of_product(f)) => {
                    let mut pending = factors.clone();
                    let mut all = vec![];
                    while let Some(f) = pending.pop() {
                        match self.is_part_of_product(f) {
                            true => pending.extend(self.operands(f)),
                            false => all.push(f),
                        }
                    }
                    self.set_product(id, all);
                }
                _ => continue,
            }
            any = true;
        }
        any
    }

    /// Counts a value that is looked at, for a test.
    pub fn visit(&mut self) {
        #[cfg(test)]
        {
            self.visits += 1;
        }
    }

    /// Whether a term is written out in a sum: a sum that nobody else reads, or one of one term.
    fn is_part_of_sum(&self, id: u32) -> bool {
        self.sum(id).is_some_and(|own| self.is_used_once(id) || own.len() < 2)
    }

    /// Whether a factor is one with the others: a product that nobody else reads, or a sum of one term.
    fn is_part_of_product(&self, id: u32) -> bool {
        let is_alias = || self.sum(id).is_some_and(|s| s.len() == 1 && !s[0].negative);
        is_alias() || self.product(id).is_some() && self.is_used_once(id)
    }

    /// The terms of some terms of a sum, which are sums.
    fn written_out(&self, terms: &[Term], inner: &[u32]) -> Vec<(u32, i64)> {
        let mut all = vec![];
        let places = inner.iter().filter_map(|id| terms.binary_search_by_key(id, |t| t.id).ok());
        for t in places.map(|place| terms[place]) {
            let own = self.sum(t.id).unwrap_or_default();
            all.extend(own.iter().map(|o| (o.id, o.sign() * t.sign())));
        }
        collected(all)
    }

    /// The terms of a sum with some of them written out, if each is there once, and how many more they are then.
    fn written(&self, terms: &[Term], inner: &[u32]) -> Option<(i64, Vec<(u32, i64)>)> {
        let mut more = -(inner.len() as i64);
        let written = self.written_out(terms, inner);
        for &(id, k) in &written {
            let there = terms.binary_search_by_key(&id, |t| t.id).ok().map(|place| terms[place]);
            let there = there.filter(|t| !inner.contains(&t.id));
            match (there, there.map_or(0, |t| t.sign()) + k) {
                (Some(_), 0) => more -= 1,
                (None, 1 | -1) => more += 1,
                (Some(_), 1 | -1) => {}
                _ => return None,
            }
        }
        let rest = terms.iter().filter(|t| !inner.contains(&t.id)).map(|t| (t.id, t.sign()));
        (more <= 0).then(|| (more, collected(rest.chain(written).collect())))
    }

    /// What a sum is with some of its terms written out: fewer terms, or a sum that is there already or the opposite of one:
    /// `(a + x) − (b + x)` beside `a − b`.
    fn shorter(&self, id: u32, terms: &[Term], inner: &[u32]) -> Option<Vec<(u32, i64)>> {
        let (more, all) = self.written(terms, inner)?;
        if more < 0 { Some(all) } else { self.equal_sum(id, &all).map(|equal| vec![equal]) }
    }

    /// Another sum of these terms, or of their opposites, and its sign.
    fn equal_sum(&self, id: u32, all: &[(u32, i64)]) -> Option<(u32, i64)> {
        let rare = all.iter().min_by_key(|t| self.readers[t.0 as usize].len())?;
        let sign = |other: u32| {
            let own = self.sum(other).filter(|own| own.len() == all.len() && own.len() > 1)?;
            let is_same =
                |sign: &i64| own.iter().zip(all).all(|(t, &(o, k))| t.id == o && t.sign() == sign * k);
            [1, -1].into_iter().find(is_same)
        };
        let equal = self.readers(rare.0).filter(|&other| other != id);
        equal.filter_map(|other| Some((other, sign(other)?))).min()
    }

    /// Writes out shared sums, one or two of them, in sums of which less is left then, or what another sum is.
    fn cancel(&mut self) -> bool {
        let mut any = false;
        self.pass += 1;
        let count = self.parts.len() as u32;
        let mut pending = BTreeSet::new();
        for id in std::mem::take(&mut self.renewed.1) {
            pending.insert(id);
            pending.extend(self.sum_readers(id));
        }
        while let Some(id) = pending.pop_first().filter(|&id| id < count) {
            self.visit();
            if !self.varies(id) {
                continue;
            }
            while let Some(shorter) = self.cancelled(id) {
                any = true;
                let known = self.renewed.1.len();
                self.set_sum(id, shorter);
                for k in known..self.renewed.1.len() {
                    let new = self.renewed.1[k];
                    let later: Vec<u32> =
                        self.sum_readers(new).chain([new]).filter(|&other| other > id).collect();
                    pending.extend(later);
                }
            }
        }
        any
    }

    /// The sums that read a sum.
    fn sum_readers(&self, id: u32) -> impl Iterator<Item = u32> {
        let is_sum = self.sum(id).is_some();
        self.readers(id).filter(move |&reader| is_sum && self.sum(reader).is_some())
    }

    fn cancelled(&self, id: u32) -> Option<Vec<(u32, i64)>> {
        let terms = self.sum(id)?;
        // Since the pass before began.
        let is_new = |id: u32| self.renewed.0[id as usize] + 1 >= self.pass;
        let sums: Vec<u32> =
            terms.iter().map(|t| t.id).filter(|&t| self.varies(t) && self.sum(t).is_some()).collect();
        let is_own = is_new(id);
        if !is_own && !sums.iter().any(|&s| is_new(s)) {
            return None;
        }
        let mut single = sums.iter().filter(|&&s| is_own || is_new(s));
        single.find_map(|&s| self.shorter(id, terms, &[s])).or_else(|| {
            let few = if sums.len() <= PAIRED { &sums[..] } else { &[] };
            (0..few.len()).find_map(|i| (0..i).find_map(|j| self.shorter(id, terms, &[few[j], few[i]])))
        })
    }
}

impl Term {
    pub fn sign(&self) -> i64 {
        if self.negative { -1 } else { 1 }
    }
}

/// Multiples of the same value together, in ascending order.
fn collected(mut terms: Vec<(u32, i64)>) -> Vec<(u32, i64)> {
    terms.sort_unstable();
    let mut all: Vec<(u32, i64)> = vec![];
    for (id, k) in terms {
        match all.last_mut().filter(|last| last.0 == id) {
            Some(last) => last.1 += k,
            None => all.push((id, k)),
        }
    }
    all.retain(|t| t.1 != 0);
    all
}
