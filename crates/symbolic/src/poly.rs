//! Sparse polynomials with rational coefficients in numbered atoms.
//!
//! A polynomial alone knows no rules between its atoms; those (C² + S² = 1, √2² = 2) belong to a
//! [`Ring`](crate::Ring), whose products are reduced by them.

use crate::expr::Expr;
use crate::rational::Rational;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

/// The number of an atom in its ring.
pub type Atom = u16;

/// A product of powers of atoms, sorted by atom.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Monomial(SmallVec<[(Atom, u16); 8]>);

impl Monomial {
    /// The monomial 1.
    pub fn one() -> Self {
        Self::default()
    }

    /// `atomⁿ`
    pub fn power(atom: Atom, exponent: u16) -> Self {
        let mut m = SmallVec::new();
        if exponent > 0 {
            m.push((atom, exponent));
        }
        Monomial(m)
    }

    /// Atoms and their exponents, sorted by atom.
    pub fn factors(&self) -> &[(Atom, u16)] {
        &self.0
    }

    /// The exponent of an atom, 0 if it does not occur.
    pub fn exponent(&self, atom: Atom) -> u16 {
        self.0.iter().find(|f| f.0 == atom).map_or(0, |f| f.1)
    }

    /// True for the monomial 1.
    pub fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    /// The product; exponents saturate at the largest one that can be stored, which the budget of a ring
    /// keeps out of reach.
    pub fn times(&self, o: &Monomial) -> Monomial {
        let (mut a, mut b) = (self.0.iter().peekable(), o.0.iter().peekable());
        let mut out = SmallVec::with_capacity(self.0.len() + o.0.len());
        loop {
            match (a.peek(), b.peek()) {
                (Some(x), Some(y)) if x.0 == y.0 => {
                    out.push((x.0, x.1.saturating_add(y.1)));
                    a.next();
                    b.next();
                }
                (Some(x), Some(y)) if x.0 < y.0 => {
                    out.push(**x);
                    a.next();
                }
                (_, Some(y)) => {
                    out.push(**y);
                    b.next();
                }
                (Some(x), None) => {
                    out.push(**x);
                    a.next();
                }
                (None, None) => return Monomial(out),
            }
        }
    }

    /// The monomial without `atom`.
    pub fn without(&self, atom: Atom) -> Monomial {
        Monomial(self.0.iter().copied().filter(|f| f.0 != atom).collect())
    }

    /// The powers of the atoms for which a test holds, and the others.
    pub fn parted(&self, test: impl Fn(Atom) -> bool) -> (Monomial, Monomial) {
        let (first, second) = self.0.iter().copied().partition(|f| test(f.0));
        (Monomial(first), Monomial(second))
    }

    /// The largest monomial that divides both.
    pub fn gcd(&self, o: &Monomial) -> Monomial {
        Monomial(self.0.iter().map(|&(x, e)| (x, e.min(o.exponent(x)))).filter(|f| f.1 > 0).collect())
    }

    /// `self / o`, for an `o` that divides it.
    pub fn over(&self, o: &Monomial) -> Monomial {
        Monomial(self.0.iter().map(|&(x, e)| (x, e - o.exponent(x))).filter(|f| f.1 > 0).collect())
    }
}

/// A sum of terms, sorted by monomial, without zero coefficients.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Poly(Vec<(Monomial, Rational)>);

impl Poly {
    /// 0
    pub fn zero() -> Self {
        Self::default()
    }

    /// A constant.
    pub fn constant(r: Rational) -> Self {
        Self::term(Monomial::one(), r)
    }

    /// 1
    pub fn one() -> Self {
        Self::constant(Rational::ONE)
    }

    /// An atom.
    pub fn atom(a: Atom) -> Self {
        Self::term(Monomial::power(a, 1), Rational::ONE)
    }

    /// A single term.
    pub fn term(m: Monomial, r: Rational) -> Self {
        if r.is_zero() { Self::zero() } else { Poly(vec![(m, r)]) }
    }

    /// From terms in any order, repeated ones added up.
    pub fn from_terms(terms: impl IntoIterator<Item = (Monomial, Rational)>) -> Self {
        let mut sum = Sum::default();
        terms.into_iter().for_each(|(m, r)| sum.add(m, r));
        sum.finish()
    }

    /// The terms, sorted by monomial.
    pub fn terms(&self) -> &[(Monomial, Rational)] {
        &self.0
    }

    /// True for 0.
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

    /// The sum.
    pub fn plus(&self, o: &Poly) -> Poly {
        let (mut a, mut b) = (self.0.iter().peekable(), o.0.iter().peekable());
        let mut out = Vec::with_capacity(self.0.len() + o.0.len());
        loop {
            match (a.peek(), b.peek()) {
                (Some(x), Some(y)) if x.0 == y.0 => {
                    let r = &x.1 + &y.1;
                    if !r.is_zero() {
                        out.push((x.0.clone(), r));
                    }
                    a.next();
                    b.next();
                }
                (Some(x), Some(y)) if x.0 < y.0 => {
                    out.push((*x).clone());
                    a.next();
                }
                (_, Some(y)) => {
                    out.push((*y).clone());
                    b.next();
                }
                (Some(x), None) => {
                    out.push((*x).clone());
                    a.next();
                }
                (None, None) => return Poly(out),
            }
        }
    }

    /// The multiple `r·self`.
    pub fn scaled(&self, r: &Rational) -> Poly {
        if r.is_zero() {
            return Poly::zero();
        }
        Poly(self.0.iter().map(|(m, c)| (m.clone(), c * r)).collect())
    }

    /// The difference.
    pub fn minus(&self, o: &Poly) -> Poly {
        self.plus(&o.scaled(&-Rational::ONE))
    }

    /// The atoms that occur, sorted.
    pub fn atoms(&self) -> Vec<Atom> {
        let mut occurs: SmallVec<[u64; 4]> = SmallVec::new();
        for &(atom, _) in self.0.iter().flat_map(|t| t.0.factors()) {
            let word = usize::from(atom / 64);
            if occurs.len() <= word {
                occurs.resize(word + 1, 0);
            }
            occurs[word] |= 1 << (atom % 64);
        }
        let of_word = |(word, bits): (usize, &u64)| {
            let bits = *bits;
            (0..64).filter(move |k| bits >> k & 1 == 1).map(move |k| (64 * word + k) as Atom)
        };
        occurs.iter().enumerate().flat_map(of_word).collect()
    }

    /// A plain sum of products, atoms being these formulas.
    pub fn to_expr(&self, atom: impl Fn(Atom) -> Expr) -> Expr {
        self.0.iter().fold(Expr::int(0), |sum, (m, r)| {
            let product = m.factors().iter().fold(Expr::int(1), |x, &(a, e)| x * atom(a).powi(e.into()));
            sum + Expr::from(r.clone()) * product
        })
    }

    /// The largest monomial that divides every term.
    pub fn monomial_content(&self) -> Monomial {
        let mut terms = self.0.iter().map(|t| &t.0);
        let first = terms.next().cloned().unwrap_or_default();
        terms.fold(first, |g, m| g.gcd(m))
    }

    /// The terms with an atom, divided by it, and the others: `atom·inside + rest`.
    pub fn split(&self, atom: Atom) -> (Poly, Poly) {
        let (inside, rest): (Vec<_>, Vec<_>) =
            self.0.iter().cloned().partition(|(m, _)| m.exponent(atom) > 0);
        (Poly(inside).over(&Monomial::power(atom, 1)), Poly(rest))
    }

    /// `self / m`, for a monomial that divides every term.
    pub fn over(&self, m: &Monomial) -> Poly {
        let mut terms: Vec<_> = self.0.iter().map(|(x, r)| (x.over(m), r.clone())).collect();
        terms.sort_unstable_by(|a, b| a.0.cmp(&b.0));
        Poly(terms)
    }
}

/// A sum of terms under way: a list while it is short, a table by monomial beyond.
#[derive(Debug, Default)]
pub(crate) struct Sum {
    short: Vec<(Monomial, Rational)>,
    table: FxHashMap<Monomial, Rational>,
}

/// The longest list: sorting it takes less time than a table.
const SHORT: usize = 48;

impl Sum {
    /// Adds `r·m`.
    pub fn add(&mut self, m: Monomial, r: Rational) {
        if self.short.len() < SHORT && self.table.is_empty() {
            self.short.push((m, r));
            return;
        }
        if self.table.is_empty() {
            self.table.reserve(2 * SHORT);
        }
        for (m, r) in self.short.drain(..).chain([(m, r)]) {
            match self.table.entry(m) {
                std::collections::hash_map::Entry::Occupied(mut e) => {
                    let total = e.get() + &r;
                    e.insert(total);
                }
                std::collections::hash_map::Entry::Vacant(e) => {
                    e.insert(r);
                }
            }
        }
    }

    /// The polynomial.
    pub fn finish(self) -> Poly {
        let Sum { mut short, table } = self;
        let is_short = table.is_empty();
        short.extend(table);
        short.sort_unstable_by(|a, b| a.0.cmp(&b.0));
        if is_short {
            short.dedup_by(|next, sum| {
                let is_like = next.0 == sum.0;
                if is_like {
                    sum.1 = &sum.1 + &next.1;
                }
                is_like
            });
        }
        short.retain(|t| !t.1.is_zero());
        Poly(short)
    }
}
