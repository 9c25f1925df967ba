//! Polynomials in atoms with C² + S² = 1 for angles, a·(1/a) = 1 for parameters and √r² = r, reduced by these.

use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Products of terms up to which expansion goes; beyond, nothing is known.
const BUDGET: u64 = 2_000_000;
/// Divisors up to which the square of a root is searched for.
const PRIMES: i64 = 1000;
/// How often an angle may count in a sum.
const MULTIPLE: i64 = 16;

/// What a polynomial is differentiated by.
#[derive(Clone, Copy)]
pub(super) enum Coordinate {
    Angle(usize),
    Length(Atom),
}

/// A sine and a cosine.
pub(super) type Pair = (Poly, Poly);

/// Integer multiples of angles that have sines and cosines for atoms, multiples of π, and radians.
#[derive(Clone, Default)]
pub(super) struct Sum {
    terms: BTreeMap<usize, i64>,
    turns: Rational,
    radians: Rational,
}

impl Sum {
    pub fn of(angle: usize) -> Self {
        Sum { terms: BTreeMap::from([(angle, 1)]), ..Sum::default() }
    }

    pub fn add(&mut self, o: &Sum, times: i64) {
        let k = Rational::from(times);
        self.turns = &self.turns + &(&o.turns * &k);
        self.radians = &self.radians + &(&o.radians * &k);
        for (&angle, k) in &o.terms {
            *self.terms.entry(angle).or_default() += times * k;
        }
        self.terms.retain(|_, k| *k != 0);
    }

    pub fn add_quarters(&mut self, quarters: u8) {
        self.turns = &self.turns + &Rational::new(quarters.into(), 2);
    }
}

/// The atoms with their rules.
#[derive(Default)]
pub(super) struct Ring {
    /// For each atom that is a sine the cosine, for each that is an inverse what it is of, for a root the square.
    rules: Vec<Option<Rule>>,
    parameters: FxHashMap<Symbol, Atom>,
    /// Cosine and sine of each angle.
    angles: Vec<[Atom; 2]>,
    constants: FxHashMap<Expr, usize>,
    inverses: FxHashMap<Atom, Atom>,
    roots: FxHashMap<Rational, Atom>,
    spent: u64,
}

#[derive(Clone)]
enum Rule {
    Sine(Atom),
    Inverse(Atom),
    /// The square root of a number.
    Root(Rational),
}

impl Ring {
    fn atom(&mut self, rule: Option<Rule>) -> Option<Atom> {
        let atom = Atom::try_from(self.rules.len()).ok()?;
        self.rules.push(rule);
        Some(atom)
    }

    /// An atom without a rule.
    pub fn free(&mut self) -> Option<Atom> {
        self.atom(None)
    }

    pub fn parameter(&mut self, s: Symbol) -> Option<Poly> {
        if let Some(&atom) = self.parameters.get(&s) {
            return Some(Poly::atom(atom));
        }
        let atom = self.atom(None)?;
        self.parameters.insert(s, atom);
        Some(Poly::atom(atom))
    }

    pub fn angle(&mut self) -> Option<usize> {
        let cosine = self.atom(None)?;
        let sine = self.atom(Some(Rule::Sine(cosine)))?;
        self.angles.push([cosine, sine]);
        Some(self.angles.len() - 1)
    }

    /// A term in its normal form.
    fn reduced(&self, m: Monomial, r: Rational, into: &mut Vec<(Monomial, Rational)>) {
        for &(atom, exponent) in m.factors() {
            match &self.rules[usize::from(atom)] {
                Some(Rule::Sine(cosine)) if exponent > 1 => {
                    let rest = m.over(&Monomial::power(atom, 2));
                    let by_cosine = rest.times(&Monomial::power(*cosine, 2));
                    self.reduced(by_cosine, -&r, into);
                    return self.reduced(rest, r, into);
                }
                Some(Rule::Root(square)) if exponent > 1 => {
                    return self.reduced(m.over(&Monomial::power(atom, 2)), &r * square, into);
                }
                Some(Rule::Inverse(of)) if m.exponent(*of) > 0 => {
                    let common = exponent.min(m.exponent(*of));
                    let of = *of;
                    let pair = Monomial::power(atom, common).times(&Monomial::power(of, common));
                    return self.reduced(m.over(&pair), r, into);
                }
                _ => {}
            }
        }
        into.push((m, r));
    }

    pub fn mul(&mut self, a: &Poly, b: &Poly) -> Option<Poly> {
        self.spent += (a.terms().len() * b.terms().len()) as u64;
        if self.spent > BUDGET {
            return None;
        }
        let mut all = Vec::with_capacity(a.terms().len() * b.terms().len());
        for (m, r) in a.terms() {
            for (n, t) in b.terms() {
                self.reduced(m.times(n), r * t, &mut all);
            }
        }
        Some(Poly::from_terms(all))
    }

    /// One over a product of powers of parameters.
    pub fn inverse(&mut self, p: &Poly) -> Option<Poly> {
        let [(m, r)] = p.terms() else { return None };
        let mut all = Poly::constant(r.recip()?);
        for &(atom, exponent) in m.factors() {
            let over = match self.rules[usize::from(atom)].clone() {
                Some(Rule::Inverse(of)) => of,
                // 1/√r = √r/r
                Some(Rule::Root(square)) => {
                    all = all.scaled(&square.pow(-i32::from(exponent))?);
                    atom
                }
                Some(Rule::Sine(_)) => return None,
                None if !self.parameters.values().any(|p| *p == atom) => return None,
                None => match self.inverses.get(&atom) {
                    Some(&known) => known,
                    None => {
                        let over = self.atom(Some(Rule::Inverse(atom)))?;
                        self.inverses.insert(atom, over);
                        over
                    }
                },
            };
            all = self.mul(&all, &Poly::term(Monomial::power(over, exponent), Rational::ONE))?;
        }
        Some(all)
    }

    /// The square root of a number, as a multiple of roots of primes: so there is one form of √2·√3 and √6.
    pub fn root(&mut self, square: &Rational) -> Option<Poly> {
        let (over, under) = square.to_parts().filter(|p| p.0 >= 0)?;
        let mut rest = over.checked_mul(under)?;
        let mut all = Poly::constant(Rational::new(1, under));
        for p in 2..PRIMES {
            while rest % (p * p) == 0 && rest > 0 {
                rest /= p * p;
                all = all.scaled(&Rational::from(p));
            }
            if rest % p == 0 && rest > 0 {
                rest /= p;
                all = self.root_of(Rational::from(p), &all)?;
            }
        }
        self.root_of(Rational::from(rest), &all)
    }

    fn root_of(&mut self, square: Rational, times: &Poly) -> Option<Poly> {
        if let Some(root) = square.sqrt() {
            return Some(times.scaled(&root));
        }
        let atom = match self.roots.get(&square) {
            Some(&known) => known,
            None => {
                let atom = self.atom(Some(Rule::Root(square.clone())))?;
                self.roots.insert(square, atom);
                atom
            }
        };
        self.mul(times, &Poly::atom(atom))
    }

    pub fn slope(&mut self, p: &Poly, by: Coordinate) -> Option<Poly> {
        self.spent += p.terms().len() as u64;
        if self.spent > BUDGET {
            return None;
        }
        let mut all = vec![];
        for (m, r) in p.terms() {
            let mut add = |atom: Atom, inner: Option<(Atom, i64)>| {
                let exponent = m.exponent(atom);
                if exponent > 0 {
                    let mut rest = m.over(&Monomial::power(atom, 1));
                    let mut k = i64::from(exponent);
                    if let Some((other, sign)) = inner {
                        rest = rest.times(&Monomial::power(other, 1));
                        k *= sign;
                    }
                    self.reduced(rest, r * &Rational::from(k), &mut all);
                }
            };
            match by {
                Coordinate::Length(atom) => add(atom, None),
                Coordinate::Angle(angle) => {
                    let [cosine, sine] = self.angles[angle];
                    add(cosine, Some((sine, -1)));
                    add(sine, Some((cosine, 1)));
                }
            }
        }
        Some(Poly::from_terms(all))
    }

    pub fn pair(&mut self, sum: &Sum) -> Option<Pair> {
        let (mut s, mut c) = (Poly::zero(), Poly::one());
        for (&angle, &k) in &sum.terms {
            if k.abs() > MULTIPLE {
                return None;
            }
            let [cosine, sine] = self.angles[angle].map(Poly::atom);
            let sine = if k < 0 { Poly::zero().minus(&sine) } else { sine };
            for _ in 0..k.abs() {
                (s, c) = self.turned((s, c), (sine.clone(), cosine.clone()))?;
            }
        }
        let turns = &sum.turns * &Rational::from(2);
        let quarters = turns.floor();
        let rest = &(&turns - &quarters) * &Rational::new(1, 2);
        let constants = [Expr::from(rest) * Expr::pi(), Expr::from(sum.radians.clone())];
        for constant in constants.into_iter().filter(|e| !e.is_zero()) {
            let angle = self.named(constant)?;
            let [cosine, sine] = self.angles[angle].map(Poly::atom);
            (s, c) = self.turned((s, c), (sine, cosine))?;
        }
        let four = Rational::from(4);
        let quarters = &quarters - &(&(&quarters / &four).floor() * &four);
        for _ in 0..quarters.to_integer()? {
            (s, c) = (c, Poly::zero().minus(&s));
        }
        Some((s, c))
    }

    /// Sine and cosine of a sum of two angles.
    fn turned(&mut self, (s, c): Pair, (sine, cosine): Pair) -> Option<Pair> {
        let (sc, cs) = (self.mul(&s, &cosine)?, self.mul(&c, &sine)?);
        let (cc, ss) = (self.mul(&c, &cosine)?, self.mul(&s, &sine)?);
        Some((sc.plus(&cs), cc.minus(&ss)))
    }

    /// The angle that a constant is.
    fn named(&mut self, constant: Expr) -> Option<usize> {
        if let Some(&angle) = self.constants.get(&constant) {
            return Some(angle);
        }
        let angle = self.angle()?;
        self.constants.insert(constant, angle);
        Some(angle)
    }

    /// A sum of angles; those of joints are sums already.
    pub fn sum(&mut self, e: Expr, joints: &FxHashMap<Symbol, Sum>) -> Option<Sum> {
        let form = Angle::of(e);
        let mut all = Sum::default();
        for (term, k) in form.terms {
            let k = k.to_integer().filter(|k| k.abs() <= MULTIPLE)?;
            match term.as_symbol().and_then(|s| joints.get(&s)) {
                Some(own) => all.add(own, k),
                None => all.add(&Sum::of(self.named(term)?), k),
            }
        }
        all.turns = &all.turns + &form.turns;
        all.radians = &all.radians + &form.radians;
        Some(all)
    }

    /// A formula in parameters.
    pub fn constant(&mut self, e: Expr) -> Option<Poly> {
        let mut known: FxHashMap<Expr, Poly> = FxHashMap::default();
        let none = FxHashMap::default();
        for part in Expr::postorder(&[e]) {
            let of = |e: &Expr| known.get(e).cloned();
            let value = match part.node() {
                Node::Number(r) => Some(Poly::constant(r)),
                Node::Symbol(s) => Some(self.parameter(s)?),
                Node::Neg(a) => of(&a).map(|a| Poly::zero().minus(&a)),
                Node::Add(a, b) => of(&a).zip(of(&b)).map(|(a, b)| a.plus(&b)),
                Node::Sub(a, b) => of(&a).zip(of(&b)).map(|(a, b)| a.minus(&b)),
                Node::Mul(a, b) => match of(&a).zip(of(&b)) {
                    Some((a, b)) => Some(self.mul(&a, &b)?),
                    None => None,
                },
                Node::Div(a, b) => match of(&a).zip(of(&b)) {
                    Some((a, b)) => {
                        let over = self.inverse(&b)?;
                        Some(self.mul(&a, &over)?)
                    }
                    None => None,
                },
                Node::Pow(a, n) => match of(&a) {
                    Some(a) => {
                        let a = if n < 0 { self.inverse(&a)? } else { a };
                        let mut power = Poly::one();
                        for _ in 0..n.unsigned_abs().min(64) {
                            power = self.mul(&power, &a)?;
                        }
                        (n.unsigned_abs() <= 64).then_some(power)
                    }
                    None => None,
                },
                Node::Sin(a) | Node::Cos(a) => {
                    let sum = self.sum(a, &none)?;
                    let (s, c) = self.pair(&sum)?;
                    Some(if matches!(part.node(), Node::Sin(_)) { s } else { c })
                }
                Node::Sqrt(a) => match of(&a).and_then(|a| a.as_constant()) {
                    Some(square) => Some(self.root(&square)?),
                    None => None,
                },
                Node::Pi | Node::Sign(_) | Node::Atan2(..) => None,
            };
            if let Some(value) = value {
                known.insert(part, value);
            }
        }
        known.remove(&e)
    }
}

pub(super) type V3 = [Poly; 3];

impl Ring {
    pub fn dot(&mut self, a: &V3, b: &V3) -> Option<Poly> {
        let mut all = Poly::zero();
        for (x, y) in a.iter().zip(b) {
            all = all.plus(&self.mul(x, y)?);
        }
        Some(all)
    }

    pub fn cross(&mut self, a: &V3, b: &V3) -> Option<V3> {
        let mut minor = |i: usize, j: usize| Some(self.mul(&a[i], &b[j])?.minus(&self.mul(&a[j], &b[i])?));
        Some([minor(1, 2)?, minor(2, 0)?, minor(0, 1)?])
    }

    pub fn times(&mut self, rows: &[V3; 3], v: &V3) -> Option<V3> {
        Some([self.dot(&rows[0], v)?, self.dot(&rows[1], v)?, self.dot(&rows[2], v)?])
    }

    pub fn scaled(&mut self, v: &V3, by: &Poly) -> Option<V3> {
        Some([self.mul(&v[0], by)?, self.mul(&v[1], by)?, self.mul(&v[2], by)?])
    }
}

pub(super) fn sum(a: &V3, b: &V3) -> V3 {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}

pub(super) fn transposed(m: &[V3; 3]) -> [V3; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i].clone()))
}
