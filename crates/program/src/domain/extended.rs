//! Double-double numbers: the sum of two doubles, about 31 digits. A reference for rounding errors, not for speed.
//!
//! Sums, products, quotients and roots as in Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic" (2017). Sines, cosines and arctangents are good to 1e-30 relative.
//! Magnitudes between 1e-250 and 1e250 are assumed: beyond, the second double runs out of its range.

use crate::domain::Domain;
use denavit_symbolic::Rational;

/// `hi + lo`, where `hi` is the double nearest to the sum.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extended {
    hi: f64,
    lo: f64,
}

/// The largest magnitude of which sines and cosines are computed: 2⁵⁰, about 1.1e15. Beyond, they are not a number.
const LARGEST_ANGLE: f64 = (1_u64 << 50) as f64;

/// π/2 as a sum of doubles (mpmath 1.3, 400 bits), good to 3e-66.
const HALF_PI: [f64; 4] =
    [std::f64::consts::FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316826e-50];

impl From<f64> for Extended {
    fn from(x: f64) -> Self {
        Extended::from_f64(x)
    }
}

impl Extended {
    /// A double, exactly.
    pub const fn from_f64(x: f64) -> Self {
        Extended { hi: x, lo: 0.0 }
    }

    /// `a + b`, whatever their magnitudes.
    pub fn new(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Extended { hi, lo }.or(a + b)
    }

    /// The nearest double.
    pub fn to_f64(&self) -> f64 {
        self.hi
    }

    /// The two doubles, the larger first.
    pub fn parts(&self) -> [f64; 2] {
        [self.hi, self.lo]
    }

    /// The exact value; `None` for what is not finite.
    pub fn to_rational(&self) -> Option<Rational> {
        Some(Rational::from_f64(self.hi)? + Rational::from_f64(self.lo)?)
    }

    /// The number, or `plain` where that is infinite or not a number.
    fn or(self, plain: f64) -> Self {
        if self.hi.is_finite() && self.lo.is_finite() { self } else { plain.into() }
    }

    /// `a · b` for a double b.
    fn times(&self, b: f64) -> Self {
        let (p, e) = two_product(self.hi, b);
        let (hi, lo) = fast_two_sum(p, self.lo.mul_add(b, e));
        Extended { hi, lo }.or(p)
    }

    /// `(sin r, cos r)` for |r| a little above π/4 at most, by their series.
    fn short_sin_cos(&self) -> (Self, Self) {
        // sin r = r (1 − r²/(2·3) (1 − r²/(4·5) (1 − …))),   cos r = 1 − r²/(1·2) (1 − r²/(3·4) (1 − …))
        // 16 terms: 0.8³³/33! < 1e-39.
        let one = Extended::from(1.0);
        let square = self.mul(self);
        let (mut sine, mut cosine) = (one, one);
        for k in (1..=16).rev() {
            let n = f64::from(2 * k);
            sine = one.sub(&square.mul(&sine).div(&(n * (n + 1.0)).into()));
            cosine = one.sub(&square.mul(&cosine).div(&((n - 1.0) * n).into()));
        }
        (self.mul(&sine), cosine)
    }
}

/// `a + b` and what rounding loses of it, exactly.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let b_part = s - a;
    (s, (a - (s - b_part)) + (b - b_part))
}

/// The same where |a| ≥ |b|.
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// `a · b` and what rounding loses of it, exactly.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    (p, a.mul_add(b, -p))
}

/// The sum of many doubles, rounded once in the end: each is carried through an exact expansion (Shewchuk 1997).
fn exact_sum(terms: &[f64]) -> Extended {
    let mut parts: Vec<f64> = vec![];
    for term in terms {
        let mut carried = *term;
        for part in &mut parts {
            (carried, *part) = two_sum(carried, *part);
        }
        parts.push(carried);
    }
    // From the smallest part up, so that cancelled large ones do not swallow it.
    parts.iter().fold(Extended::from(0.0), |sum, part| sum.add(&Extended::from(*part)))
}

impl Domain for Extended {
    /// The nearest double, and the double nearest to the rest.
    fn rational(r: &Rational) -> Self {
        let hi = r.to_f64();
        match Rational::from_f64(hi) {
            Some(taken) => Extended { hi, lo: (r.clone() - taken).to_f64() },
            None => hi.into(),
        }
    }
    fn pi() -> Self {
        Extended { hi: 2.0 * HALF_PI[0], lo: 2.0 * HALF_PI[1] }
    }
    fn neg(&self) -> Self {
        Extended { hi: -self.hi, lo: -self.lo }
    }
    fn add(&self, b: &Self) -> Self {
        let (s, e) = two_sum(self.hi, b.hi);
        let (t, f) = two_sum(self.lo, b.lo);
        let (s, e) = fast_two_sum(s, e + t);
        let (hi, lo) = fast_two_sum(s, e + f);
        Extended { hi, lo }.or(self.hi + b.hi)
    }
    fn sub(&self, b: &Self) -> Self {
        self.add(&b.neg())
    }
    fn mul(&self, b: &Self) -> Self {
        let (p, e) = two_product(self.hi, b.hi);
        // Written so that a·b is b·a to the last bit.
        let cross = self.hi * b.lo + self.lo * b.hi + self.lo * b.lo;
        let (hi, lo) = fast_two_sum(p, e + cross);
        Extended { hi, lo }.or(p)
    }
    fn div(&self, b: &Self) -> Self {
        // Long division, one double of the quotient at a time.
        let first = self.hi / b.hi;
        let rest = self.sub(&b.times(first));
        let second = rest.hi / b.hi;
        let rest = rest.sub(&b.times(second));
        Extended::new(first, second).add(&(rest.hi / b.hi).into()).or(first)
    }
    fn sqrt(&self) -> Self {
        let s = self.hi.sqrt();
        if s == 0.0 {
            return s.into();
        }
        // √x = s + (x − s²)/(2s), but for the square of the correction
        let (p, e) = two_product(s, s);
        let rest = self.sub(&Extended { hi: p, lo: e });
        let (hi, lo) = fast_two_sum(s, rest.hi / (2.0 * s));
        Extended { hi, lo }.or(s)
    }
    fn sign(&self) -> Self {
        // The low part is smaller than the high one.
        crate::kernel::sign(self.hi).into()
    }
    /// For angles up to 2⁵⁰; not a number beyond.
    fn sin_cos(&self) -> (Self, Self) {
        if self.hi.is_nan() || self.hi.abs() > LARGEST_ANGLE {
            return (f64::NAN.into(), f64::NAN.into());
        }
        // r = x − k·π/2, exactly but for the end of π; k and all its products with a double are exact.
        let k = (self.hi / HALF_PI[0]).round();
        let mut terms = vec![];
        for part in HALF_PI.iter().rev() {
            let (p, e) = two_product(-k, *part);
            terms.extend([e, p]);
        }
        terms.extend([self.lo, self.hi]);
        let r = if k == 0.0 { *self } else { exact_sum(&terms) };
        let (sine, cosine) = r.short_sin_cos();
        match k.rem_euclid(4.0) as u8 {
            0 => (sine, cosine),
            1 => (cosine, sine.neg()),
            2 => (sine.neg(), cosine.neg()),
            _ => (cosine.neg(), sine),
        }
    }
    fn atan2(&self, x: &Self) -> Self {
        let near = self.hi.atan2(x.hi);
        if self.hi == 0.0 && x.hi == 0.0 {
            // 0 or ±π, by the signs of the zeros
            return if near == 0.0 { near.into() } else { Extended::pi().times(near.signum()) };
        }
        // With the angle a near by, the rest is atan2(y·cos a − x·sin a, x·cos a + y·sin a), which its quotient is but
        // for a third of the cube, 1e-48.
        let (sine, cosine) = Extended::from(near).sin_cos();
        let across = self.mul(&cosine).sub(&x.mul(&sine));
        let along = x.mul(&cosine).add(&self.mul(&sine));
        Extended::from(near).add(&across.div(&along)).or(near)
    }
}
