//! Greatest common divisors of polynomials in many variables over the Gaussian rationals.
//!
//! Most questions end early: a variable that only one of the two holds, a divisor that is one of them, or a
//! degree of 0 in the image modulo the prime at a random point. What is left goes through pseudo-remainders.

use super::field::{Field, Gauss, Residue};
use super::sparse::{Exhausted, Exponents, Sparse, Work};
use super::univariate;

type Poly = Sparse<Gauss>;

/// The greatest common divisor, monic.
pub(super) fn gcd(a: &Poly, b: &Poly, work: &mut Work) -> Result<Poly, Exhausted> {
    if a.is_zero() || b.is_zero() {
        return Ok(if a.is_zero() { b.clone() } else { a.clone() }.monic());
    }
    let (m, n) = (a.monomial(), b.monomial());
    let common: Exponents = m.iter().zip(&n).map(|(x, y)| *x.min(y)).collect();
    let g = core(&a.clone().over_monomial(&m), &b.clone().over_monomial(&n), work)?;
    Ok(g.times_monomial(&common))
}

/// The greatest common divisor of the coefficients of the powers of a variable, monic.
pub(super) fn content(p: &Poly, x: usize, work: &mut Work) -> Result<Poly, Exhausted> {
    gcd_of(p.coefficients(x).into_iter().map(|c| c.1).collect(), work)
}

/// The greatest common divisor of many, the shortest first.
fn gcd_of(mut all: Vec<Poly>, work: &mut Work) -> Result<Poly, Exhausted> {
    all.sort_by_key(|c| c.terms().len());
    let mut rest = all.into_iter();
    let Some(mut g) = rest.next().map(Poly::monic) else { return Ok(Poly::zero(0)) };
    for c in rest {
        if g.is_constant() {
            break;
        }
        g = gcd(&g, &c, work)?;
    }
    Ok(g)
}

/// The greatest common divisor of two polynomials that no variable divides.
fn core(a: &Poly, b: &Poly, work: &mut Work) -> Result<Poly, Exhausted> {
    work.spend(a.terms().len() + b.terms().len())?;
    let (in_a, in_b) = (a.used(), b.used());
    if in_a.is_empty() || in_b.is_empty() {
        return Ok(Poly::constant(a.variables(), Gauss::one()));
    }
    for (p, o, variables, others) in [(a, b, &in_a, &in_b), (b, a, &in_b, &in_a)] {
        if let Some(&x) = variables.iter().find(|x| !others.contains(x)) {
            return without(x, &[p, o], work);
        }
    }
    let (short, long) = if a.terms().len() <= b.terms().len() { (a, b) } else { (b, a) };
    if long.divided(short, work)?.is_some() {
        return Ok(short.clone().monic());
    }
    let absent = absent(a, b, &in_a, work)?;
    if absent.len() == in_a.len() {
        return Ok(Poly::constant(a.variables(), Gauss::one()));
    }
    if let Some(&x) = absent.first() {
        return without(x, &[a, b], work);
    }
    let Some(&x) = in_a.iter().min_by_key(|&&x| a.degree(x).min(b.degree(x))) else {
        return Ok(short.clone().monic());
    };
    by_remainders(a, b, x, work)
}

/// The greatest common divisor of polynomials, known not to hold `x`.
fn without(x: usize, all: &[&Poly], work: &mut Work) -> Result<Poly, Exhausted> {
    gcd_of(all.iter().flat_map(|p| p.coefficients(x)).map(|c| c.1).collect(), work)
}

/// The variables that the divisor does not hold: there its degree is 0 modulo the prime at a random point.
fn absent(a: &Poly, b: &Poly, variables: &[usize], work: &mut Work) -> Result<Vec<usize>, Exhausted> {
    let (Some(a), Some(b)) = (a.residues(), b.residues()) else { return Ok(vec![]) };
    let mut state = 0x5eed;
    let point: Vec<Residue> = (0..a.variables()).map(|_| Residue::random(&mut state)).collect();
    let degrees = variables.iter().map(|&x| usize::from(a.degree(x)) * usize::from(b.degree(x)));
    work.spend(variables.len() * (a.terms().len() + b.terms().len()) / 4 + degrees.sum::<usize>())?;
    let is_absent = |x: &usize| {
        let (p, q) = (univariate::trimmed(a.along(*x, &point)), univariate::trimmed(b.along(*x, &point)));
        univariate::gcd(&p, &q).len() == 1
    };
    Ok(variables.iter().copied().filter(is_absent).collect())
}

/// Euclid in one variable, the content removed from every remainder.
fn by_remainders(a: &Poly, b: &Poly, x: usize, work: &mut Work) -> Result<Poly, Exhausted> {
    let (in_a, in_b) = (content(a, x, work)?, content(b, x, work)?);
    let common = gcd(&in_a, &in_b, work)?;
    let one = Poly::constant(a.variables(), Gauss::one());
    let over =
        |p: &Poly, c: &Poly, work: &mut Work| p.divided(c, work).map(|q| q.unwrap_or_else(|| p.clone()));
    let (mut u, mut v) = (over(a, &in_a, work)?, over(b, &in_b, work)?);
    if u.degree(x) < v.degree(x) {
        (u, v) = (v, u);
    }
    let divisor = loop {
        if u.divided(&v, work)?.is_some() {
            break v;
        }
        let rest = pseudo_remainder(&u, &v, x, work)?;
        if rest.is_zero() {
            break v;
        }
        if rest.degree(x) == 0 {
            break one;
        }
        let inner = content(&rest, x, work)?;
        (u, v) = (v, over(&rest, &inner, work)?.monic());
    };
    Ok(common.times(&divisor, work)?.monic())
}

/// A remainder of `lᵏ·u` by `v`, with l the leading coefficient of v.
fn pseudo_remainder(u: &Poly, v: &Poly, x: usize, work: &mut Work) -> Result<Poly, Exhausted> {
    let (lead, degree) = (v.leading(x), v.degree(x));
    let mut rest = u.clone();
    while !rest.is_zero() && rest.degree(x) >= degree {
        let mut shift = rest.monomial();
        shift.iter_mut().for_each(|e| *e = 0);
        shift[x] = rest.degree(x) - degree;
        let top = rest.leading(x).times_monomial(&shift);
        rest = rest.times(&lead, work)?.minus(&v.times(&top, work)?);
        work.spend(rest.terms().len().saturating_mul(rest.cost()))?;
        rest = rest.monic();
    }
    Ok(rest)
}
