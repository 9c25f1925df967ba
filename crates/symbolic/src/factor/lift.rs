//! Factors in many variables from factors in one: Hensel's lemma by total degree, modulo the prime.
//!
//! All variables but x are set to a point α. With l the leading coefficient, l·p = f·g is solved for an f and a g that
//! both have the leading coefficient l and are known at α, one total degree in y − α at a time: each term of
//! what is missing is an equation f₀·τ + g₀·σ = e in x alone.

use super::field::{Field, Residue};
use super::sparse::{Exhausted, Exponents, Sparse, Work, product};
use super::univariate::{self, Line};
use std::collections::BTreeMap;

type Poly = Sparse<Residue>;
/// What is of one total degree in y: a polynomial in x for each monomial.
type Part = BTreeMap<Exponents, Line>;

/// A polynomial at a point: all variables but x have a value.
pub(super) struct Image {
    x: usize,
    point: Vec<Residue>,
    /// The polynomial in x.
    pub line: Line,
    top: Residue,
}

impl Image {
    /// The image at a point; `None` if it has a smaller degree or a square factor there.
    pub fn at(p: &Poly, x: usize, point: Vec<Residue>) -> Option<Self> {
        let line = univariate::trimmed(p.along(x, &point));
        let top = *line.last()?;
        let serves = line.len() == usize::from(p.degree(x)) + 1 && univariate::is_squarefree(&line);
        serves.then_some(Image { x, point, line, top })
    }
}

/// A polynomial expanded around a point.
pub(super) struct Lifting {
    x: usize,
    point: Vec<Residue>,
    /// The leading coefficient, and its product with the polynomial, by total degree around the point.
    lead: Vec<Part>,
    target: Vec<Part>,
    top: Residue,
}

/// Terms beyond which nothing is expanded around a point.
const MAX_EXPANDED: usize = 50_000;

impl Lifting {
    /// The expansion around the point of an image.
    pub fn new(p: &Poly, image: Image, work: &mut Work) -> Result<Self, Exhausted> {
        let Image { x, point, top, .. } = image;
        let moved = p.used().into_iter().filter(|&y| !point[y].is_zero());
        let size = moved.fold(1, |n: usize, y| n.saturating_mul(usize::from(p.degree(y)) + 1));
        if size > MAX_EXPANDED {
            return Err(Exhausted);
        }
        let lead = shifted(&p.leading(x), &point, x, work)?;
        let target = shifted(p, &point, x, work)?.times(&lead, work)?;
        Ok(Lifting { lead: parts(&lead, x), target: parts(&target, x), x, point, top })
    }

    /// The factor with the leading coefficient l whose image is a multiple of `f`; `g` is the rest of the image. Both
    /// are monic. `None` if there is none with coefficients of a credible size.
    pub fn lifted(&self, f: &Line, g: &Line, work: &mut Work) -> Result<Option<Poly>, Exhausted> {
        let scale = |a: &Line| univariate::times(a, &[self.top]);
        let (f0, g0) = (scale(f), scale(g));
        let Some(inverse) = univariate::inverse_modulo(&g0, &f0) else { return Ok(None) };
        if !f0.iter().chain(&g0).all(Residue::is_plausible) {
            return Ok(None);
        }
        let origin = || Exponents::from_elem(0, self.point.len());
        let mut sides =
            [vec![Part::from([(origin(), f0.clone())])], vec![Part::from([(origin(), g0.clone())])]];
        for degree in 1..self.target.len() {
            sides[0].push(self.lead_part(degree, f0.len()));
            sides[1].push(self.lead_part(degree, g0.len()));
            for (m, e) in self.missing(degree, &sides, work)? {
                work.spend(f0.len() * g0.len())?;
                let sigma = univariate::divided(&univariate::times(&e, &inverse), &f0).1;
                let tau = univariate::divided(&univariate::minus(&e, &univariate::times(&sigma, &g0)), &f0).0;
                if !sigma.iter().chain(&tau).all(Residue::is_plausible) {
                    return Ok(None);
                }
                for (side, change) in sides.iter_mut().zip([sigma, tau]) {
                    add(side[degree].entry(m.clone()).or_default(), &change);
                }
            }
        }
        let terms = sides[0].iter().flatten().flat_map(|(m, line)| {
            line.iter().enumerate().map(|(n, k)| {
                let mut e = m.clone();
                e[self.x] = n as u16;
                (e, *k)
            })
        });
        let around = Sparse::from_terms(self.point.len(), terms);
        let back: Vec<Residue> = self.point.iter().map(|a| Residue::zero().minus(a)).collect();
        shifted(&around, &back, self.x, work).map(Some)
    }

    /// The part of `l·xⁿ` of one degree in y, where n is the degree of a polynomial with so many coefficients.
    fn lead_part(&self, degree: usize, coefficients: usize) -> Part {
        let raise = |line: &Line| univariate::times(line, &power_of_x(coefficients - 1));
        self.lead
            .get(degree)
            .map_or_else(Part::new, |part| part.iter().map(|(m, line)| (m.clone(), raise(line))).collect())
    }

    /// What the product lacks in one degree.
    fn missing(&self, degree: usize, sides: &[Vec<Part>; 2], work: &mut Work) -> Result<Part, Exhausted> {
        let mut sum = self.target[degree].clone();
        for i in 0..=degree {
            for (m, a) in &sides[0][i] {
                for (n, b) in &sides[1][degree - i] {
                    work.spend(a.len() * b.len() / 2)?;
                    let at = sum.entry(product(m, n)).or_default();
                    *at = univariate::minus(at, &univariate::times(a, b));
                }
            }
        }
        sum.retain(|_, line| !line.is_empty());
        Ok(sum)
    }
}

fn power_of_x(n: usize) -> Line {
    let mut line = vec![Residue::zero(); n];
    line.push(Residue::one());
    line
}

fn add(sum: &mut Line, change: &[Residue]) {
    sum.resize(sum.len().max(change.len()), Residue::zero());
    sum.iter_mut().zip(change).for_each(|(a, b)| *a = a.plus(b));
}

/// The polynomial with y + α for every y other than x.
fn shifted(p: &Poly, point: &[Residue], x: usize, work: &mut Work) -> Result<Poly, Exhausted> {
    let mut p = p.clone();
    for y in p.used().into_iter().filter(|&y| y != x && !point[y].is_zero()) {
        let mut terms = vec![];
        for (e, k) in p.terms() {
            work.spend(2 * usize::from(e[y]) + 2)?;
            // (y + α)ⁿ = Σ (n over i)·αⁿ⁻ⁱ·yⁱ
            let n = e[y];
            let mut binomial = Residue::one();
            for i in (0..=n).rev() {
                let mut at = e.clone();
                at[y] = i;
                terms.push((at, k.times(&binomial)));
                let step = Residue::int((n - i + 1).into()).inverse().unwrap_or_else(Residue::zero);
                binomial = binomial.times(&Residue::int(i.into())).times(&step).times(&point[y]);
            }
        }
        p = Sparse::from_terms(p.variables(), terms);
    }
    Ok(p)
}

/// A polynomial by total degree in the variables other than x.
fn parts(p: &Poly, x: usize) -> Vec<Part> {
    let mut parts: Vec<Part> = vec![];
    for (e, k) in p.terms() {
        let n = usize::from(e[x]);
        let mut m = e.clone();
        m[x] = 0;
        let degree: usize = m.iter().map(|&n| usize::from(n)).sum();
        parts.resize_with(parts.len().max(degree + 1), Part::new);
        let line = parts[degree].entry(m).or_default();
        line.resize(line.len().max(n + 1), Residue::zero());
        line[n] = *k;
    }
    parts
}
