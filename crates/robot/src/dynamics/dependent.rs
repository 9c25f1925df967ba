//! Base parameters that depend on others although grouping does not say so, as where joints are coupled by a closed loop: their columns
//! of the torques are sums of others, with coefficients that no joint is in.
//!
//! Coefficients are had modulo a prime, for several values of the lengths. One is a number if it is the same for all and lifts to a
//! small fraction; otherwise it is sought as one or two products of powers of lengths, of the dimension that it must have. What is found
//! holds for further values that had no part in it, and in floating point, or it is left alone.

use super::base::{BaseModel, BaseParameter, columns, named_apart};
use super::grouping::Grouped;
use super::model::Formulas;
use crate::geometry::PARAMETERS;
use crate::random::Random;
use denavit_program::{Dependency, Domain, Residue};
use denavit_symbolic::{Expr, Rational, Symbol, readable};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;

/// Values of the lengths from which coefficients are sought, and those on which they are tried.
const SOUGHT: usize = 2;
const TRIED: usize = 2;
/// The highest power of a length.
const POWER: i32 = 2;
/// Products of powers that are tried at most.
const MAX_PRODUCTS: usize = 700;

/// The same torques without base parameters that depend on others, as far as that is found.
pub(super) fn without_dependent(formulas: &Formulas, order: &[Symbol], model: BaseModel) -> BaseModel {
    let found = dependent(formulas, &model);
    if found.is_empty() {
        return model;
    }
    let mut parameters = model.parameters;
    let mut taken: FxHashSet<String> =
        formulas.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
    taken.extend(parameters.iter().map(|p| p.symbol.name().to_string()));
    for (own, terms) in &found {
        let value = parameters[*own].value;
        for (k, factor) in terms {
            let into = &mut parameters[*k];
            into.value = into.value + *factor * value;
        }
    }
    // What something was added to is a grouping, and called so.
    let mut names: FxHashMap<Symbol, Expr> = FxHashMap::default();
    let grown: BTreeSet<usize> = found.iter().flat_map(|(_, terms)| terms.iter().map(|t| t.0)).collect();
    for k in grown {
        let p = &mut parameters[k];
        if !p.is_grouped {
            let letters: String = p.symbol.name().chars().take_while(|c| !c.is_ascii_digit()).collect();
            let letters = PARAMETERS.iter().find(|l| ***l == letters).unwrap_or(&"P");
            let symbol = named_apart(letters, p.link, &mut taken);
            names.insert(p.symbol, symbol.into());
            (p.symbol, p.is_grouped) = (symbol, true);
        }
        p.value = readable::simplify(p.value, order).map_or(p.value, |s| s.expr);
    }
    for (own, _) in &found {
        names.insert(parameters[*own].symbol, Expr::int(0));
    }
    let links: Vec<Grouped> =
        model.links.iter().map(|l| l.with(|_, e| e.substitute(|s| names.get(&s).copied()))).collect();
    let gone: FxHashSet<usize> = found.iter().map(|f| f.0).collect();
    let left = parameters.into_iter().enumerate().filter(|(k, _)| !gone.contains(k)).map(|(_, p)| p);
    BaseModel::in_parameters(formulas, links, left.collect())
}

/// Base parameters that depend on others, with their coefficients in these.
fn dependent(formulas: &Formulas, model: &BaseModel) -> Vec<(usize, Vec<(usize, Expr)>)> {
    let is_base: FxHashSet<Symbol> = model.parameters.iter().map(|p| p.symbol).collect();
    let lengths: Vec<Symbol> =
        model.inverse.parameters().iter().copied().filter(|s| !is_base.contains(s)).collect();
    let in_drives: FxHashSet<Symbol> = formulas
        .dynamics
        .drives
        .iter()
        .flat_map(|d| [d.rotor, d.viscous, d.coulomb])
        .flat_map(Expr::symbols)
        .collect();
    let mut random = Random(1990);
    let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
    let mut points: Vec<(FxHashMap<Symbol, Residue>, Vec<Dependency>)> = vec![];
    for _ in 0..SOUGHT + TRIED {
        let at: FxHashMap<Symbol, Residue> =
            lengths.iter().map(|&s| (s, Residue::input(any(), any()))).collect();
        let rows = columns(&model.inverse, &model.parameters, &at, &mut any);
        let Some(found) = rows.and_then(|rows| Residue::dependencies(&rows)) else { return vec![] };
        points.push((at, found));
    }
    let lengths: Vec<Symbol> = lengths.into_iter().filter(|s| !in_drives.contains(s)).collect();
    let mut found = vec![];
    for first in &points[0].1 {
        // The same coefficient for all values of lengths.
        let at = |k: usize| -> Option<Vec<Residue>> {
            let one = |(_, all): &(_, Vec<Dependency>)| {
                let own = all.iter().find(|d| d.column == first.column)?;
                Some(own.of.iter().find(|o| o.0 == k).map_or_else(|| Residue::new(0), |o| o.1.clone()))
            };
            points.iter().map(one).collect()
        };
        let mut all: Vec<usize> = points
            .iter()
            .flat_map(|p| &p.1)
            .filter(|d| d.column == first.column)
            .flat_map(|d| d.of.iter().map(|o| o.0))
            .collect();
        all.sort_unstable();
        all.dedup();
        let dimension = |k: usize| dimension(&model.parameters[k], &model.links);
        let term = |k: usize| {
            let degree = dimension(first.column)? - dimension(k)?;
            let values: Vec<(&FxHashMap<Symbol, Residue>, Residue)> =
                points.iter().map(|p| &p.0).zip(at(k)?).collect();
            Some((k, coefficient(&lengths, degree, &values)?))
        };
        if let Some(terms) = all.into_iter().map(term).collect::<Option<Vec<(usize, Expr)>>>()
            && holds(model, first.column, &terms)
        {
            found.push((first.column, terms));
        }
    }
    found
}

/// States in which a dependency is tried in numbers, and what is rounding there.
const STATES: usize = 4;
const ROUNDING: f64 = 1e-8;

/// Whether a column of the torques is this sum of others in floating point, for lengths and states at random: what a number looks like
/// modulo the prime may be chance.
fn holds(model: &BaseModel, column: usize, terms: &[(usize, Expr)]) -> bool {
    let mut random = Random(1991);
    let program = &model.inverse;
    let places: FxHashMap<Symbol, usize> =
        model.parameters.iter().enumerate().map(|(k, p)| (p.symbol, k)).collect();
    (0..STATES).all(|_| {
        let at: FxHashMap<Symbol, f64> = program
            .variables()
            .iter()
            .chain(program.parameters())
            .map(|&s| (s, 0.3 + random.unit()))
            .collect();
        let with = |one: Option<usize>| {
            let value = |s: Symbol| match places.get(&s) {
                Some(k) => Some(f64::from(u8::from(Some(*k) == one))),
                None => at.get(&s).copied(),
            };
            program.eval(value).ok()
        };
        let column_of = |k: usize, drives: &[f64]| -> Option<Vec<f64>> {
            Some(with(Some(k))?.iter().zip(drives).map(|(a, b)| a - b).collect())
        };
        let check = || -> Option<bool> {
            let drives = with(None)?;
            let mut left = column_of(column, &drives)?;
            let mut size = left.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            for (k, factor) in terms {
                let factor = factor.eval(|s| at.get(&s).copied()).ok()?;
                for (l, x) in left.iter_mut().zip(column_of(*k, &drives)?) {
                    size = size.max((factor * x).abs());
                    *l -= factor * x;
                }
            }
            Some(left.iter().all(|x| x.abs() <= ROUNDING * size))
        };
        check() == Some(true)
    })
}

/// The power of lengths in the unit of a base parameter: 2 for inertia, 1 for a first moment, 0 for a mass.
fn dimension(p: &BaseParameter, links: &[Grouped]) -> Option<i32> {
    let entries = links[p.link].entries();
    let place = entries.iter().position(|&e| e == Expr::from(p.symbol))?;
    Some(match place {
        0..=5 => 2,
        6..=8 => 1,
        _ => 0,
    })
}

/// So many lengths are looked at.
const MAX_LENGTHS: usize = 12;
/// Roots that sines and cosines of usual angles have.
const ROOTS: [i64; 4] = [1, 2, 3, 6];

/// A coefficient as a formula of lengths: a number, or a sum of at most two products of their powers and of roots of small numbers.
fn coefficient(
    lengths: &[Symbol],
    degree: i32,
    values: &[(&FxHashMap<Symbol, Residue>, Residue)],
) -> Option<Expr> {
    let same = |of: &dyn Fn(usize) -> Residue| {
        let first = of(0).lifted()?;
        (1..values.len()).all(|k| of(k).lifted().as_ref() == Some(&first)).then_some(first)
    };
    if let Some(number) = same(&|k| values[k].1.clone())
        && (degree == 0 || number.is_zero() || lengths.is_empty())
    {
        return Some(number.into());
    }
    if lengths.len() > MAX_LENGTHS {
        return None;
    }
    // Numbers have no dimension that could be told.
    let powers = if lengths.is_empty() { vec![vec![]] } else { products(lengths.len(), degree) };
    let products: Vec<(i64, &Vec<i32>)> =
        ROOTS.iter().flat_map(|&root| powers.iter().map(move |p| (root, p))).take(MAX_PRODUCTS).collect();
    let value = |(root, product): &(i64, &Vec<i32>), at: &FxHashMap<Symbol, Residue>| {
        let root = Residue::rational(&Rational::from(*root)).sqrt();
        lengths.iter().zip(*product).fold(root, |all, (s, &power)| {
            let one = |all: Residue, _| if power < 0 { all.div(&at[s]) } else { all.mul(&at[s]) };
            (0..power.abs()).fold(all, one)
        })
    };
    let table: Vec<Vec<Residue>> =
        products.iter().map(|p| values.iter().map(|v| value(p, v.0)).collect()).collect();
    let formula = |(root, product): &(i64, &Vec<i32>), number: Rational| {
        let root = Expr::int(*root).sqrt();
        let power = |all: Expr, (s, &power): (&Symbol, &i32)| all * Expr::from(*s).powi(power);
        lengths.iter().zip(*product).fold(Expr::from(number) * root, power)
    };
    for (product, of) in products.iter().zip(&table) {
        if let Some(number) = same(&|k| values[k].1.div(&of[k])) {
            return Some(formula(product, number));
        }
    }
    if lengths.is_empty() {
        return None; // nothing changes from value to value: two numbers would fit anything
    }
    for (i, one) in table.iter().enumerate() {
        for (j, two) in table.iter().enumerate().skip(i + 1) {
            // x·one + y·two at the first two values.
            let det = one[0].mul(&two[1]).sub(&one[1].mul(&two[0]));
            let (v, w) = (&values[0].1, &values[1].1);
            let over = Residue::new(1).div(&det);
            let Some(x) = v.mul(&two[1]).sub(&w.mul(&two[0])).mul(&over).lifted() else { continue };
            let Some(y) = one[0].mul(w).sub(&one[1].mul(v)).mul(&over).lifted() else { continue };
            let [a, b] = [&x, &y].map(Residue::rational);
            let holds = |k: usize| {
                let sum = a.mul(&one[k]).add(&b.mul(&two[k]));
                sum.get().is_some() && sum.get() == values[k].1.get()
            };
            if (SOUGHT..values.len()).all(holds) {
                return Some(formula(&products[i], x) + formula(&products[j], y));
            }
        }
    }
    None
}

/// Exponents of so many lengths with this sum; few of them.
fn products(lengths: usize, degree: i32) -> Vec<Vec<i32>> {
    let mut all: Vec<Vec<i32>> = vec![vec![]];
    for _ in 0..lengths {
        let longer = |p: &Vec<i32>| {
            let p = p.clone();
            (-POWER..=POWER).map(move |power| [p.clone(), vec![power]].concat())
        };
        all = all.iter().flat_map(longer).collect();
        let size = |p: &[i32]| p.iter().map(|x| x.abs()).sum::<i32>();
        all.retain(|p| size(p) <= 4);
        all.sort_by_key(|p| size(p));
    }
    all.retain(|p| p.iter().sum::<i32>() == degree);
    all.truncate(MAX_PRODUCTS);
    all
}
