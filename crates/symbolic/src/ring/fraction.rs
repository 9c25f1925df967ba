//! Quotients of polynomials. The factors of a denominator are kept apart, each a condition "≠ 0".
//!
//! The ring is no unique factorisation domain (S·S = (1−C)(1+C)), so fractions are not reduced to lowest terms;
//! two are equal when their difference has numerator 0.

use super::{AtomKind, Refusal, Ring};
use crate::poly::Poly;
use crate::rational::Rational;

/// `num / Π denᵢ^nᵢ`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fraction {
    /// The numerator.
    pub num: Poly,
    /// The factors of the denominator and their powers; never a constant.
    pub den: Vec<(Poly, u32)>,
}

impl From<Poly> for Fraction {
    fn from(num: Poly) -> Self {
        Fraction { num, den: vec![] }
    }
}

impl Fraction {
    /// The multiple `r·self`.
    pub fn scaled(&self, r: &Rational) -> Fraction {
        Fraction { num: self.num.scaled(r), den: self.den.clone() }
    }
}

impl Ring {
    /// The sum, over the least common multiple of the recorded factors.
    pub(crate) fn add(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Refusal> {
        if a.den == b.den {
            return Ok(Fraction { num: a.num.plus(&b.num), den: a.den.clone() });
        }
        let mut den = a.den.clone();
        for (p, n) in &b.den {
            match den.iter_mut().find(|f| f.0 == *p) {
                Some(f) => f.1 = f.1.max(*n),
                None => den.push((p.clone(), *n)),
            }
        }
        let x = self.lifted(a, &den)?;
        let y = self.lifted(b, &den)?;
        Ok(Fraction { num: x.plus(&y), den })
    }

    /// The numerator of `f` over the denominator `den`, which holds all its factors.
    fn lifted(&mut self, f: &Fraction, den: &[(Poly, u32)]) -> Result<Poly, Refusal> {
        let mut num = f.num.clone();
        for (p, n) in den {
            let have = f.den.iter().find(|g| g.0 == *p).map_or(0, |g| g.1);
            let factor = self.power(p, n - have)?;
            num = self.times(&num, &factor)?;
        }
        Ok(num)
    }

    pub(crate) fn multiply(&mut self, a: &Fraction, b: &Fraction) -> Result<Fraction, Refusal> {
        let mut den = a.den.clone();
        for (p, n) in &b.den {
            match den.iter_mut().find(|f| f.0 == *p) {
                Some(f) => f.1 += n,
                None => den.push((p.clone(), *n)),
            }
        }
        Ok(Fraction { num: self.times(&a.num, &b.num)?, den })
    }

    /// `1/f`; the numerator becomes a recorded factor.
    pub(crate) fn invert(&mut self, f: &Fraction) -> Result<Fraction, Refusal> {
        let den = self.expanded_denominator(f)?;
        if f.num.is_zero() {
            return Err(Refusal::Undefined);
        }
        if let Some(r) = f.num.as_constant().and_then(|r| r.recip()) {
            return Ok(den.scaled(&r).into());
        }
        if let [(m, r)] = f.num.terms()
            && let [(atom, 1)] = m.factors()
            && let AtomKind::Surd(n) = *self.kind(*atom)
        {
            // 1/(r√n) = √n/(r·n): a number in the denominator is no condition.
            let scale = (r * &Rational::from(n)).recip().ok_or(Refusal::Undefined)?;
            let num = self.times(&den, &Poly::atom(*atom))?;
            return Ok(num.scaled(&scale).into());
        }
        // The recorded factor is monic in its first term, so that x−y and y−x are one condition.
        let scale = f.num.terms()[0].1.recip().ok_or(Refusal::Undefined)?;
        Ok(Fraction { num: den.scaled(&scale), den: vec![(f.num.scaled(&scale), 1)] })
    }

    pub(crate) fn raise(&mut self, f: &Fraction, n: u32) -> Result<Fraction, Refusal> {
        let num = self.power(&f.num, n)?;
        Ok(Fraction { num, den: f.den.iter().map(|(p, k)| (p.clone(), k.saturating_mul(n))).collect() })
    }

    /// The denominator as one polynomial.
    pub(crate) fn expanded_denominator(&mut self, f: &Fraction) -> Result<Poly, Refusal> {
        let mut den = Poly::one();
        for (p, n) in &f.den {
            let factor = self.power(p, *n)?;
            den = self.times(&den, &factor)?;
        }
        Ok(den)
    }
}
