//! Polynomials whose monomials are a few words: all exponents side by side, so that a product of monomials is a sum of words.
//!
//! Polynomials of the crate `symbolic` may have any number of atoms; torques have a hundred or so with small exponents, and
//! millions of products of terms.

use denavit_symbolic::Rational;
use rustc_hash::FxHashMap;

/// The number of an atom in its ring.
pub(super) type Atom = u16;

/// Words of a monomial that come first: 128 atoms with exponents up to 7.
pub(super) const NARROW: usize = 8;
/// Words of a monomial where these are too few: 256 atoms with exponents up to 7.
pub(super) const LONG: usize = 16;
/// Words of a monomial where exponents are large: 256 atoms with exponents up to 32,767.
pub(super) const WIDE: usize = 64;

/// Bits of an exponent; the highest of them stays 0.
const fn bits(words: usize) -> u32 {
    if words <= LONG { 4 } else { 16 }
}

/// A product of powers of atoms.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(super) struct Monomial<const W: usize>([u64; W]);

impl<const W: usize> Monomial<W> {
    const ONE: Self = Monomial([0; W]);
    /// The largest exponent.
    const LARGEST: u64 = (1 << (bits(W) - 1)) - 1;
    /// How many atoms there may be.
    pub const ATOMS: usize = W * (64 / bits(W) as usize);

    /// The word of an atom, and where in it the exponent begins.
    fn place(atom: Atom) -> (usize, u32) {
        let each = 64 / bits(W);
        ((u32::from(atom) / each) as usize, u32::from(atom) % each * bits(W))
    }

    /// The bits of an atom's exponent but the lowest: it is above 1 where one of them is set.
    pub fn above_one(atom: Atom) -> Self {
        let (word, shift) = Self::place(atom);
        let mut all = Self::ONE;
        all.0[word] = (Self::LARGEST - 1) << shift;
        all
    }

    /// An atom, of which there may be so many.
    pub fn atom(atom: Atom) -> Self {
        let (word, shift) = Self::place(atom);
        let mut all = Self::ONE;
        all.0[word] = 1 << shift;
        all
    }

    /// `atomⁿ`; nothing beyond what can be stored.
    pub fn power(atom: Atom, exponent: u64) -> Option<Self> {
        let (word, shift) = Self::place(atom);
        let mut all = Self::ONE;
        *all.0.get_mut(word)? = (exponent <= Self::LARGEST).then_some(exponent)? << shift;
        Some(all)
    }

    /// The exponent of an atom.
    pub fn exponent(&self, atom: Atom) -> u64 {
        let (word, shift) = Self::place(atom);
        self.0[word] >> shift & Self::LARGEST
    }

    /// The product; nothing where an exponent is beyond what can be stored.
    pub fn times(&self, o: &Self) -> Option<Self> {
        const { assert!(64 % bits(W) == 0) };
        let all: [u64; W] = std::array::from_fn(|i| self.0[i] + o.0[i]);
        // The highest bit of each field.
        let full = (1 << (bits(W) - 1)) * (u64::MAX / ((1 << bits(W)) - 1));
        let beyond = all.iter().fold(0, |any, word| any | word) & full;
        (beyond == 0).then_some(Monomial(all))
    }

    /// `self / o`, for an `o` that divides it.
    pub fn over(&self, o: &Self) -> Self {
        Monomial(std::array::from_fn(|i| self.0[i] - o.0[i]))
    }

    /// Bits that both have.
    pub fn and(&self, o: &Self) -> Self {
        Monomial(std::array::from_fn(|i| self.0[i] & o.0[i]))
    }

    /// Bits that one of them has.
    pub fn or(&self, o: &Self) -> Self {
        Monomial(std::array::from_fn(|i| self.0[i] | o.0[i]))
    }

    /// True for the monomial 1.
    pub fn is_one(&self) -> bool {
        *self == Self::ONE
    }

    /// The first atom of which a bit is set.
    pub fn first(&self) -> Option<Atom> {
        let word = self.0.iter().position(|w| *w != 0)?;
        let each = (64 / bits(W)) as usize;
        Atom::try_from(word * each + (self.0[word].trailing_zeros() / bits(W)) as usize).ok()
    }

    /// Atoms and their exponents.
    pub fn factors(mut self) -> Vec<(Atom, u64)> {
        let mut all = vec![];
        while let Some(atom) = self.first() {
            let exponent = self.exponent(atom);
            all.push((atom, exponent));
            let (word, shift) = Self::place(atom);
            self.0[word] &= !(Self::LARGEST << shift);
        }
        all
    }
}

impl<const W: usize> Default for Monomial<W> {
    fn default() -> Self {
        Self::ONE
    }
}

/// A sum of terms, sorted by monomial, without zero coefficients.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct Poly<const W: usize>(Vec<(Monomial<W>, Rational)>);

impl<const W: usize> Poly<W> {
    pub fn zero() -> Self {
        Poly(vec![])
    }

    pub fn constant(r: Rational) -> Self {
        Self::term(Monomial::ONE, r)
    }

    pub fn one() -> Self {
        Self::constant(Rational::ONE)
    }

    pub fn atom(atom: Atom) -> Self {
        Poly(vec![(Monomial::atom(atom), Rational::ONE)])
    }

    pub fn term(m: Monomial<W>, r: Rational) -> Self {
        if r.is_zero() { Self::zero() } else { Poly(vec![(m, r)]) }
    }

    /// From terms in any order, repeated ones added up.
    pub fn from_terms(terms: Vec<(Monomial<W>, Rational)>) -> Self {
        let mut all = terms;
        if all.len() > SHORT {
            let mut table: FxHashMap<Monomial<W>, Rational> = FxHashMap::default();
            table.reserve(all.len() / 2);
            for (m, r) in all {
                table.entry(m).and_modify(|sum| *sum = &*sum + &r).or_insert(r);
            }
            all = table.into_iter().collect();
        }
        all.sort_unstable_by_key(|t| t.0);
        all.dedup_by(|next, sum| {
            let is_like = next.0 == sum.0;
            if is_like {
                sum.1 = &sum.1 + &next.1;
            }
            is_like
        });
        all.retain(|t| !t.1.is_zero());
        Poly(all)
    }

    /// From terms in any order, each there once and none of them 0.
    pub fn from_different(mut terms: Vec<(Monomial<W>, Rational)>) -> Self {
        terms.sort_unstable_by_key(|t| t.0);
        Poly(terms)
    }

    /// The terms, sorted by monomial.
    pub fn terms(&self) -> &[(Monomial<W>, Rational)] {
        &self.0
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value if the polynomial is a constant.
    pub fn as_constant(&self) -> Option<Rational> {
        match &self.0[..] {
            [] => Some(Rational::ZERO),
            [(m, r)] if m.is_one() => Some(r.clone()),
            _ => None,
        }
    }

    pub fn plus(&self, o: &Self) -> Self {
        self.merged(o, |r| r.clone())
    }

    pub fn minus(&self, o: &Self) -> Self {
        self.merged(o, |r| -r)
    }

    /// The sum, coefficients of the other as they are seen.
    fn merged(&self, o: &Self, seen: impl Fn(&Rational) -> Rational) -> Self {
        let (mut a, mut b) = (self.0.iter().peekable(), o.0.iter().peekable());
        let mut all = Vec::with_capacity(self.0.len() + o.0.len());
        while let (Some(x), Some(y)) = (a.peek(), b.peek()) {
            match x.0.cmp(&y.0) {
                std::cmp::Ordering::Less => {
                    all.push((*x).clone());
                    a.next();
                }
                std::cmp::Ordering::Greater => {
                    all.push((y.0, seen(&y.1)));
                    b.next();
                }
                std::cmp::Ordering::Equal => {
                    let r = &x.1 + &seen(&y.1);
                    if !r.is_zero() {
                        all.push((x.0, r));
                    }
                    a.next();
                    b.next();
                }
            }
        }
        all.extend(a.cloned());
        all.extend(b.map(|(m, r)| (*m, seen(r))));
        Poly(all)
    }

    /// The multiple `r·self`.
    pub fn scaled(&self, r: &Rational) -> Self {
        if r.is_zero() {
            return Poly::zero();
        }
        Poly(self.0.iter().map(|(m, c)| (*m, c * r)).collect())
    }
}

/// The longest list that is sorted at once: a table takes longer.
const SHORT: usize = 48;

#[cfg(test)]
mod tests {
    use super::*;

    /// Products, quotients and what has no place, in each width.
    #[test]
    fn monomials_are_products_of_powers() {
        fn hold<const W: usize>() {
            let power = |atom, n| Monomial::<W>::power(atom, n).unwrap();
            let last = (Monomial::<W>::ATOMS - 1) as Atom;
            let (a, b) = (power(3, 2), power(last, Monomial::<W>::LARGEST));
            let product = a.times(&b).unwrap();
            assert_eq!(product.factors(), [(3, 2), (last, Monomial::<W>::LARGEST)]);
            assert_eq!(product.over(&a), b);
            assert_eq!(b.times(&power(last, 1)), None);
            assert_eq!(Monomial::<W>::power(last + 1, 1), None);
            assert_eq!(Monomial::<W>::power(0, Monomial::<W>::LARGEST + 1), None);
            assert!(power(3, 1).and(&Monomial::above_one(3)).is_one());
            assert_eq!(power(3, 3).and(&Monomial::above_one(3)).first(), Some(3));
        }
        hold::<NARROW>();
        hold::<LONG>();
        hold::<WIDE>();
    }

    /// (a + 2b)(a − 2b) = a² − 4b², by a list and by a table.
    #[test]
    fn like_terms_are_added_up() {
        let term = |a: u64, b: u64, n: i64| {
            let [a, b] = [(0, a), (1, b)].map(|(atom, n)| Monomial::<NARROW>::power(atom, n).unwrap());
            (a.times(&b).unwrap(), Rational::from(n))
        };
        let terms = vec![term(2, 0, 1), term(1, 1, 2), term(1, 1, -2), term(0, 2, -4)];
        let wanted = Poly::from_different(vec![term(2, 0, 1), term(0, 2, -4)]);
        assert_eq!(Poly::from_terms(terms.clone()), wanted);
        let many = Poly::from_terms((0..50).flat_map(|_| terms.clone()).collect());
        assert_eq!(many, wanted.scaled(&Rational::from(50)));
        assert_eq!(many.minus(&wanted.scaled(&Rational::from(49))), wanted);
    }
}
