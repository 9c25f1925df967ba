//! How a document's bodies and its gravity are to be read: as most of its formulas are right. Numbers at a few states decide; what they
//! say is proved later.
//!
//! Every quantity is linear in the ten numbers of each body, so that a reading costs a few products. Links are taken from the tip:
//! what depends on the last alone is known before the one before it is chosen.

use super::model::{Model, State, Ten};
use super::quantity::Quantity;
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// States: in the first two parameters are the same.
const POINTS: usize = 3;
/// The most readings that are kept at a time.
const BEAM: usize = 200;
/// The most products of numbers that a vote takes.
const WORK: usize = 400_000_000;
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
    pub bodies: Vec<[Symbol; 10]>,
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

/// The best readings, and of each test the links on which it depends.
pub(super) struct Vote {
    pub best: Vec<Reading>,
    pub links: Vec<Vec<usize>>,
    /// The first of all readings, which is the most usual.
    pub is_any_right: bool,
}

/// A factor of each of the ten numbers of each body, without gravity and by each of its components.
struct Table {
    plain: Vec<[f64; 10]>,
    by_gravity: [Vec<[f64; 10]>; 3],
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
        let mut plain = vec![[0.0; 10]; n];
        let mut by_gravity = [vec![[0.0; 10]; n], vec![[0.0; 10]; n], vec![[0.0; 10]; n]];
        for k in 0..n {
            for p in 0..10 {
                plain[k][p] = with(k, p, None)?;
                if feels_gravity && p >= 6 {
                    for (axis, of) in by_gravity.iter_mut().enumerate() {
                        of[k][p] = with(k, p, Some(axis))? - plain[k][p];
                    }
                }
            }
        }
        Some(Table { plain, by_gravity })
    }
}

struct Chosen {
    bodies: Vec<usize>,
    sums: Vec<f64>,
    right: Vec<bool>,
    score: usize,
}

/// Reads the tests in all ways: `bodies` are those that each link may have, `gravities` the accelerations of gravity.
pub(super) fn vote(
    model: &Model,
    symbols: &Symbols,
    tests: &[Test],
    bodies: &[Vec<Ten>],
    gravities: &[[Expr; 3]],
) -> Option<Vote> {
    let (state, n) = (&model.state, symbols.bodies.len());
    // A table for each quantity that is asked for, at each state.
    let mut numbers: BTreeMap<Quantity, usize> = BTreeMap::new();
    let mut tables: Vec<[Table; POINTS]> = vec![];
    let mut slots: Vec<(usize, Quantity, usize)> = vec![]; // test, quantity, table
    let mut printed: Vec<[f64; POINTS]> = vec![];
    for (t, test) in tests.iter().enumerate() {
        printed.push(values(test.value, state).unwrap_or([f64::NAN; POINTS]));
        for &quantity in &test.candidates {
            let table = match numbers.get(&quantity) {
                Some(&k) => k,
                None => {
                    let Some(e) = model.value(quantity) else { continue };
                    let made: Option<Vec<Table>> = (0..POINTS)
                        .map(|at| Table::new(e, symbols, state, at, quantity.feels_gravity()))
                        .collect();
                    let Some(made) = made.and_then(|m| <[Table; POINTS]>::try_from(m).ok()) else { continue };
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
            let feels = |k: &usize| slots.iter().any(|s| s.0 == t && (0..10).any(|p| is_felt(s.2, *k, p)));
            (0..n).filter(feels).collect()
        })
        .collect();
    // The numbers of the bodies, one for each that has an effect of its own.
    let mut chosen: Vec<Vec<(usize, [[f64; 10]; POINTS])>> = vec![];
    for (k, all) in bodies.iter().enumerate() {
        let felt: Vec<usize> = (0..10).filter(|&p| (0..tables.len()).any(|t| is_felt(t, k, p))).collect();
        let mut kept: Vec<(usize, [[f64; 10]; POINTS])> = vec![];
        for (number, ten) in all.iter().enumerate() {
            let mut values = [[0.0; 10]; POINTS];
            for (at, value) in values.iter_mut().enumerate() {
                for (p, e) in ten.iter().enumerate() {
                    value[p] = e.eval(|s| Some(sample(s, at, state))).unwrap_or(f64::NAN);
                }
            }
            let is_same = |other: &[[f64; 10]; POINTS]| {
                [0, 2].iter().all(|&at| felt.iter().all(|&p| (other[at][p] - values[at][p]).abs() < 1e-9))
            };
            // Of those that have the same effect the one that needs fewest names.
            let names = |number: usize| -> usize {
                let mut all: Vec<Symbol> = bodies[k][number].iter().flat_map(|e| e.symbols()).collect();
                all.sort();
                all.dedup();
                all.len()
            };
            match kept.iter_mut().find(|(_, other)| is_same(other)) {
                Some(known) if names(number) < names(known.0) => known.0 = number,
                Some(_) => {}
                None => kept.push((number, values)),
            }
        }
        chosen.push(kept);
    }
    let most = chosen.iter().map(Vec::len).max().unwrap_or(1);
    let beam = (WORK / (1 + slots.len() * most * n * gravities.len() * 10 * POINTS)).clamp(4, BEAM);
    let mut best: Vec<Reading> = vec![];
    for (g, gravity) in gravities.iter().enumerate() {
        let along: Vec<[f64; 3]> = (0..POINTS)
            .map(|at| gravity.map(|e| e.eval(|s| Some(sample(s, at, state))).unwrap_or(0.0)))
            .collect();
        // The factors of the ten numbers under this gravity.
        let factors: Vec<[Vec<[f64; 10]>; POINTS]> = tables
            .iter()
            .map(|of| {
                std::array::from_fn(|at| {
                    let t = &of[at];
                    (0..n)
                        .map(|k| {
                            std::array::from_fn(|p| {
                                let weight: f64 = (0..3).map(|a| t.by_gravity[a][k][p] * along[at][a]).sum();
                                t.plain[k][p] + weight
                            })
                        })
                        .collect()
                })
            })
            .collect();
        let first = Chosen {
            bodies: vec![0; n],
            sums: vec![0.0; slots.len() * POINTS],
            right: vec![false; tests.len()],
            score: 0,
        };
        let mut states = vec![first];
        for k in (0..n).rev() {
            let mut next: Vec<Chosen> = vec![];
            for from in &states {
                for (number, values) in &chosen[k] {
                    let mut sums = from.sums.clone();
                    for (s, slot) in slots.iter().enumerate() {
                        for at in 0..POINTS {
                            let by = &factors[slot.2][at][k];
                            sums[s * POINTS + at] += (0..10).map(|p| by[p] * values[at][p]).sum::<f64>();
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
            next.truncate(beam);
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
            best.push(Reading { gravity: g, bodies: s.bodies, right: s.right, score: s.score, wanted });
        }
        let top = best.iter().map(|b| b.score).max().unwrap_or(0);
        best.retain(|b| b.score == top);
        best.truncate(MAX_BEST);
    }
    let is_any_right = best.first().is_some_and(|b| b.score > 0);
    (!best.is_empty()).then_some(Vote { best, links, is_any_right })
}
