//! Trigonometric polynomials `p(φ) = Σ cₖ exp(i k φ)` of any degree: from samples, all their roots `z = exp(iφ)` (Aberth 1973),
//! and how many real ones an arc has at most.
//!
//! `P(z) = zⁿ p` has the degree `2 n`; with `z` also `1/z̄` is a root, so real angles are roots on the circle. An arc on which
//! the m-th derivative has no zero holds at most m roots (Rolle). Derivatives are bounded by Taylor's formula, what it
//! leaves by Bernstein's inequality: `|p⁽ᵐ⁾| ≤ nᵐ max |p|`.

use std::f64::consts::TAU;
use std::ops::{Add, Mul, Sub};

/// A complex number.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Complex(pub f64, pub f64);

impl Add for Complex {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Complex(self.0 + b.0, self.1 + b.1)
    }
}

impl Sub for Complex {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        Complex(self.0 - b.0, self.1 - b.1)
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        Complex(self.0 * b.0 - self.1 * b.1, self.0 * b.1 + self.1 * b.0)
    }
}

impl Complex {
    const ZERO: Complex = Complex(0.0, 0.0);
    const ONE: Complex = Complex(1.0, 0.0);

    /// `r exp(iφ)`
    fn polar(r: f64, angle: f64) -> Self {
        let (s, c) = angle.sin_cos();
        Complex(r * c, r * s)
    }

    /// Its modulus.
    pub fn size(self) -> f64 {
        self.0.hypot(self.1)
    }

    /// Its angle.
    pub fn angle(self) -> f64 {
        self.1.atan2(self.0)
    }

    fn over(self, b: Self) -> Self {
        let square = b.0 * b.0 + b.1 * b.1;
        let by = Complex(b.0 / square, -b.1 / square);
        self * by
    }
}

/// A trigonometric polynomial, its largest sample 1.
#[derive(Clone, Debug)]
pub(super) struct Trigonometric {
    /// c₀ … cₙ.
    coefficients: Vec<Complex>,
    /// The size of the harmonics above the degree, which would be zero without rounding.
    pub noise: f64,
}

/// More samples than the harmonics take: they show the noise.
const MORE: usize = 17;
/// Where the first sample stands, as a part of the spacing: at no special angle.
const START: f64 = 0.381_966_011_250_105_1;
/// Leading coefficients below this are dropped: their roots are at 0 and at infinity.
const LEADING: f64 = 1e-14;
/// A root at which the polynomial is smaller than this is not improved.
const FLOOR: f64 = 1e-16;
/// Square of the relative step that ends the iteration, and the most iterations.
const STEP: f64 = 1e-24;
const MOST: usize = 80;
/// How many derivatives are taken, the value among them; roots are counted up to so many.
const ORDER: usize = 14;
const MOST_ROOTS: usize = 4;

impl Trigonometric {
    /// From a function with the degree; nothing if its samples are all zero or not numbers.
    pub fn of(degree: usize, function: impl Fn(f64) -> f64) -> Option<Self> {
        let count = 2 * degree + MORE;
        let angle = |i: usize| TAU * (i as f64 + START) / count as f64;
        let mut samples: Vec<f64> = (0..count).map(|i| function(angle(i))).collect();
        let top = samples.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if !(top > 1e-250 && top < 1e250) {
            return None;
        }
        samples.iter_mut().for_each(|x| *x /= top);
        let coefficient = |k: usize| {
            let turned = |(i, x): (usize, &f64)| {
                // exp(−i k φ), the angle brought down to one turn first
                let at = (k as f64 * (i as f64 + START) / count as f64).fract();
                Complex::polar(x / count as f64, -TAU * at)
            };
            samples.iter().enumerate().map(turned).fold(Complex::ZERO, Add::add)
        };
        let coefficients = (0..=degree).map(coefficient).collect();
        let above = (degree + 1..=count / 2).map(|k| coefficient(k).size());
        let noise = above.map(|x| x * x).sum::<f64>().sqrt();
        noise.is_finite().then_some(Trigonometric { coefficients, noise })
    }

    /// The highest harmonic that is more than `noise`.
    pub fn degree_above(&self, noise: f64) -> usize {
        self.coefficients.iter().rposition(|c| c.size() > noise).unwrap_or(0)
    }

    /// How many roots the arc from `x − h` to `x + h` has at most, if they are few; of any polynomial that differs from this one
    /// by `noise` at most.
    pub fn most_roots(&self, x: f64, h: f64, noise: f64) -> Option<usize> {
        let at = self.derivatives(x);
        let n = self.coefficients.len() as f64 - 1.0;
        let last = at.len();
        let no_zero = |m: &usize| {
            let (mut power, mut sum) = (1.0, noise * n.powi(*m as i32));
            for (j, d) in at[m + 1..].iter().enumerate() {
                power *= h / (j + 1) as f64;
                sum += d.abs() * power;
            }
            power *= h / (last - m) as f64;
            // The largest sample is 1, and not much less than the largest value.
            at[*m].abs() > sum + 2.0 * n.powi(last as i32) * power
        };
        (0..=MOST_ROOTS).find(no_zero)
    }

    /// The value.
    pub fn value(&self, x: f64) -> f64 {
        self.derivatives(x)[0]
    }

    /// The value and the derivatives up to an order.
    fn derivatives(&self, x: f64) -> [f64; ORDER] {
        let mut sums = [0.0; ORDER];
        for (k, c) in self.coefficients.iter().enumerate() {
            let times = if k == 0 { 1.0 } else { 2.0 };
            let mut term = *c * Complex::polar(times, (k as f64 * x) % TAU);
            for sum in &mut sums {
                *sum += term.0;
                // i k
                term = Complex(-(k as f64) * term.1, k as f64 * term.0);
            }
        }
        sums
    }

    /// All roots.
    pub fn roots(&self) -> Vec<Complex> {
        let degree = self.degree_above(LEADING);
        let count = 2 * degree;
        if count == 0 {
            return vec![];
        }
        // c₋ₙ … cₙ
        let c: Vec<Complex> = (0..=count)
            .map(|k| {
                let own = self.coefficients[k.abs_diff(degree)];
                if k < degree { Complex(own.0, -own.1) } else { own }
            })
            .collect();
        // P and P', both by z^count where z is large: from the other end.
        let value = |z: Complex| {
            let (mut p, mut d) = (Complex::ZERO, Complex::ZERO);
            for &c in c.iter().rev() {
                d = d * z + p;
                p = p * z + c;
            }
            (p, d)
        };
        let mut z: Vec<Complex> = (0..count)
            .map(|k| {
                let radius = if k % 2 == 0 { 1.05 } else { 1.0 / 1.05 };
                Complex::polar(radius, TAU * (k as f64 + 0.3) / count as f64)
            })
            .collect();
        for _ in 0..MOST {
            let mut largest: f64 = 0.0;
            for k in 0..count {
                let (p, d) = value(z[k]);
                if p.size() < FLOOR * z[k].size().powi(degree as i32).max(1.0) {
                    continue;
                }
                let sum = (0..count)
                    .filter(|&j| j != k && z[j] != z[k])
                    .fold(Complex::ZERO, |sum, j| sum + Complex::ONE.over(z[k] - z[j]));
                let step = p.over(d - p * sum);
                if step.0.is_finite() && step.1.is_finite() {
                    z[k] = z[k] - step;
                    largest = largest.max((step.size() / z[k].size()).powi(2));
                }
            }
            if largest < STEP {
                break;
            }
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sin(φ − 0.3)·sin(2φ + 1)·(2 + cos φ): six real roots, two others.
    #[test]
    fn all_roots_are_found() {
        let of = |x: f64| (x - 0.3).sin() * (2.0 * x + 1.0).sin() * (2.0 + x.cos());
        let p = Trigonometric::of(4, of).expect("it does not vanish");
        assert!(p.noise < 1e-14, "{}", p.noise);
        let roots = p.roots();
        assert_eq!(roots.len(), 8);
        let real: Vec<&Complex> = roots.iter().filter(|z| (z.size() - 1.0).abs() < 1e-9).collect();
        assert_eq!(real.len(), 6);
        assert!(real.iter().all(|z| of(z.angle()).abs() < 1e-12), "{roots:?}");
    }

    /// sin(φ − 0.3)·sin²(φ/2 − 0.1): a root, and a double one at 0.2.
    #[test]
    fn roots_on_an_arc_are_counted() {
        let of = |x: f64| (x - 0.3).sin() * (0.5 * x - 0.1).sin().powi(2);
        let p = Trigonometric::of(2, of).expect("it does not vanish");
        let most = |from: f64, to: f64| p.most_roots(0.5 * (from + to), 0.5 * (to - from), 1e-13);
        assert_eq!(most(0.55, 0.6), Some(0));
        assert_eq!(most(0.29, 0.32), Some(1));
        assert_eq!(most(0.19, 0.21), Some(2));
        assert_eq!(most(0.15, 0.35), Some(3));
        assert_eq!(most(0.0, 3.0), None);
        assert!((p.value(1.0) / p.value(2.0) - of(1.0) / of(2.0)).abs() < 1e-13);
    }

    #[test]
    fn what_vanishes_has_no_polynomial() {
        assert!(Trigonometric::of(3, |_| 0.0).is_none());
    }
}
