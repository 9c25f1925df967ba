//! Polynomials in atoms with C² + S² = 1 for angles, a·(1/a) = 1 for parameters and √r² = r, reduced by these.
//!
//! The canonical form of the crate `symbolic` chooses its atoms by the formulas at hand, and is had from formulas. Here coordinates are
//! given beforehand, so that no sine of a sum of angles is written out, a quotient by a parameter is an atom and no denominator, and
//! values are had operation by operation: torques of six joints have tens of thousands of terms so, and would have millions there.
//! What is too large for the bounds below has no form: a caller takes it as not decided.

use super::packed::{Atom, Monomial, Poly};
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// Products of terms up to which expansion goes, those of long numbers counted by the square of their length; beyond, nothing is known.
const BUDGET: u64 = 2_000_000;
/// Terms of all values that are kept, counted likewise.
const KEPT: u64 = 4_000_000;
/// Divisors up to which the square of a root is searched for.
const PRIMES: i64 = 1000;
/// How often an angle may count in a sum.
pub(super) const MULTIPLE: u64 = 16;

/// What a polynomial is differentiated by.
#[derive(Clone, Copy)]
pub(super) enum Coordinate {
    Angle(usize),
    Length(Atom),
}

/// A sine and a cosine.
pub(super) type Pair<const W: usize> = (Poly<W>, Poly<W>);

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

    /// Nothing if an angle counts more often than has a form.
    pub fn add(&mut self, o: &Sum, times: i64) -> Option<()> {
        let k = Rational::from(times);
        self.turns = &self.turns + &(&o.turns * &k);
        self.radians = &self.radians + &(&o.radians * &k);
        for (&angle, k) in &o.terms {
            let sum = self.terms.entry(angle).or_default();
            *sum = times.checked_mul(*k).and_then(|k| sum.checked_add(k))?;
        }
        self.terms.retain(|_, k| *k != 0);
        Some(())
    }

    pub fn add_quarters(&mut self, quarters: u8) {
        self.turns = &self.turns + &Rational::new(quarters.into(), 2);
    }
}

/// The atoms with their rules; monomials are `W` words.
#[derive(Default)]
pub(super) struct Ring<const W: usize> {
    /// For each atom that is a sine the cosine, for each that is an inverse what it is of, for a root the square.
    rules: Vec<Option<Rule>>,
    parameters: FxHashMap<Symbol, Atom>,
    /// Cosine and sine of each angle.
    angles: Vec<[Atom; 2]>,
    constants: FxHashMap<Expr, usize>,
    /// Atoms with those that are their inverses.
    inverses: Vec<(Atom, Atom)>,
    roots: FxHashMap<Rational, Atom>,
    /// By what may be divided.
    divisible: FxHashSet<Atom>,
    /// Bits of exponents that are not those of a normal form: of sines and roots above 1.
    squares: Monomial<W>,
    /// Set where there were too few words.
    pub is_full: bool,
    spent: u64,
    kept: u64,
}

#[derive(Clone)]
enum Rule {
    Sine(Atom),
    Inverse(Atom),
    /// The square root of a number.
    Root(Rational),
}

/// The length of the longest number, in machine words: the time of a product goes by its square.
fn words<const W: usize>(p: &Poly<W>) -> u64 {
    p.terms().iter().map(|t| t.1.bits() / 64).max().unwrap_or(0)
}

impl<const W: usize> Ring<W> {
    fn atom(&mut self, rule: Option<Rule>) -> Option<Atom> {
        self.is_full |= self.rules.len() >= Monomial::<W>::ATOMS;
        let atom = Atom::try_from(self.rules.len()).ok().filter(|_| !self.is_full)?;
        if let Some(Rule::Sine(_) | Rule::Root(_)) = rule {
            self.squares = self.squares.or(&Monomial::above_one(atom));
        }
        self.rules.push(rule);
        Some(atom)
    }

    /// An atom without a rule.
    pub fn free(&mut self) -> Option<Atom> {
        self.atom(None)
    }

    pub fn parameter(&mut self, s: Symbol) -> Option<Poly<W>> {
        if let Some(&atom) = self.parameters.get(&s) {
            return Some(Poly::atom(atom));
        }
        let atom = self.atom(None)?;
        self.parameters.insert(s, atom);
        self.divisible.insert(atom);
        Some(Poly::atom(atom))
    }

    pub fn angle(&mut self) -> Option<usize> {
        let cosine = self.atom(None)?;
        let sine = self.atom(Some(Rule::Sine(cosine)))?;
        self.angles.push([cosine, sine]);
        Some(self.angles.len() - 1)
    }

    /// A product of monomials; nothing where there are too few words.
    fn product(&mut self, a: &Monomial<W>, b: &Monomial<W>) -> Option<Monomial<W>> {
        let product = a.times(b);
        self.is_full |= product.is_none();
        product
    }

    /// A term in its normal form; nothing if that has more terms than there may be.
    fn reduced(
        &mut self,
        m: Monomial<W>,
        r: Rational,
        into: &mut Vec<(Monomial<W>, Rational)>,
    ) -> Option<()> {
        if let Some(atom) = m.and(&self.squares).first() {
            let rest = m.over(&Monomial::power(atom, 2)?);
            return match &self.rules[usize::from(atom)] {
                Some(Rule::Root(square)) => {
                    let r = &r * square;
                    self.reduced(rest, r, into)
                }
                Some(Rule::Sine(cosine)) => {
                    let squared = Monomial::power(*cosine, 2)?;
                    let by_cosine = self.product(&rest, &squared)?;
                    self.reduced(by_cosine, -&r, into)?;
                    self.reduced(rest, r, into)
                }
                Some(Rule::Inverse(_)) | None => None,
            };
        }
        let mut m = m;
        for &(of, over) in &self.inverses {
            let common = m.exponent(of).min(m.exponent(over));
            if common > 0 {
                m = m.over(&Monomial::power(of, common)?).over(&Monomial::power(over, common)?);
            }
        }
        into.push((m, r));
        (into.len() as u64 <= BUDGET).then_some(())
    }

    /// Takes note of work; nothing if it is too much.
    fn spend(&mut self, work: u64) -> Option<()> {
        self.spent = self.spent.saturating_add(work);
        (self.spent <= BUDGET).then_some(())
    }

    /// Takes note of a value.
    fn keep(&mut self, p: Poly<W>) -> Option<Poly<W>> {
        self.kept = self.kept.saturating_add((p.terms().len() as u64).saturating_mul(words(&p).pow(2)));
        (self.kept <= KEPT).then_some(p)
    }

    /// The sum.
    pub fn plus(&mut self, a: &Poly<W>, b: &Poly<W>) -> Option<Poly<W>> {
        self.keep(a.plus(b))
    }

    /// The difference.
    pub fn minus(&mut self, a: &Poly<W>, b: &Poly<W>) -> Option<Poly<W>> {
        self.keep(a.minus(b))
    }

    /// Adds the terms of a product, or of its opposite, to others.
    fn gather(
        &mut self,
        a: &Poly<W>,
        b: &Poly<W>,
        is_negative: bool,
        all: &mut Vec<(Monomial<W>, Rational)>,
    ) -> Option<()> {
        let count = a.terms().len() * b.terms().len();
        self.spend((count as u64).saturating_mul((words(a) + words(b)).pow(2).div_ceil(4)))?;
        let known = all.len();
        all.reserve(count);
        for (m, r) in a.terms() {
            let r = if is_negative { -r } else { r.clone() };
            for (n, t) in b.terms() {
                let product = self.product(m, n)?;
                self.reduced(product, &r * t, all)?;
            }
        }
        self.spend((all.len() - known - count.min(all.len() - known)) as u64)
    }

    pub fn mul(&mut self, a: &Poly<W>, b: &Poly<W>) -> Option<Poly<W>> {
        let mut all = vec![];
        self.gather(a, b, false, &mut all)?;
        // With one term, of which no rule makes two, terms stay different.
        let [a, b] = [a, b].map(|p| p.terms().len());
        let product = if a.min(b) == 1 && all.len() == a.max(b) {
            Poly::from_different(all)
        } else {
            Poly::from_terms(all)
        };
        self.keep(product)
    }

    /// One over a product of powers of parameters.
    pub fn inverse(&mut self, p: &Poly<W>) -> Option<Poly<W>> {
        let [(m, r)] = p.terms() else { return None };
        let mut all = Poly::constant(r.recip()?);
        for (atom, exponent) in m.factors() {
            let over = match self.rules[usize::from(atom)].clone() {
                Some(Rule::Inverse(of)) => of,
                // 1/√r = √r/r
                Some(Rule::Root(square)) => {
                    all = all.scaled(&square.pow(-i32::try_from(exponent).ok()?)?);
                    atom
                }
                Some(Rule::Sine(_)) => return None,
                None if !self.divisible.contains(&atom) => return None,
                None => match self.inverses.iter().find(|i| i.0 == atom) {
                    Some(&(_, known)) => known,
                    None => {
                        let over = self.atom(Some(Rule::Inverse(atom)))?;
                        self.inverses.push((atom, over));
                        over
                    }
                },
            };
            all = self.mul(&all, &Poly::term(Monomial::power(over, exponent)?, Rational::ONE))?;
        }
        Some(all)
    }

    /// The square root of a number, as a multiple of roots of primes: so there is one form of √2·√3 and √6.
    pub fn root(&mut self, square: &Rational) -> Option<Poly<W>> {
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

    fn root_of(&mut self, square: Rational, times: &Poly<W>) -> Option<Poly<W>> {
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

    pub fn slope(&mut self, p: &Poly<W>, by: Coordinate) -> Option<Poly<W>> {
        self.spend(p.terms().len() as u64)?;
        let mut all = vec![];
        for (m, r) in p.terms() {
            let mut add = |ring: &mut Self, atom: Atom, inner: Option<(Atom, i64)>| -> Option<()> {
                let exponent = m.exponent(atom);
                if exponent > 0 {
                    let mut rest = m.over(&Monomial::atom(atom));
                    let mut k = exponent as i64;
                    if let Some((other, sign)) = inner {
                        rest = ring.product(&rest, &Monomial::atom(other))?;
                        k *= sign;
                    }
                    ring.reduced(rest, r * &Rational::from(k), &mut all)?;
                }
                Some(())
            };
            match by {
                Coordinate::Length(atom) => add(self, atom, None)?,
                Coordinate::Angle(angle) => {
                    let [cosine, sine] = self.angles[angle];
                    add(self, cosine, Some((sine, -1)))?;
                    add(self, sine, Some((cosine, 1)))?;
                }
            }
        }
        let slope = match by {
            Coordinate::Length(_) => Poly::from_different(all),
            Coordinate::Angle(_) => Poly::from_terms(all),
        };
        self.keep(slope)
    }

    pub fn pair(&mut self, sum: &Sum) -> Option<Pair<W>> {
        let (mut s, mut c) = (Poly::zero(), Poly::one());
        for (&angle, &k) in &sum.terms {
            if k.unsigned_abs() > MULTIPLE {
                return None;
            }
            let [cosine, sine] = self.angles[angle].map(Poly::atom);
            let sine = if k < 0 { Poly::zero().minus(&sine) } else { sine };
            for _ in 0..k.unsigned_abs() {
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
    fn turned(&mut self, (s, c): Pair<W>, (sine, cosine): Pair<W>) -> Option<Pair<W>> {
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
            let k = k.to_integer().filter(|k| k.unsigned_abs() <= MULTIPLE)?;
            match term.as_symbol().and_then(|s| joints.get(&s)) {
                Some(own) => all.add(own, k)?,
                None => all.add(&Sum::of(self.named(term)?), k)?,
            }
        }
        all.turns = &all.turns + &form.turns;
        all.radians = &all.radians + &form.radians;
        Some(all)
    }

    /// A formula in parameters.
    pub fn constant(&mut self, e: Expr) -> Option<Poly<W>> {
        let mut known: FxHashMap<Expr, Poly<W>> = FxHashMap::default();
        let none = FxHashMap::default();
        for part in Expr::postorder(&[e]) {
            let of = |e: &Expr| known.get(e).cloned();
            let value = match part.node() {
                Node::Number(r) => Some(Poly::constant(r)),
                Node::Symbol(s) => Some(self.parameter(s)?),
                Node::Neg(a) => of(&a).map(|a| Poly::zero().minus(&a)),
                Node::Add(a, b) => match of(&a).zip(of(&b)) {
                    Some((a, b)) => Some(self.plus(&a, &b)?),
                    None => None,
                },
                Node::Sub(a, b) => match of(&a).zip(of(&b)) {
                    Some((a, b)) => Some(self.minus(&a, &b)?),
                    None => None,
                },
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

pub(super) type V3<const W: usize> = [Poly<W>; 3];

impl<const W: usize> Ring<W> {
    pub fn dot(&mut self, a: &V3<W>, b: &V3<W>) -> Option<Poly<W>> {
        let mut all = vec![];
        for (x, y) in a.iter().zip(b) {
            self.gather(x, y, false, &mut all)?;
        }
        self.keep(Poly::from_terms(all))
    }

    pub fn cross(&mut self, a: &V3<W>, b: &V3<W>) -> Option<V3<W>> {
        let mut minor = |i: usize, j: usize| {
            let mut all = vec![];
            self.gather(&a[i], &b[j], false, &mut all)?;
            self.gather(&a[j], &b[i], true, &mut all)?;
            self.keep(Poly::from_terms(all))
        };
        Some([minor(1, 2)?, minor(2, 0)?, minor(0, 1)?])
    }

    pub fn times(&mut self, rows: &[V3<W>; 3], v: &V3<W>) -> Option<V3<W>> {
        Some([self.dot(&rows[0], v)?, self.dot(&rows[1], v)?, self.dot(&rows[2], v)?])
    }

    pub fn scaled(&mut self, v: &V3<W>, by: &Poly<W>) -> Option<V3<W>> {
        Some([self.mul(&v[0], by)?, self.mul(&v[1], by)?, self.mul(&v[2], by)?])
    }
}

pub(super) fn sum<const W: usize>(a: &V3<W>, b: &V3<W>) -> V3<W> {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}

pub(super) fn transposed<const W: usize>(m: &[V3<W>; 3]) -> [V3<W>; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i].clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::expansion::packed::NARROW;

    /// What is too large has no form, and takes neither time nor memory: powers, numbers, sums, squares of many sines.
    #[test]
    fn what_is_too_large_has_no_form() {
        let squared = |ring: &mut Ring<NARROW>, start: Poly<NARROW>| {
            let mut p = Some(start);
            for _ in 0..64 {
                p = p.and_then(|p| ring.mul(&p, &p));
            }
            p
        };
        let mut ring = Ring::<NARROW>::default();
        let x = ring.parameter(Symbol::new("x")).unwrap();
        assert_eq!(squared(&mut ring, x.clone()), None);
        let mut ring = Ring::<NARROW>::default();
        assert_eq!(squared(&mut ring, Poly::constant(Rational::new(3, 7))), None);
        let mut ring = Ring::<NARROW>::default();
        let mut product = Poly::one();
        for _ in 0..40 {
            let angle = ring.angle().unwrap();
            let (s, _) = ring.pair(&Sum::of(angle)).unwrap();
            product = ring.mul(&product, &s).unwrap();
        }
        assert_eq!(ring.mul(&product, &product), None);
        let mut ring = Ring::<NARROW>::default();
        let mut sum = Sum::of(ring.angle().unwrap());
        let double = |sum: &mut Sum| {
            let own = sum.clone();
            sum.add(&own, 16)
        };
        assert_eq!((0..64).try_for_each(|_| double(&mut sum)), None);
        // A sum that is kept over and over.
        let mut ring = Ring::<NARROW>::default();
        let many = Poly::from_terms((0..100).map(|k| (Monomial::atom(k), Rational::ONE)).collect());
        let kept = (0..1_000_000).try_fold(many.clone(), |all, _| ring.plus(&all, &many));
        assert_eq!(kept, None);
    }
}
