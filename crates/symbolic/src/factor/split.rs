//! The irreducible factors of a polynomial over the Gaussian rationals.
//!
//! Contents first: what the coefficients of the powers of one variable have in common. A polynomial of degree 1 in a
//! variable, with no content there, is irreducible, and most are. Then square factors, then a point at which the
//! polynomial in one variable is split and the factors are lifted. Whatever is split off divides exactly.

use super::field::{Field, Gauss, Residue};
use super::gcd::{content, gcd};
use super::lift::{Image, Lifting};
use super::sparse::{Exhausted, Exponents, Sparse, Work};
use super::toric;
use super::univariate::{self, Line};
use crate::rational::Rational;

type Poly = Sparse<Gauss>;

/// Monic factors, repeated ones as often as they occur.
#[derive(Default)]
pub(super) struct Split {
    /// The factors.
    pub factors: Vec<Poly>,
    /// Whether the bound on work left one of them whole that may not be irreducible.
    pub is_cut_short: bool,
}

impl Split {
    /// Splits a polynomial that no variable divides.
    pub fn of(p: Poly, work: &mut Work) -> Split {
        let mut split = Split::default();
        let mut pending = vec![p.monic()];
        while let Some(p) = pending.pop() {
            if p.is_constant() {
                continue;
            }
            match step(&p, work) {
                Ok(Step::Irreducible) => split.factors.push(p),
                Ok(Step::Product(a, b)) => pending.extend([b, a]),
                Ok(Step::Factors(inner)) => {
                    split.factors.extend(inner.factors);
                    split.is_cut_short |= inner.is_cut_short;
                }
                Err(Exhausted) => {
                    split.factors.push(p);
                    split.is_cut_short = true;
                }
            }
        }
        split
    }
}

/// What was found out about a polynomial.
enum Step {
    Irreducible,
    Product(Poly, Poly),
    Factors(Split),
}

fn step(p: &Poly, work: &mut Work) -> Result<Step, Exhausted> {
    let mut variables = p.used();
    variables.sort_by_key(|&x| p.degree(x));
    for &x in &variables {
        let common = content(p, x, work)?;
        if let (false, Some(rest)) = (common.is_constant(), p.divided(&common, work)?) {
            return Ok(Step::Product(common, rest.monic()));
        }
        if p.degree(x) == 1 {
            return Ok(Step::Irreducible);
        }
    }
    if let Some((inner, change)) = toric::reduced(p) {
        let mut split = Split::of(inner, work);
        split.factors.iter_mut().for_each(|f| *f = change.undone(f).monic());
        return Ok(Step::Factors(split));
    }
    let Some(&x) = variables.first() else { return Ok(Step::Irreducible) };
    if variables.len() == 1 && p.degree(x) == 2 {
        return Ok(quadratic(p, x));
    }
    let twice = gcd(p, &p.derivative(x), work)?;
    if let (false, Some(rest)) = (twice.is_constant(), p.divided(&twice, work)?) {
        return Ok(Step::Product(twice, rest.monic()));
    }
    by_lifting(p, x, work)
}

/// `x² + b·x + c` by the formula.
fn quadratic(p: &Poly, x: usize) -> Step {
    let line = p.along(x, &vec![Gauss::zero(); p.variables()]);
    let half = Gauss::real(Rational::new(-1, 2));
    let middle = line[1].times(&half);
    let Some(root) = middle.times(&middle).minus(&line[0]).sqrt() else { return Step::Irreducible };
    let mut exponents = p.monomial();
    exponents[x] = 1;
    let variable = Poly::from_terms(p.variables(), [(exponents, Gauss::one())]);
    let minus = |k: &Gauss| variable.minus(&Poly::constant(p.variables(), k.clone()));
    Step::Product(minus(&middle.plus(&root)), minus(&middle.minus(&root)))
}

/// Points that are compared, and points that are tried until so many serve.
const POINTS: usize = 3;
const TRIED: usize = 30;
/// Factors of an image beyond which their combinations are too many.
const MAX_FACTORS: usize = 12;

/// What factoring an image of degree n costs, in products of terms, over n³.
const POINT_COST: usize = 100;

/// A squarefree polynomial without contents, by its images at small points.
fn by_lifting(p: &Poly, x: usize, work: &mut Work) -> Result<Step, Exhausted> {
    let whole = p.scaled(&denominators(p));
    let Some(residues) = whole.residues() else { return Err(Exhausted) };
    let mut state = 0x00fa_c701;
    let mut best: Option<(Image, Vec<Line>)> = None;
    let (mut served, mut tried) = (0, 0);
    while served < POINTS && tried < TRIED {
        tried += 1;
        let point = (0..p.variables()).map(|_| Residue::int(small(&mut state, tried))).collect();
        let Some(image) = Image::at(&residues, x, point) else { continue };
        work.spend(residues.terms().len())?;
        work.spend(POINT_COST * image.line.len().pow(3))?;
        let factors = univariate::factors(&image.line, &mut state);
        if factors.len() == 1 {
            return Ok(Step::Irreducible);
        }
        served += 1;
        if best.as_ref().is_none_or(|b| factors.len() < b.1.len()) {
            best = Some((image, factors));
        }
        if p.used().len() == 1 {
            break;
        }
    }
    let Some((image, factors)) = best.filter(|b| b.1.len() <= MAX_FACTORS) else { return Err(Exhausted) };
    let lifting = Lifting::new(&residues, image, work)?;
    for chosen in combinations(factors.len()) {
        let pick = |wanted: bool| {
            let of_side = factors.iter().enumerate().filter(|(i, _)| (chosen >> i & 1 == 1) == wanted);
            of_side.fold(vec![Residue::one()], |f, (_, g)| univariate::times(&f, g))
        };
        let Some(found) = lifting.lifted(&pick(true), &pick(false), work)? else { continue };
        let Some(found) = integers(&found) else { continue };
        let common = content(&found, x, work)?;
        let Some(factor) = found.divided(&common, work)? else { continue };
        if let Some(rest) = p.divided(&factor, work)? {
            return Ok(Step::Product(factor.monic(), rest.monic()));
        }
    }
    Ok(Step::Irreducible)
}

/// A small integer, of a range that grows with the number of tries.
fn small(state: &mut u64, tried: usize) -> i64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    let range = 2 * (3 + tried as i64) + 1;
    ((*state >> 33) as i64) % range - range / 2
}

/// Choices of factors, few first, one of each choice and its complement.
fn combinations(n: usize) -> Vec<u32> {
    let half = n as u32 / 2;
    let mut all: Vec<u32> = (1..1_u32 << n)
        .filter(|c| c.count_ones() <= half && (2 * c.count_ones() as usize != n || c & 1 == 1))
        .collect();
    all.sort_by_key(|c| c.count_ones());
    all
}

/// A common denominator of the coefficients.
fn denominators(p: &Poly) -> Gauss {
    let parts = p.terms().iter().flat_map(|t| [&t.1.re, &t.1.im]);
    Gauss::real(parts.fold(Rational::ONE, |d, r| {
        let (_, bottom) = (r * &d).digits();
        &d * &Rational::from_decimal(&bottom).unwrap_or(Rational::ONE)
    }))
}

/// The polynomial with the least integers for its residues, if they are of a credible size.
fn integers(p: &Sparse<Residue>) -> Option<Poly> {
    let terms: Option<Vec<(Exponents, Gauss)>> =
        p.terms().iter().map(|(e, k)| k.is_plausible().then(|| (e.clone(), k.lifted()))).collect();
    Some(Poly::from_terms(p.variables(), terms?))
}
