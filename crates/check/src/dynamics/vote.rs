//! How a document's bodies and its gravity are to be read: as most of its formulas are right. Numbers at a few states decide; what they
//! say is proved later.
//!
//! Every quantity is linear in the numbers of each body, so that a reading costs a few products. Links are taken from the tip:
//! what depends on the last alone is known before the one before it is chosen.

use super::model::{Model, NUMBERS, Numbers, State};
use super::quantity::Quantity;
use crate::facts::Spoken;
use denavit_symbolic::{Expr, Symbol};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// States: in the first two parameters are the same.
const POINTS: usize = 3;
/// The most readings that are kept at a time.
const BEAM: usize = 200;
/// The most products of numbers that a vote takes, and that all votes on a document take.
const WORK: usize = 200_000_000;
const ALL_WORK: usize = 800_000_000;
/// The most readings that are as good as the best.
const MAX_BEST: usize = 200;
/// Rounding, by the size of what is compared.
const ROUNDING: f64 = 1e-8;

/// A formula with what it may be.
#[derive(Clone, Debug)]
pub(super) struct Test {
    pub value: Expr,
    pub candidates: Vec<Quantity>,
}

/// Bodies and gravity as symbols.
pub(super) struct Symbols {
    pub bodies: Vec<[Symbol; NUMBERS]>,
    pub gravity: [Symbol; 3],
}

impl Symbols {
    pub fn new(n: usize) -> Self {
        let body = |k: usize| std::array::from_fn(|p| Symbol::new(&format!("number {p} of body {k}")));
        Symbols {
            bodies: (0..n).map(body).collect(),
            gravity: ["x", "y", "z"].map(|a| Symbol::new(&format!("gravity along {a}"))),
        }
    }
}

/// The bodies that each link may have.
pub(super) struct Candidates {
    pub bodies: Vec<Vec<Numbers>>,
    /// What they are at the states.
    values: Vec<Vec<Values>>,
    /// How many names each has.
    names: Vec<Vec<usize>>,
}

/// The numbers of a link at the states.
type Values = [[f64; NUMBERS]; POINTS];

impl Candidates {
    pub fn new(bodies: Vec<Vec<Numbers>>, state: &State) -> Self {
        let at = |e: Expr, at: usize| e.eval(|s| Some(sample(s, at, state))).unwrap_or(f64::NAN);
        let values = |own: &Numbers| std::array::from_fn(|point| own.map(|e| at(e, point)));
        let names = |own: &Numbers| own.iter().flat_map(|e| e.symbols()).collect::<BTreeSet<Symbol>>().len();
        Candidates {
            values: bodies.iter().map(|all| all.iter().map(values).collect()).collect(),
            names: bodies.iter().map(|all| all.iter().map(names).collect()).collect(),
            bodies,
        }
    }

    /// Those of a link that differ in numbers with an effect; of those that do not the one that needs fewest names.
    fn distinct(&self, k: usize, felt: &[usize]) -> Vec<(usize, Values)> {
        let mut kept: Vec<(usize, Values)> = vec![];
        for (number, values) in self.values[k].iter().enumerate() {
            let is_same = |other: &Values| {
                [0, 2].iter().all(|&at| felt.iter().all(|&p| (other[at][p] - values[at][p]).abs() < 1e-9))
            };
            match kept.iter_mut().find(|(_, other)| is_same(other)) {
                Some(known) if self.names[k][number] < self.names[k][known.0] => known.0 = number,
                Some(_) => {}
                None => kept.push((number, *values)),
            }
        }
        kept
    }
}

/// A way to read the bodies and gravity.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    pub gravity: usize,
    /// Of each link, its number among those that it may have.
    pub bodies: Vec<usize>,
    /// Which of the tests are right.
    pub right: Vec<bool>,
    pub score: usize,
    /// What the first candidate of each test is at the states.
    pub wanted: Vec<[f64; POINTS]>,
}

impl Reading {
    /// True if all tests want the same.
    fn wants_as(&self, other: &Reading) -> bool {
        let mut pairs = self.wanted.iter().flatten().zip(other.wanted.iter().flatten());
        self.right == other.right
            && pairs.all(|(a, b)| (a - b).abs() <= ROUNDING * (1.0 + a.abs()) || a.is_nan() && b.is_nan())
    }
}

/// The best readings, and of each test the links on which it depends.
pub(super) struct Vote {
    pub best: Vec<Reading>,
    pub links: Vec<Vec<usize>>,
    /// By gravity, quantity and link: what the numbers of the link are multiplied with in the first state.
    factors: Vec<Vec<Vec<[f64; NUMBERS]>>>,
    /// There are more readings in which the same is right.
    pub is_many: bool,
    /// What the words of the document say, where more is right in a reading that they contradict.
    pub against: Vec<Spoken>,
}

impl Vote {
    /// True if a symbol of a link has an effect on something that is asked for.
    pub fn has_effect(
        &self,
        reading: &Reading,
        k: usize,
        own: &Numbers,
        symbol: Symbol,
        state: &State,
    ) -> bool {
        let with = |factor: f64| {
            own.map(|e| {
                e.eval(|s| Some(sample(s, 0, state) * if s == symbol { factor } else { 1.0 })).unwrap_or(0.0)
            })
        };
        let (once, twice) = (with(1.0), with(2.0));
        self.factors[reading.gravity].iter().any(|of| {
            let off: f64 = (0..NUMBERS).map(|p| of[k][p] * (twice[p] - once[p])).sum();
            let size: f64 = (0..NUMBERS).map(|p| (of[k][p] * once[p]).abs()).sum();
            off.abs() > ROUNDING * (1.0 + size)
        })
    }

    /// True if a link's numbers are the same where a reading feels them.
    pub fn is_same(
        &self,
        reading: &Reading,
        k: usize,
        one: &Numbers,
        other: &Numbers,
        state: &State,
    ) -> bool {
        let is_felt = |p: usize| self.factors[reading.gravity].iter().any(|of| of[k][p].abs() > ROUNDING);
        (0..NUMBERS).filter(|&p| is_felt(p)).all(|p| {
            one[p] == other[p]
                || values(one[p] - other[p], state)
                    .is_some_and(|off| [0, 2].iter().all(|&at| off[at].abs() < ROUNDING))
        })
    }

    /// How many tests are right in the best readings.
    pub fn score(&self) -> usize {
        self.best.iter().map(|b| b.score).max().unwrap_or(0)
    }
}

/// What all votes on a document may take; what is right in no reading that was tried may be right in another where not all were.
pub(super) struct Bounds {
    work: Cell<usize>,
    pub is_cut: Cell<bool>,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds { work: Cell::new(ALL_WORK), is_cut: Cell::new(false) }
    }
}

type Tables = Rc<[Table; POINTS]>;

/// Votes on an arm in the same coordinates.
pub(super) struct Voter<'a> {
    pub model: &'a Rc<Model>,
    pub symbols: &'a Rc<Symbols>,
    pub bounds: &'a Rc<Bounds>,
    tables: RefCell<BTreeMap<Quantity, Option<Tables>>>,
}

/// A factor of each of the numbers of each body, without gravity and by each of its components.
#[derive(Clone)]
struct Table {
    plain: Vec<[f64; NUMBERS]>,
    by_gravity: [Vec<[f64; NUMBERS]>; 3],
}

/// A number that belongs to a symbol at a state.
fn sample(symbol: Symbol, at: usize, state: &State) -> f64 {
    let moves = [&state.q, &state.qd, &state.qdd].iter().any(|all| all.contains(&symbol));
    let seed = if moves { at as u64 + 1 } else { u64::from(at == 2) };
    let mut z = symbol
        .name()
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64 ^ seed.wrapping_mul(0x9E37_79B9_7F4A_7C15), |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
        });
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
    if moves { 4.0 * unit - 2.0 } else { 0.3 + 1.5 * unit }
}

/// The value of a formula at the states; nothing where it has none.
pub(super) fn values(e: Expr, state: &State) -> Option<[f64; POINTS]> {
    let mut found = [0.0; POINTS];
    for (at, value) in found.iter_mut().enumerate() {
        *value = e.eval(|s| Some(sample(s, at, state))).ok().filter(|x| x.is_finite())?;
    }
    Some(found)
}

/// A number by which those are known that are the same but for rounding.
fn rounded(x: f64) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "what is out of range is as good as the largest")]
    let whole = (x * 1e7).round() as i64;
    whole
}

/// Whether numbers are those wanted.
pub(super) fn agree(a: &[f64; POINTS], b: &[f64; POINTS], quantity: Quantity) -> bool {
    let near = |x: f64, y: f64, size: f64| (x - y).abs() <= ROUNDING * (1.0 + size);
    if quantity.is_up_to_constant() {
        let size = a[0].abs().max(a[1].abs()).max(b[0].abs());
        return near(a[0] - b[0], a[1] - b[1], size);
    }
    (0..POINTS).all(|p| near(a[p], b[p], a[p].abs().max(b[p].abs())))
}

impl Table {
    fn new(e: Expr, symbols: &Symbols, state: &State, at: usize, feels_gravity: bool) -> Option<Table> {
        let n = symbols.bodies.len();
        let with = |k: usize, p: usize, axis: Option<usize>| {
            e.eval(|s| {
                if let Some(a) = symbols.gravity.iter().position(|g| *g == s) {
                    return Some(f64::from(u8::from(axis == Some(a))));
                }
                for (i, body) in symbols.bodies.iter().enumerate() {
                    if let Some(number) = body.iter().position(|x| *x == s) {
                        return Some(f64::from(u8::from((i, number) == (k, p))));
                    }
                }
                Some(sample(s, at, state))
            })
            .ok()
        };
        let mut plain = vec![[0.0; NUMBERS]; n];
        let nothing = vec![[0.0; NUMBERS]; n];
        let mut by_gravity = [nothing.clone(), nothing.clone(), nothing];
        for k in 0..n {
            for p in 0..NUMBERS {
                plain[k][p] = with(k, p, None)?;
                if feels_gravity && (6..10).contains(&p) {
                    for (axis, of) in by_gravity.iter_mut().enumerate() {
                        of[k][p] = with(k, p, Some(axis))? - plain[k][p];
                    }
                }
            }
        }
        Some(Table { plain, by_gravity })
    }
}

/// Keeps so many, and of the others the first of each way in which tests are right; true if some are left out.
fn keep<T>(all: &mut Vec<T>, most: usize, right: impl Fn(&T) -> &Vec<bool>) -> bool {
    let count = all.len();
    let (mut at, mut seen) = (0, BTreeSet::new());
    all.retain(|one| {
        at += 1;
        seen.insert(right(one).clone()) || at <= most
    });
    all.len() < count
}

struct Chosen {
    bodies: Vec<usize>,
    sums: Vec<f64>,
    right: Vec<bool>,
    score: usize,
}

impl<'a> Voter<'a> {
    pub fn new(model: &'a Rc<Model>, symbols: &'a Rc<Symbols>, bounds: &'a Rc<Bounds>) -> Self {
        Voter { model, symbols, bounds, tables: RefCell::default() }
    }

    /// The factors of a quantity at the states.
    fn table(&self, quantity: Quantity) -> Option<Tables> {
        if let Some(known) = self.tables.borrow().get(&quantity) {
            return known.clone();
        }
        let made = || {
            let e = self.model.value(quantity)?;
            let of = |at| Table::new(e, self.symbols, &self.model.state, at, quantity.feels_gravity());
            let all: Vec<Table> = (0..POINTS).map(of).collect::<Option<_>>()?;
            <[Table; POINTS]>::try_from(all).ok().map(Rc::new)
        };
        let made = made();
        self.tables.borrow_mut().insert(quantity, made.clone());
        made
    }

    /// The most readings that are kept at a time, where each costs so many products.
    fn beam(&self, cost: usize) -> usize {
        let left = self.bounds.work.get();
        let beam = (WORK.min(left) / cost.max(1)).min(BEAM);
        if beam == 0 {
            self.bounds.is_cut.set(true);
        }
        beam
    }

    /// Reads the tests in all ways: `gravities` are the accelerations of gravity.
    pub fn vote(&self, tests: &[Test], candidates: &Candidates, gravities: &[[Expr; 3]]) -> Option<Vote> {
        let (state, n) = (&self.model.state, self.symbols.bodies.len());
        let mut tables: Vec<Tables> = vec![];
        let mut numbers: BTreeMap<Quantity, usize> = BTreeMap::new();
        let mut slots: Vec<(usize, Quantity, usize)> = vec![]; // test, quantity, table
        let mut printed: Vec<[f64; POINTS]> = vec![];
        for (t, test) in tests.iter().enumerate() {
            printed.push(values(test.value, state).unwrap_or([f64::NAN; POINTS]));
            for &quantity in &test.candidates {
                let table = match numbers.get(&quantity) {
                    Some(&k) => k,
                    None => {
                        let Some(made) = self.table(quantity) else { continue };
                        tables.push(made);
                        numbers.insert(quantity, tables.len() - 1);
                        tables.len() - 1
                    }
                };
                slots.push((t, quantity, table));
            }
        }
        let is_felt = |table: usize, k: usize, p: usize| {
            let some =
                |t: &Table| t.plain[k][p].abs() > 1e-12 || t.by_gravity.iter().any(|g| g[k][p].abs() > 1e-12);
            tables[table].iter().any(some)
        };
        let links: Vec<Vec<usize>> = (0..tests.len())
            .map(|t| {
                let feels =
                    |k: &usize| slots.iter().any(|s| s.0 == t && (0..NUMBERS).any(|p| is_felt(s.2, *k, p)));
                (0..n).filter(feels).collect()
            })
            .collect();
        let felt = |k: usize| -> Vec<usize> {
            (0..NUMBERS).filter(|&p| (0..tables.len()).any(|t| is_felt(t, k, p))).collect()
        };
        let felt: Vec<Vec<usize>> = (0..n).map(felt).collect();
        let chosen: Vec<Vec<(usize, Values)>> = (0..n).map(|k| candidates.distinct(k, &felt[k])).collect();
        let most = chosen.iter().map(Vec::len).max().unwrap_or(1);
        // Of each link the numbers that each slot feels, and what adding them takes.
        let felt_by = |k: usize| -> Vec<Vec<usize>> {
            slots.iter().map(|s| (0..NUMBERS).filter(|&p| is_felt(s.2, k, p)).collect()).collect()
        };
        let felt_by: Vec<Vec<Vec<usize>>> = (0..n).map(felt_by).collect();
        let costs: Vec<usize> =
            felt_by.iter().map(|all| slots.len() + all.iter().map(Vec::len).sum::<usize>()).collect();
        let beam = self.beam(costs.iter().sum::<usize>() * most * gravities.len() * POINTS);
        if beam == 0 {
            return None;
        }
        let mut best: Vec<Reading> = vec![];
        let mut first_factors = vec![];
        let (mut is_many, mut most_lost) = (false, 0);
        for (g, gravity) in gravities.iter().enumerate() {
            let along: Vec<[f64; 3]> = (0..POINTS)
                .map(|at| gravity.map(|e| e.eval(|s| Some(sample(s, at, state))).unwrap_or(0.0)))
                .collect();
            // The factors of the numbers under this gravity.
            let factors: Vec<[Vec<[f64; NUMBERS]>; POINTS]> = tables
                .iter()
                .map(|of| {
                    std::array::from_fn(|at| {
                        let t = &of[at];
                        (0..n)
                            .map(|k| {
                                std::array::from_fn(|p| {
                                    let weight: f64 =
                                        (0..3).map(|a| t.by_gravity[a][k][p] * along[at][a]).sum();
                                    t.plain[k][p] + weight
                                })
                            })
                            .collect()
                    })
                })
                .collect();
            first_factors.push(factors.iter().map(|of| of[0].clone()).collect());
            let first = Chosen {
                bodies: vec![0; n],
                sums: vec![0.0; slots.len() * POINTS],
                right: vec![false; tests.len()],
                score: 0,
            };
            let mut states = vec![first];
            for k in (0..n).rev() {
                let products = states.len() * chosen[k].len() * costs[k] * POINTS;
                self.bounds.work.set(self.bounds.work.get().saturating_sub(products));
                let mut next: Vec<Chosen> = vec![];
                for from in &states {
                    for (number, values) in &chosen[k] {
                        let mut sums = from.sums.clone();
                        for (s, slot) in slots.iter().enumerate() {
                            for at in 0..POINTS {
                                let by = &factors[slot.2][at][k];
                                sums[s * POINTS + at] +=
                                    felt_by[k][s].iter().map(|&p| by[p] * values[at][p]).sum::<f64>();
                            }
                        }
                        let (mut right, mut score) = (from.right.clone(), from.score);
                        for (s, slot) in slots.iter().enumerate() {
                            let test = slot.0;
                            let is_now = links[test].first().copied().unwrap_or(0) == k;
                            if !is_now || right[test] {
                                continue;
                            }
                            let wanted: [f64; POINTS] = std::array::from_fn(|at| sums[s * POINTS + at]);
                            if agree(&printed[test], &wanted, slot.1) {
                                right[test] = true;
                                score += usize::from(printed[test].iter().any(|x| x.abs() > 1e-12));
                            }
                        }
                        let mut bodies = from.bodies.clone();
                        bodies[k] = *number;
                        next.push(Chosen { bodies, sums, right, score });
                    }
                }
                next.sort_by_key(|s| std::cmp::Reverse(s.score));
                if next.len() > beam {
                    // What is the same so far is the same in the end.
                    let mut seen = BTreeSet::new();
                    next.retain(|s| seen.insert(s.sums.iter().map(|x| rounded(*x)).collect::<Vec<i64>>()));
                }
                if k == 0 {
                    // Of those that are as good all ways in which tests are right are kept.
                    let top = next.first().map_or(0, |s| s.score);
                    next.retain(|s| s.score == top);
                    is_many |= keep(&mut next, beam, |s| &s.right);
                } else if let Some(lost) = next.get(beam) {
                    let open = |t: &usize| links[*t].first().copied().unwrap_or(0) < k;
                    most_lost = most_lost.max(lost.score + (0..tests.len()).filter(open).count());
                    next.truncate(beam);
                }
                states = next;
            }
            let top = best.first().map_or(0, |b| b.score);
            for s in states {
                if s.score < top && !best.is_empty() {
                    continue;
                }
                let wanted = (0..tests.len())
                    .map(|t| match slots.iter().position(|slot| slot.0 == t) {
                        Some(slot) => std::array::from_fn(|at| s.sums[slot * POINTS + at]),
                        None => [f64::NAN; POINTS],
                    })
                    .collect();
                let reading =
                    Reading { gravity: g, bodies: s.bodies, right: s.right, score: s.score, wanted };
                if !best.iter().any(|b| reading.wants_as(b)) {
                    best.push(reading);
                }
            }
            let top = best.iter().map(|b| b.score).max().unwrap_or(0);
            best.retain(|b| b.score == top);
            is_many |= keep(&mut best, MAX_BEST, |b| &b.right);
        }
        if best.first().is_some_and(|b| most_lost >= b.score.max(1)) {
            self.bounds.is_cut.set(true);
        }
        (!best.is_empty()).then_some(Vote { best, links, factors: first_factors, is_many, against: vec![] })
    }
}
