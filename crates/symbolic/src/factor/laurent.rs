//! Sines and cosines as powers of z = e^{iφ}, and back.
//!
//! C = (z + z⁻¹)/2 and S = (z − z⁻¹)/2i turn a canonical polynomial into one in the symbols and a z for each angle,
//! multiplied by powers of z, which are units. There factors are unique, whatever sums of angles were the basis.

use super::field::{Field, Gauss};
use super::sparse::{Exhausted, Exponents, Sparse, Work};
use crate::expr::{Angle, Expr};
use crate::poly::{Atom, Monomial, Poly};
use crate::rational::Rational;
use crate::ring::{AtomKind, Ring};

/// The variables: symbols, then a z for each angle.
pub(super) struct Variables {
    /// Atoms that are no sine or cosine of a variable angle.
    pub symbols: Vec<Atom>,
    angles: Vec<(Atom, Atom, Angle)>,
}

/// `monomial·(re + cosine·cos φ + sine·sin φ)`, with the angle φ = 0 for what is free of angles.
#[derive(Clone, Debug)]
pub(super) struct Harmonic {
    /// Symbols and their powers.
    pub symbols: Vec<(Atom, u16)>,
    /// The angle.
    pub angle: Angle,
    /// The coefficient of the cosine (of 1, if the angle is 0).
    pub cosine: Rational,
    /// The coefficient of the sine.
    pub sine: Rational,
}

impl Variables {
    /// The variables of a polynomial.
    pub fn of(ring: &Ring, p: &Poly) -> Self {
        let (mut symbols, mut angles) = (vec![], vec![]);
        let atoms = p.atoms();
        for &atom in &atoms {
            if free_angle(ring, atom).is_none() {
                symbols.push(atom);
            }
        }
        for (cos, sin) in ring.pairs() {
            if let (true, Some(angle)) = (atoms.contains(&cos) || atoms.contains(&sin), free_angle(ring, cos))
            {
                angles.push((cos, sin, angle.clone()));
            }
        }
        Variables { symbols, angles }
    }

    fn count(&self) -> usize {
        self.symbols.len() + self.angles.len()
    }

    /// The polynomial times a power of each z.
    pub fn polynomial(&self, p: &Poly, work: &mut Work) -> Result<Sparse<Gauss>, Exhausted> {
        let both = |m: &Monomial, (cos, sin, _): &(Atom, Atom, Angle)| m.exponent(*cos) + m.exponent(*sin);
        let tops: Vec<u16> =
            self.angles.iter().map(|a| p.terms().iter().map(|t| both(&t.0, a)).max().unwrap_or(0)).collect();
        let mut terms = vec![];
        for (m, r) in p.terms() {
            let mut start = Exponents::from_elem(0, self.count());
            for (i, &atom) in self.symbols.iter().enumerate() {
                start[i] = m.exponent(atom);
            }
            let mut expanded = vec![(start, Gauss::real(r.clone()))];
            for (g, (angle, top)) in self.angles.iter().zip(&tops).enumerate() {
                let line = line(m.exponent(angle.0), m.exponent(angle.1));
                let shift = top - both(m, angle);
                work.spend(expanded.len() * line.len())?;
                expanded = expanded
                    .iter()
                    .flat_map(|(e, k)| {
                        line.iter().enumerate().filter(|c| !c.1.is_zero()).map(move |(n, c)| {
                            let mut e = e.clone();
                            e[self.symbols.len() + g] = shift + n as u16;
                            (e, k.times(c))
                        })
                    })
                    .collect();
            }
            terms.extend(expanded);
        }
        Ok(Sparse::from_terms(self.count(), terms))
    }

    /// True for a variable that is a z.
    pub fn is_unit(&self, x: usize) -> bool {
        x >= self.symbols.len()
    }

    /// The sum of sines and cosines of a polynomial that is real when its middle is moved to z⁰.
    pub fn harmonics(&self, p: &Sparse<Gauss>) -> Vec<Harmonic> {
        let first = self.symbols.len();
        let middle: Vec<i64> = (first..self.count()).map(|x| i64::from(p.degree(x)) / 2).collect();
        let two = Rational::from(2);
        let mut found = vec![];
        for (e, k) in p.terms() {
            let n: Vec<i64> = e[first..].iter().zip(&middle).map(|(&n, m)| i64::from(n) - m).collect();
            let leading = n.iter().copied().find(|&n| n != 0).unwrap_or(0);
            if leading < 0 {
                continue; // the conjugate of another
            }
            let symbols =
                self.symbols.iter().zip(e).filter(|(_, n)| **n > 0).map(|(&a, &n)| (a, n)).collect();
            let angle = n.iter().zip(&self.angles).fold(Angle::default(), |sum, (&n, (_, _, angle))| {
                if n == 0 { sum } else { sum.plus(&angle.scaled(&n.into())) }
            });
            // k·w + k̄·w⁻¹ = 2·Re k·cos φ − 2·Im k·sin φ
            let (cosine, sine) =
                if leading == 0 { (k.re.clone(), Rational::ZERO) } else { (&k.re * &two, -(&k.im * &two)) };
            found.push(Harmonic { symbols, angle, cosine, sine });
        }
        found
    }
}

/// The angle of a sine or cosine that varies.
fn free_angle(ring: &Ring, atom: Atom) -> Option<&Angle> {
    ring.angle_of(atom).filter(|a| !a.is_constant())
}

/// `(z² + 1)ᵃ/2ᵃ · (z² − 1)ᵇ/(2i)ᵇ`
fn line(a: u16, b: u16) -> Vec<Gauss> {
    let half = Gauss::real(Rational::new(1, 2));
    let sine = half.times(&Gauss::i());
    let (cosine_line, minus) = ([half.clone(), half], Gauss::zero().minus(&sine));
    let sine_line = [sine, minus]; // 1/2i = −i/2
    let step = |v: Vec<Gauss>, by: &[Gauss; 2]| {
        let mut out = vec![Gauss::zero(); v.len() + 2];
        for (n, k) in v.iter().enumerate() {
            out[n] = out[n].plus(&k.times(&by[0]));
            out[n + 2] = out[n + 2].plus(&k.times(&by[1]));
        }
        out
    };
    let with_cosines = (0..a).fold(vec![Gauss::one()], |v, _| step(v, &cosine_line));
    (0..b).fold(with_cosines, |v, _| step(v, &sine_line))
}

/// A sum of sines and cosines as an expression.
pub(super) fn expression(ring: &Ring, sum: &[Harmonic]) -> Expr {
    sum.iter().fold(Expr::int(0), |total, h| {
        let symbols = h.symbols.iter().fold(Expr::int(1), |x, &(a, n)| x * ring.atom_expr(a).powi(n.into()));
        let angle = h.angle.to_expr();
        let wave = Expr::from(h.cosine.clone()) * angle.cos() + Expr::from(h.sine.clone()) * angle.sin();
        total + symbols * wave
    })
}

/// True for the atoms that only stand for numbers: π, roots of integers, sines of constants.
pub(super) fn is_number(ring: &Ring, atom: Atom) -> bool {
    matches!(ring.kind(atom), AtomKind::Pi | AtomKind::Surd(_))
        || ring.angle_of(atom).is_some_and(Angle::is_constant)
}
