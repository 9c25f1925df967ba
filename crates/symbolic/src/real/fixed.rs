//! Numbers with 256 binary places: 77 decimals, of which a geometry of some hundred steps leaves 60.

use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cell::RefCell;

/// The binary places.
const PLACES: u64 = 256;
/// Binary places that count: what is smaller is rounding.
const TRUSTED: u64 = 200;

/// A multiple of 2⁻²⁵⁶.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Fixed(BigInt);

impl Fixed {
    pub fn of(x: &Rational) -> Self {
        let (n, d) = x.parts();
        Fixed((n << PLACES) / d)
    }

    /// The least number above 0.
    pub fn smallest() -> Self {
        Fixed(BigInt::one())
    }

    pub fn to_rational(&self) -> Rational {
        Rational::from_parts(self.0.clone(), BigInt::one() << PLACES)
    }

    /// True if it is 0 but for rounding.
    pub fn is_zero(&self) -> bool {
        self.0.bits() <= PLACES - TRUSTED
    }

    pub fn is_negative(&self) -> bool {
        self.0.is_negative()
    }

    pub fn plus(&self, o: &Self) -> Self {
        Fixed(&self.0 + &o.0)
    }

    pub fn minus(&self, o: &Self) -> Self {
        Fixed(&self.0 - &o.0)
    }

    pub fn negated(&self) -> Self {
        Fixed(-&self.0)
    }

    pub fn times(&self, o: &Self) -> Self {
        Fixed((&self.0 * &o.0) >> PLACES)
    }

    /// Nothing for a divisor that is 0 but for rounding.
    pub fn over(&self, o: &Self) -> Option<Self> {
        (!o.is_zero()).then(|| Fixed((&self.0 << PLACES) / &o.0))
    }

    /// Nothing below 0.
    pub fn sqrt(&self) -> Option<Self> {
        match (self.is_zero(), self.is_negative()) {
            (true, _) => Some(Fixed(BigInt::zero())),
            (false, true) => None,
            (false, false) => Some(Fixed((&self.0 << PLACES).sqrt())),
        }
    }

    /// Sine and cosine of radians.
    pub fn sin_cos(&self) -> (Self, Self) {
        // x = k·π/2 + r, and r = 2⁸·t: the series of t, doubled eight times.
        let quarter = &pi().0 >> 1u32;
        let k: BigInt = (&self.0 + (&quarter >> 1u32)) / &quarter;
        let k = if (&self.0 + (&quarter >> 1u32)).is_negative() { k - 1 } else { k };
        let r = &self.0 - &k * &quarter;
        let t = Fixed(r >> 8u32);
        let square = t.times(&t);
        let mut sin = t.clone();
        let mut versine = Fixed(&square.0 >> 1u32); // 1 − cos
        let (mut term, mut even) = (t, versine.clone());
        for n in 1..40u32 {
            term = Fixed(-term.times(&square).0 / (2 * n * (2 * n + 1)));
            even = Fixed(-even.times(&square).0 / ((2 * n + 1) * (2 * n + 2)));
            if term.0.is_zero() && even.0.is_zero() {
                break;
            }
            sin = sin.plus(&term);
            versine = versine.plus(&even);
        }
        let one = BigInt::one() << PLACES;
        for _ in 0..8 {
            // sin 2t = 2 sin t cos t, 1 − cos 2t = 2 sin² t
            let cos = Fixed(&one - &versine.0);
            versine = Fixed(sin.times(&sin).0 << 1u32);
            sin = Fixed(sin.times(&cos).0 << 1u32);
        }
        let cos = Fixed(one - versine.0);
        let turn: BigInt = ((k % 4) + 4) % 4;
        match u8::try_from(turn).unwrap_or(0) {
            0 => (sin, cos),
            1 => (cos, sin.negated()),
            2 => (sin.negated(), cos.negated()),
            _ => (cos.negated(), sin),
        }
    }

    /// The angle of the point (x, y) in (−π, π]; 0 for the origin.
    pub fn atan2(&self, x: &Self) -> Self {
        let r = self.times(self).plus(&x.times(x)).sqrt().unwrap_or(Fixed(BigInt::zero()));
        let (Some(s), Some(c)) = (self.over(&r), x.over(&r)) else { return Fixed(BigInt::zero()) };
        let start = s.to_rational().to_f64().atan2(c.to_rational().to_f64());
        let mut angle = Fixed::of(&Rational::from_f64(start).unwrap_or(Rational::ZERO));
        for _ in 0..3 {
            // sin(a − t) = s·cos t − c·sin t, of which the arcsine is x + x³/6 + …
            let (st, ct) = angle.sin_cos();
            let e = s.times(&ct).minus(&c.times(&st));
            let cube = e.times(&e).times(&e);
            angle = Fixed(angle.0 + e.0 + cube.0 / 6);
        }
        angle
    }
}

/// π, by Machin's formula: 16 arctan 1/5 − 4 arctan 1/239.
pub(super) fn pi() -> Fixed {
    thread_local!(static PI: RefCell<Option<Fixed>> = const { RefCell::new(None) });
    PI.with_borrow_mut(|pi| {
        let machin = || {
            const GUARD: u64 = 32;
            let arctan = |n: u32| {
                let mut power: BigInt = (BigInt::one() << (PLACES + GUARD)) / n;
                let (mut sum, mut k) = (BigInt::zero(), 1u32);
                while !power.is_zero() {
                    let term: BigInt = &power / k;
                    sum = if k % 4 == 1 { sum + term } else { sum - term };
                    power /= n * n;
                    k += 2;
                }
                sum
            };
            Fixed((16 * arctan(5) - 4 * arctan(239)) >> GUARD)
        };
        pi.get_or_insert_with(machin).clone()
    })
}
