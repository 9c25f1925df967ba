//! Products of polynomials whose atoms obey rules: the square of an atom is a polynomial in earlier ones.
//!
//! S² → 1 − C² and √2² → 2 are such rules. What the atoms stand for, and what a product may cost, is the caller's.

use crate::poly::{Atom, Monomial, Poly, Sum};
use crate::rational::Rational;

/// The rules of numbered atoms.
///
/// ```
/// use denavit_symbolic::{poly::Poly, rules::Rules};
/// use std::convert::Infallible;
/// let (cos, sin) = (0, 1);
/// let mut rules = Rules::default();
/// rules.set_pair(cos, sin);
/// let [c, s] = [cos, sin].map(Poly::atom);
/// let free = |_, _: &_| Ok::<(), Infallible>(());
/// let Ok(product) = rules.times(&c.plus(&s), &c.minus(&s), free); // C² − S²
/// let Ok(square) = rules.times(&c, &c, free);
/// assert_eq!(product, square.plus(&square).minus(&Poly::one())); // 2C² − 1
/// ```
#[derive(Clone, Debug, Default)]
pub struct Rules {
    squares: Vec<Option<Poly>>,
}

/// A product under way: what is done, and what the rules apply to yet.
#[derive(Default)]
struct UnderWay {
    sum: Sum,
    pending: Vec<(Formed, Monomial, Rational)>,
}

/// How a term came to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Formed {
    /// As the product of two terms.
    Product,
    /// By a rule.
    Replacement,
}

impl Rules {
    /// From here on the square of the atom is replaced.
    pub fn set(&mut self, atom: Atom, square: Poly) {
        let at = usize::from(atom);
        if self.squares.len() <= at {
            self.squares.resize(at + 1, None);
        }
        self.squares[at] = Some(square);
    }

    /// The rule of a sine, S² → 1 − C².
    pub fn set_pair(&mut self, cos: Atom, sin: Atom) {
        let terms = [(Monomial::power(cos, 2), -Rational::ONE), (Monomial::one(), Rational::ONE)];
        self.set(sin, Poly::from_terms(terms));
    }

    /// What the square of an atom is replaced by.
    pub fn square(&self, atom: Atom) -> Option<&Poly> {
        self.squares.get(usize::from(atom))?.as_ref()
    }

    /// The product in normal form. Every term that is formed on the way has to be paid for, which may be refused.
    ///
    /// # Errors
    /// The first refusal.
    pub fn times<E>(
        &self,
        a: &Poly,
        b: &Poly,
        mut pay: impl FnMut(Formed, &Rational) -> Result<(), E>,
    ) -> Result<Poly, E> {
        let mut under_way = UnderWay::default();
        for (m, r) in a.terms() {
            for (n, t) in b.terms() {
                self.add(&mut under_way, m.times(n), r * t, &mut pay)?;
            }
        }
        Ok(under_way.sum.finish())
    }

    /// The square in normal form; two equal products are formed, and paid for, once.
    ///
    /// # Errors
    /// The first refusal.
    pub fn square_of<E>(
        &self,
        a: &Poly,
        mut pay: impl FnMut(Formed, &Rational) -> Result<(), E>,
    ) -> Result<Poly, E> {
        let mut under_way = UnderWay::default();
        let two = Rational::from(2);
        for (i, (m, r)) in a.terms().iter().enumerate() {
            self.add(&mut under_way, m.times(m), r * r, &mut pay)?;
            let twice = &two * r;
            for (n, t) in &a.terms()[i + 1..] {
                self.add(&mut under_way, m.times(n), &twice * t, &mut pay)?;
            }
        }
        Ok(under_way.sum.finish())
    }

    /// Adds a product of two terms, by the rules.
    fn add<E>(
        &self,
        UnderWay { sum, pending }: &mut UnderWay,
        m: Monomial,
        r: Rational,
        pay: &mut impl FnMut(Formed, &Rational) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut next = Some((Formed::Product, m, r));
        while let Some((formed, m, r)) = next {
            pay(formed, &r)?;
            match m.factors().iter().find_map(|&(atom, e)| Some((atom, e, self.of_power(atom, e)?))) {
                None => sum.add(m, r),
                Some((atom, exponent, square)) => {
                    let rest = m.without(atom).times(&Monomial::power(atom, exponent - 2));
                    let replaced =
                        |(n, t): &(Monomial, Rational)| (Formed::Replacement, rest.times(n), &r * t);
                    pending.extend(square.terms().iter().map(replaced));
                }
            }
            next = pending.pop();
        }
        Ok(())
    }

    /// The rule that applies to a power of an atom.
    fn of_power(&self, atom: Atom, exponent: u16) -> Option<&Poly> {
        if exponent < 2 { None } else { self.square(atom) }
    }
}
