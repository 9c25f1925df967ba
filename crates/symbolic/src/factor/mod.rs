//! A formula as a product: `D3·RL4·C3·S5·(D3C2 − RL4S23)`.
//!
//! Polynomials in sines and cosines have no unique factors: S² = (1 − C)(1 + C). Polynomials in z = e^{iφ} over the
//! Gaussian rationals do, in every basis of angle sums at once. So a canonical polynomial is written in
//! z (`laurent`), split there (`split`, with `gcd`, `toric` and `lift`), and the parts are joined to real factors
//! (`real`), sines and cosines before their halves. Each is shown over the angle sums that make it short (`shown`).
//! The product is then formed again in the ring and must be the polynomial, or nothing is split.

mod field;
mod gcd;
mod laurent;
mod lift;
mod real;
mod shown;
mod sparse;
mod split;
mod toric;
mod univariate;
mod zeros;

pub use zeros::{Zero, zero_in, zeros};

use crate::expr::{Expr, Symbol};
use crate::poly::Poly;
use crate::rational::Rational;
use crate::ring::{Refusal, Ring};
use laurent::Variables;
use shown::Shown;
use sparse::{Exhausted, Work};
use split::Split;

/// A product, proved equal to the formula it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Factored {
    /// The number in front.
    pub constant: Rational,
    /// The factors and their powers: symbols, sums of them, single sines and cosines, then longer sums.
    pub factors: Vec<(Expr, u32)>,
    /// False if the bound on work was reached, so that some factor may not be irreducible.
    pub is_complete: bool,
}

impl Factored {
    /// The product as one formula.
    pub fn to_expr(&self) -> Expr {
        let powers = self.factors.iter().map(|&(f, n)| f.powi(i32::try_from(n).unwrap_or(i32::MAX)));
        Expr::from(self.constant.clone()) * powers.fold(Expr::int(1), |product, f| product * f)
    }
}

/// In ASCII, with full words.
impl std::fmt::Display for Factored {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.to_expr().fmt(f)
    }
}

/// Products of terms that may be formed for one formula: about a second.
const WORK: u64 = 3_000_000;
/// Terms, and a degree, beyond which only the common monomial is split off.
const MAX_TERMS: usize = 4_000;
const MAX_DEGREE: u16 = 200;

/// A formula without denominators as a product of factors that are irreducible over the rational numbers. Symbols are
/// listed in the order of `symbols`, others behind them by name. Roots (√2) and sines of constants count as symbols:
/// what splits only because of a relation between them stays whole.
///
/// ```
/// use denavit_symbolic::{factor::factored, parse::parse, vocabulary::Vocabulary};
/// let open = Vocabulary::new().open(true);
/// let sum = parse("D3*RL4*S5*(D3*C2*(C23*C2 + S23*S2) - RL4*S23*(C23*C2 + S23*S2))", &open).unwrap();
/// let product = factored(sum, &[]).unwrap();
/// assert_eq!(product.to_string(), "D3*RL4*cos(q3)*sin(q5)*(D3*cos(q2) - RL4*sin(q2 + q3))");
/// ```
///
/// # Errors
/// If the formula has no canonical form without denominators, or it is too large; see [`Refusal`].
pub fn factored(formula: Expr, symbols: &[Symbol]) -> Result<Factored, Refusal> {
    let mut ring = Ring::new(&[formula], symbols);
    let p = ring.polynomial(formula)?;
    if let Some(constant) = p.as_constant() {
        return Ok(Factored { constant, factors: vec![], is_complete: true });
    }
    let content = p.monomial_content();
    let rest = p.over(&content);
    let mut work = Work::new(WORK);
    let Parts { mut factors, is_complete } =
        split(&ring, symbols, &rest, &mut work).unwrap_or_else(|Exhausted| Parts::whole(&ring, &rest));
    factors.extend(content.factors().iter().map(|&(atom, n)| (Shown::atom(&ring, atom), u32::from(n))));
    match product(&mut ring, &p, merged(factors)) {
        Some((constant, factors)) => Ok(Factored { constant, factors, is_complete }),
        None => Ok(unsplit(formula)),
    }
}

fn unsplit(formula: Expr) -> Factored {
    Factored { constant: Rational::ONE, factors: vec![(formula, 1)], is_complete: false }
}

/// Factors before they are sorted.
struct Parts {
    factors: Vec<(Shown, u32)>,
    is_complete: bool,
}

impl Parts {
    /// What was not split.
    fn whole(ring: &Ring, p: &Poly) -> Self {
        Parts { factors: vec![(Shown::sum(ring, p), 1)], is_complete: false }
    }
}

/// The factors of a polynomial without common monomial.
fn split(ring: &Ring, symbols: &[Symbol], p: &Poly, work: &mut Work) -> Result<Parts, Exhausted> {
    if p.terms().len() > MAX_TERMS {
        return Err(Exhausted);
    }
    let variables = Variables::of(ring, p);
    let in_z = variables.polynomial(p, work)?;
    if in_z.used().iter().any(|&x| in_z.degree(x) > MAX_DEGREE) {
        return Err(Exhausted);
    }
    let monomial = in_z.monomial();
    let mut factors = vec![];
    for (x, &n) in monomial.iter().enumerate() {
        if n > 0 && !variables.is_unit(x) {
            factors.push((Shown::atom(ring, variables.symbols[x]), u32::from(n)));
        }
    }
    let split = Split::of(in_z.over_monomial(&monomial), work);
    // What is split stays split: joining has work of its own.
    let parts = real::grouped(&split.factors, variables.symbols.len(), &mut Work::new(WORK))?;
    for (part, n) in parts {
        let sum = variables.harmonics(&part);
        factors.push((Shown::harmonics(ring, &sum, symbols).ok_or(Exhausted)?, n));
    }
    Ok(Parts { factors, is_complete: !split.is_cut_short })
}

/// Sorted, equal factors joined.
fn merged(mut factors: Vec<(Shown, u32)>) -> Vec<(Expr, u32)> {
    factors.sort_by_cached_key(|f| f.0.place.clone());
    let mut merged: Vec<(Expr, u32)> = vec![];
    for (shown, n) in factors {
        match merged.iter_mut().find(|m| m.0 == shown.expr) {
            Some(m) => m.1 += n,
            None => merged.push((shown.expr, n)),
        }
    }
    merged
}

/// The number in front of the factors, if their product is a multiple of `p`.
fn product(ring: &mut Ring, p: &Poly, factors: Vec<(Expr, u32)>) -> Option<(Rational, Vec<(Expr, u32)>)> {
    let mut product = Poly::one();
    for (factor, n) in &factors {
        let factor = ring.polynomial(*factor).ok()?;
        for _ in 0..*n {
            product = ring.times(&product, &factor).ok()?;
        }
    }
    let (m, k) = product.terms().first()?;
    let (_, r) = p.terms().iter().find(|t| t.0 == *m)?;
    let constant = r * &k.recip()?;
    (product.scaled(&constant) == *p).then_some((constant, factors))
}
