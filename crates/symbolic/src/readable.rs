//! The form that a person would write: `C1(C23(C4C5C6 − S4S6) − S23S5C6) − S1(S4C5C6 + C4S6)`.
//!
//! A canonical polynomial is collected along the chain of its generator angles: split at the first angle that
//! occurs, C·A + S·B + R, then each part in turn. Other orders are tried; the cost is the number of literals
//! printed. [`simplify`] also looks for angle sums that shorten the formula (C2C3 − S2S3 becomes C23).

use crate::expr::{Expr, Symbol};
use crate::poly::{Atom, Monomial, Poly};
use crate::rational::Rational;
use crate::ring::{AtomKind, Refusal, Ring};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A formula in readable form, proved equal to the one it was made from.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The formula.
    pub expr: Expr,
    /// Denominators of the original, which must not be 0.
    pub conditions: Vec<Expr>,
}

/// The readable form of a formula, over whatever angle sums make it shortest.
///
/// # Errors
/// If no canonical form exists or it is too large; see [`Refusal`].
pub fn simplify(e: Expr, symbols: &[Symbol]) -> Result<Simplified, Refusal> {
    let mut ring = shortened(Ring::new(&[e], symbols), e, symbols)?;
    simplify_in(&mut ring, e)
}

/// The ring with the basis of angle sums over which a formula has the fewest terms, sought from that of `ring`.
pub(crate) fn shortened(mut ring: Ring, e: Expr, symbols: &[Symbol]) -> Result<Ring, Refusal> {
    let mut fewest = terms(&mut ring, e)?;
    let mut basis = ring.basis().to_vec();
    let mut work = MAX_SEARCH.saturating_sub(ring.spent());
    // Exchange one generator for its sum or difference with another while that leaves fewer terms.
    while basis.len() <= MAX_ANGLES_MERGED {
        let mut improved = None;
        for i in 0..basis.len() {
            for j in (0..basis.len()).filter(|&j| j != i) {
                for sign in [1, -1] {
                    let mut candidate = basis.clone();
                    candidate[i] = basis[i].plus(&basis[j].scaled(&Rational::from(sign)));
                    if work == 0 {
                        break;
                    }
                    let mut other = Ring::with_basis(&candidate, &[e], symbols);
                    let found = terms(&mut other, e);
                    work = work.saturating_sub(other.spent());
                    if let Ok(n) = found
                        && n < fewest
                    {
                        (fewest, improved) = (n, Some((candidate, other)));
                    }
                }
            }
        }
        match improved {
            Some((candidate, other)) => (basis, ring) = (candidate, other),
            None => break,
        }
    }
    Ok(ring)
}

/// What the search for a basis may take, in products of terms: some seconds.
const MAX_SEARCH: u64 = 2_000_000;

/// The number of terms of the canonical form.
fn terms(ring: &mut Ring, e: Expr) -> Result<usize, Refusal> {
    let form = ring.normal(e)?;
    Ok(form.num.terms().len() + form.den.iter().map(|f| f.0.terms().len()).sum::<usize>())
}

/// Angles beyond which merged sums are no longer searched for (the search is quadratic in them).
const MAX_ANGLES_MERGED: usize = 8;

/// The readable form over the angle sums that occur; the formula itself where there is none. What is identically 0
/// or 1 comes out as that number.
pub fn settled(e: Expr) -> Expr {
    simplify_in(&mut Ring::new(&[e], &[]), e).map_or(e, |form| form.expr)
}

/// Terms beyond which nobody reads a formula.
const MAX_TERMS: usize = 500;

/// The readable form over the basis of `ring`.
///
/// # Errors
/// If `e` has no canonical form in the ring; see [`Refusal`].
pub fn simplify_in(ring: &mut Ring, e: Expr) -> Result<Simplified, Refusal> {
    let form = ring.normal(e)?;
    if form.den.iter().map(|f| &f.0).chain([&form.num]).any(|p| p.terms().len() > MAX_TERMS) {
        return Err(Refusal::TooLarge);
    }
    let mut den = Expr::int(1);
    let mut conditions = vec![];
    for (p, n) in &form.den {
        let factor = show(ring, p);
        conditions.push(factor);
        den = den * factor.powi(i32::try_from(*n).map_err(|_| Refusal::TooLarge)?);
    }
    let expr = show(ring, &form.num) / den;
    // A form that is not proved equal is not shown.
    let check = ring.normal(expr - e)?;
    if check.num.is_zero() {
        Ok(Simplified { expr, conditions })
    } else {
        Ok(Simplified { expr: e, conditions })
    }
}

/// A polynomial of the ring in readable form.
pub fn show(ring: &Ring, p: &Poly) -> Expr {
    let mut collector = Collector { ring, memo: FxHashMap::default(), budget: ALTERNATIVES };
    let plain = collector.form(p);
    // S² = 1 − C² can be used the other way round, angle by angle.
    let (mut best, mut shown) = (p.clone(), plain);
    for (cos, sin) in ring.pairs() {
        if best.terms().iter().any(|t| t.0.exponent(cos) >= 2) {
            let turned = in_sines(&best, cos, sin);
            let form = collector.form(&turned);
            if form.cost < shown.cost {
                (best, shown) = (turned, form);
            }
        }
    }
    shown.expr
}

/// How many sub-polynomials may be shown in other orders than along the chain.
const ALTERNATIVES: u32 = 60;

/// The polynomial with C^(2k+e) replaced by (1 − S²)^k C^e.
fn in_sines(p: &Poly, cos: Atom, sin: Atom) -> Poly {
    let mut terms: Vec<(Monomial, Rational)> = vec![];
    for (m, r) in p.terms() {
        let exponent = m.exponent(cos);
        let rest = m.without(cos).times(&Monomial::power(cos, exponent % 2));
        let k = i64::from(exponent / 2);
        let mut binomial = Rational::ONE;
        for i in 0..=k {
            // (1 − S²)^k = Σ (k over i)(−S²)^i
            let power = Monomial::power(sin, 2 * i as u16);
            let sign = if i % 2 == 0 { Rational::ONE } else { -Rational::ONE };
            terms.push((rest.times(&power), r * &(&binomial * &sign)));
            binomial = &(&binomial * &Rational::from(k - i)) / &Rational::from(i + 1);
        }
    }
    Poly::from_terms(terms)
}

/// The number of literals in a formula: every symbol, sine, cosine and number counts one.
pub fn literals(e: Expr) -> u64 {
    use crate::expr::Node;
    let mut cost: FxHashMap<Expr, u64> = FxHashMap::default();
    for part in Expr::postorder(&[e]) {
        let n = match part.node() {
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sin(_) | Node::Cos(_) => 1,
            Node::Neg(a) => cost[&a],
            Node::Sqrt(a) | Node::Sign(a) => cost[&a].saturating_add(1),
            Node::Pow(a, n) => cost[&a].saturating_mul(u64::from(n.unsigned_abs()).min(3)),
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) | Node::Atan2(a, b) => {
                cost[&a].saturating_add(cost[&b])
            }
        };
        cost.insert(part, n);
    }
    cost[&e]
}

/// A formula and what its place in a sum depends on.
#[derive(Clone)]
struct Form {
    expr: Expr,
    /// Literals printed.
    cost: u32,
    /// The first angle along the chain whose sine or cosine occurs; `None` sorts before all of them.
    first: Option<usize>,
}

/// What a polynomial can be split at.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Angle(usize),
    Single(Atom),
}

struct Collector<'a> {
    ring: &'a Ring,
    memo: FxHashMap<Poly, Rc<Vec<(bool, Form)>>>,
    budget: u32,
}

impl Collector<'_> {
    /// A polynomial: its common monomial times a sum.
    fn form(&mut self, p: &Poly) -> Form {
        if p.is_zero() {
            return Form { expr: Expr::int(0), cost: 0, first: None };
        }
        let content = p.monomial_content();
        let rest = p.over(&content);
        let number = common_number(&rest);
        let rest = rest.scaled(&number.recip().unwrap_or(Rational::ONE));
        let pieces = self.pieces(&rest);
        let (negative, sum) = self.sum(&pieces);
        let number = if negative { -number } else { number };
        let mut product = self.monomial(&content);
        if rest.as_constant().is_none() {
            product = Form {
                expr: product.expr * sum.expr,
                cost: product.cost + sum.cost,
                first: earlier(product.first, sum.first),
            };
        }
        let cost = product.cost + u32::from(!number.abs().is_one() && !product.expr.is_one());
        Form { expr: Expr::from(number) * product.expr, cost: cost.max(1), first: product.first }
    }

    /// Numbers, then symbols, then sines and cosines along the chain.
    fn monomial(&self, m: &Monomial) -> Form {
        let rank = |a: Atom| match self.ring.kind(a) {
            AtomKind::Surd(_) => (0, 0, a),
            AtomKind::Pi | AtomKind::Symbol(_) => (1, 0, a),
            AtomKind::Root(_) | AtomKind::Opaque(_) => (2, 0, a),
            AtomKind::Cos(g) | AtomKind::Sin(g) => (3, *g, a),
        };
        let mut factors = m.factors().to_vec();
        factors.sort_by_key(|f| rank(f.0));
        let expr = factors.iter().fold(Expr::int(1), |x, &(a, e)| x * self.ring.atom_expr(a).powi(e.into()));
        let first = factors.iter().map(|f| rank(f.0)).find(|r| r.0 == 3).map(|r| r.1);
        Form { expr, cost: factors.iter().map(|f| u32::from(f.1.min(3))).sum(), first }
    }

    /// Signed addends in the order in which they are written. True stands for minus.
    fn sum(&self, pieces: &[(bool, Form)]) -> (bool, Form) {
        let all_negative = pieces.iter().all(|p| p.0);
        let mut order: Vec<&(bool, Form)> = pieces.iter().collect();
        order.sort_by_key(|(negative, f)| {
            (*negative && !all_negative, f.first.is_some(), std::cmp::Reverse(f.cost), f.first)
        });
        let expr = order.iter().fold(Expr::int(0), |sum, (negative, f)| {
            if *negative && !all_negative { sum - f.expr } else { sum + f.expr }
        });
        let cost = order.iter().map(|p| p.1.cost).sum();
        let first = order.iter().fold(None, |a, p| earlier(a, p.1.first));
        (all_negative, Form { expr, cost, first })
    }

    /// The addends of a polynomial without common factor, by the cheapest split found.
    fn pieces(&mut self, p: &Poly) -> Rc<Vec<(bool, Form)>> {
        if let Some(known) = self.memo.get(p) {
            return known.clone();
        }
        let mut best: Option<(u32, Vec<(bool, Form)>)> = None;
        for group in self.groups(p) {
            let pieces = self.split(p, group);
            let cost = pieces.iter().map(|x| x.1.cost).sum();
            if best.as_ref().is_none_or(|b| cost < b.0) {
                best = Some((cost, pieces));
            }
            if self.budget == 0 {
                break;
            }
            self.budget -= 1;
        }
        let pieces = match best {
            Some((_, pieces)) => pieces,
            None => p.terms().iter().map(|t| self.term(t)).collect(),
        };
        let pieces = Rc::new(pieces);
        self.memo.insert(p.clone(), pieces.clone());
        pieces
    }

    fn term(&self, (m, r): &(Monomial, Rational)) -> (bool, Form) {
        let product = self.monomial(m);
        let size = r.abs();
        let cost = (product.cost + u32::from(!size.is_one() || m.is_one())).max(1);
        (r.is_negative(), Form { expr: Expr::from(size) * product.expr, cost, ..product })
    }

    /// Where to split: the angles in chain order, then single atoms that more than one term holds.
    fn groups(&self, p: &Poly) -> Vec<Group> {
        if p.terms().len() < 2 {
            return vec![];
        }
        let mut terms_with: BTreeMap<Group, usize> = BTreeMap::new();
        for (m, _) in p.terms() {
            let mut of_term: Vec<Group> = m.factors().iter().map(|f| self.group(f.0)).collect();
            of_term.dedup();
            for g in of_term {
                *terms_with.entry(g).or_default() += 1;
            }
        }
        terms_with.into_iter().filter(|&(_, n)| n > 1).map(|(g, _)| g).collect()
    }

    fn group(&self, atom: Atom) -> Group {
        match self.ring.kind(atom) {
            AtomKind::Cos(g) | AtomKind::Sin(g) => Group::Angle(*g),
            _ => Group::Single(atom),
        }
    }

    /// `Σ (power of the group)·A + R`, the addends of R on the same level.
    fn split(&mut self, p: &Poly, group: Group) -> Vec<(bool, Form)> {
        let mut parts: BTreeMap<Monomial, Vec<(Monomial, Rational)>> = BTreeMap::new();
        for (m, r) in p.terms() {
            let (mut key, mut rest) = (Monomial::one(), m.clone());
            for &(a, e) in m.factors() {
                if self.group(a) == group {
                    key = key.times(&Monomial::power(a, e));
                    rest = rest.without(a);
                }
            }
            parts.entry(key).or_default().push((rest, r.clone()));
        }
        let remainder = parts.remove(&Monomial::one());
        let mut pieces = vec![];
        for (key, terms) in parts {
            let factor = Poly::from_terms(terms.into_iter().map(|(m, r)| (m.times(&key), r)));
            if let [term] = factor.terms() {
                pieces.push(self.term(term));
            } else {
                let form = self.form(&factor);
                let negative = leads_negative(form.expr);
                let expr = if negative { -form.expr } else { form.expr };
                pieces.push((negative, Form { expr, ..form }));
            }
        }
        if let Some(terms) = remainder {
            pieces.extend(self.pieces(&Poly::from_terms(terms)).iter().cloned());
        }
        pieces
    }
}

/// The earlier of two angles, if any.
fn earlier(a: Option<usize>, b: Option<usize>) -> Option<usize> {
    a.into_iter().chain(b).min()
}

fn leads_negative(e: Expr) -> bool {
    use crate::expr::Node;
    match e.node() {
        Node::Neg(_) => true,
        Node::Number(r) => r.is_negative(),
        _ => false,
    }
}

/// The number to pull out of a sum: the coefficient that all terms share up to their sign, else a common
/// denominator is left where it is.
fn common_number(p: &Poly) -> Rational {
    let mut sizes = p.terms().iter().map(|t| t.1.abs());
    match sizes.next() {
        Some(first) if sizes.all(|r| r == first) => first,
        _ => Rational::ONE,
    }
}
