//! Polynomials in the entries of the pose, in sines and cosines of the unknown angles, and in the robot's constants.
//!
//! Every angle has a cosine and a sine, with the rule S² → 1 − C². Angles that are sums of one another (θ2, θ23) are
//! atoms of their own here: an equation holds whichever of them its product was formed with.

use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::ring::{AtomKind, Ring};
use denavit_symbolic::rules::{Formed, Rules};
use denavit_symbolic::{Expr, Rational};
use rustc_hash::FxHashMap;
use std::cell::Cell;
use std::convert::Infallible;

/// What an atom stands for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Kind {
    /// An entry of the pose, row-major in a 3×4 matrix.
    Pose(usize),
    /// The cosine of an angle.
    Cos(usize),
    /// The sine of an angle.
    Sin(usize),
    /// The displacement of a sliding axis.
    Slide(usize),
    /// A constant of the robot.
    Constant(Expr),
}

/// The most that a derivation may take: several times what the longest of the catalogue takes.
pub const MOST_WORK: u64 = 2_000_000;
/// What a coefficient takes that does not fit two machine words.
const LONG: u64 = 12;

/// Atoms, their rules, their formulas.
#[derive(Debug, Default)]
pub struct Algebra {
    kinds: Vec<Kind>,
    exprs: Vec<Expr>,
    rules: Rules,
    numbers: FxHashMap<Kind, Atom>,
    /// Products of terms that were formed.
    work: Cell<u64>,
}

impl Algebra {
    /// The atom of a kind; `expr` is what it is printed as.
    pub fn atom(&mut self, kind: Kind, expr: impl FnOnce() -> Expr) -> Atom {
        if let Some(&a) = self.numbers.get(&kind) {
            return a;
        }
        let number = Atom::try_from(self.kinds.len()).expect("fewer than 65536 atoms");
        self.kinds.push(kind);
        self.exprs.push(expr());
        self.numbers.insert(kind, number);
        number
    }

    /// Cosine and sine of an angle as polynomials.
    pub fn pair(&mut self, angle: usize, expr: Expr) -> (Poly, Poly) {
        let c = self.atom(Kind::Cos(angle), || expr.cos());
        let s = self.atom(Kind::Sin(angle), || expr.sin());
        if self.rules.square(s).is_none() {
            self.rules.set_pair(c, s);
        }
        (Poly::atom(c), Poly::atom(s))
    }

    /// What an atom stands for.
    pub fn kind(&self, a: Atom) -> Kind {
        self.kinds[usize::from(a)]
    }

    /// The number of an atom that is there.
    pub fn find(&self, kind: Kind) -> Option<Atom> {
        self.numbers.get(&kind).copied()
    }

    /// An atom as a formula.
    pub fn expr(&self, a: Atom) -> Expr {
        self.exprs[usize::from(a)]
    }

    /// How many atoms there are.
    pub fn atoms(&self) -> usize {
        self.kinds.len()
    }

    /// What was done so far, as products of two terms: the same on every machine.
    pub fn work(&self) -> u64 {
        self.work.get()
    }

    /// True if that is as much as a derivation may take.
    pub fn is_spent(&self) -> bool {
        self.work.get() > MOST_WORK
    }

    /// What is done counts from here on.
    pub fn restart(&self) {
        self.work.set(0);
    }

    /// The product, squares of sines and roots replaced.
    pub fn times(&self, a: &Poly, b: &Poly) -> Poly {
        if let Some(r) = a.as_constant() {
            return b.scaled(&r);
        }
        if let Some(r) = b.as_constant() {
            return a.scaled(&r);
        }
        let mut work = self.work.get();
        let Ok(product) = self.rules.times(a, b, |formed, r| counted(&mut work, formed, r));
        self.work.set(work);
        product
    }

    /// The square.
    pub fn square(&self, a: &Poly) -> Poly {
        let mut work = self.work.get();
        let Ok(square) = self.rules.square_of(a, |formed, r| counted(&mut work, formed, r));
        self.work.set(work);
        square
    }

    /// The value, atoms having these values.
    pub fn value(p: &Poly, atoms: &[f64]) -> f64 {
        p.terms().iter().map(|(m, r)| r.to_f64() * monomial_value(m, atoms)).sum()
    }

    /// The value, and the sum of the terms' magnitudes.
    pub(crate) fn value_and_size(p: &Poly, atoms: &[f64]) -> (f64, f64) {
        p.terms().iter().fold((0.0, 0.0), |(v, s), (m, r)| {
            let x = r.to_f64() * monomial_value(m, atoms);
            (v + x, s + x.abs())
        })
    }

    /// A polynomial as a sum of products.
    pub fn formula(&self, p: &Poly) -> Expr {
        p.to_expr(|a| self.expr(a))
    }

    /// A constant formula of the robot as a polynomial; what is none becomes an atom as it stands.
    pub fn constant(&mut self, ring: &mut Ring, e: Expr) -> Poly {
        let Ok(p) = ring.polynomial(e) else {
            return Poly::atom(self.atom(Kind::Constant(e), || e));
        };
        let mut terms = vec![];
        for (m, r) in p.terms() {
            let mut product = Monomial::one();
            for &(a, n) in m.factors() {
                let e = ring.atom_expr(a);
                let atom = self.atom(Kind::Constant(e), || e);
                if let AtomKind::Surd(k) = ring.kind(a) {
                    self.rules.set(atom, Poly::constant((*k).into()));
                }
                product = product.times(&Monomial::power(atom, n));
            }
            let mut factor = r.clone();
            if is_long(r) {
                // Products of numbers with many digits would be longer and longer: they count as constants with a name.
                let size = Expr::from(r.abs());
                product = product.times(&Monomial::power(self.atom(Kind::Constant(size), || size), 1));
                factor = if r.is_negative() { -Rational::ONE } else { Rational::ONE };
            }
            terms.push((product, factor));
        }
        for (c, s) in ring.pairs().collect::<Vec<_>>() {
            let (c, s) = (ring.atom_expr(c), ring.atom_expr(s));
            if let (Some(c), Some(s)) = (self.find(Kind::Constant(c)), self.find(Kind::Constant(s))) {
                self.rules.set_pair(c, s);
            }
        }
        Poly::from_terms(terms)
    }
}

/// Counts a product of two terms.
fn counted(work: &mut u64, formed: Formed, r: &Rational) -> Result<(), Infallible> {
    if formed == Formed::Product {
        *work += if r.to_parts().is_some() { 1 } else { 1 + LONG };
    }
    Ok(())
}

/// True for a number with more digits than somebody would work with.
fn is_long(r: &Rational) -> bool {
    r.to_parts().is_none_or(|(n, d)| n.unsigned_abs().max(d.unsigned_abs()) > DIGITS)
}

fn monomial_value(m: &Monomial, atoms: &[f64]) -> f64 {
    m.factors().iter().map(|&(a, n)| atoms[usize::from(a)].powi(n.into())).product()
}

/// Numerators and denominators beyond are long.
const DIGITS: u64 = 1_000_000_000;

/// A 3×3 matrix of polynomials.
pub type Matrix = [[Poly; 3]; 3];
/// Three polynomials.
pub type Column = [Poly; 3];

/// The identity.
pub fn identity() -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { Poly::one() } else { Poly::zero() }))
}

impl Algebra {
    /// The product of two matrices.
    pub fn product(&self, a: &Matrix, b: &Matrix) -> Matrix {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                (0..3).fold(Poly::zero(), |sum, k| {
                    if a[i][k].is_zero() || b[k][j].is_zero() {
                        return sum;
                    }
                    sum.plus(&self.times(&a[i][k], &b[k][j]))
                })
            })
        })
    }

    /// A matrix times a column.
    pub fn apply(&self, a: &Matrix, p: &Column) -> Column {
        std::array::from_fn(|i| {
            (0..3).fold(Poly::zero(), |sum, k| {
                if a[i][k].is_zero() || p[k].is_zero() {
                    return sum;
                }
                sum.plus(&self.times(&a[i][k], &p[k]))
            })
        })
    }
}

/// The transpose.
pub fn transposed(a: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i].clone()))
}

/// The sum of two columns.
pub fn sum(a: &Column, b: &Column) -> Column {
    std::array::from_fn(|i| a[i].plus(&b[i]))
}
