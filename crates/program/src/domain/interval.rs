//! Intervals with outward rounding: whatever the operands are inside theirs, the result is inside its own.
//!
//! This holds for real numbers, and for doubles that are evaluated operation by operation. Sums, products, quotients
//! and roots are widened by one unit in the last place, which is what rounding to nearest can lose; sines, cosines and
//! arctangents by [`ROUTINE_ULPS`], which no library in use exceeds.

use crate::domain::Domain;
use denavit_symbolic::Rational;

/// The numbers from `lo` to `hi`, both included. An infinite end means that there is no bound on that side.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// The lower end.
    pub lo: f64,
    /// The upper end.
    pub hi: f64,
}

/// Units in the last place that are granted to the sine, cosine and arctangent of the platform.
const ROUTINE_ULPS: u32 = 4;

impl Interval {
    /// All real numbers.
    pub const WHOLE: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// From `lo` to `hi`.
    ///
    /// # Panics
    /// If `lo` is above `hi`, one of them is not a number, or there is no real number between them.
    pub fn new(lo: f64, hi: f64) -> Self {
        assert!(lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY, "an interval of real numbers");
        Interval { lo, hi }
    }

    /// A single number; all numbers for infinities and what is not a number.
    pub fn point(x: f64) -> Self {
        if x.is_finite() { Interval { lo: x, hi: x } } else { Interval::WHOLE }
    }

    /// True for a number that is inside.
    pub fn contains(&self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// How far apart the ends are, rounded up.
    pub fn width(&self) -> f64 {
        (self.hi - self.lo).next_up()
    }

    /// The smallest interval around others.
    fn hull(parts: [Interval; 4]) -> Self {
        parts.into_iter().fold(parts[0], |all, p| Interval { lo: all.lo.min(p.lo), hi: all.hi.max(p.hi) })
    }

    /// Around an exact value that was rounded to `x`.
    fn rounded(x: f64) -> Self {
        Interval { lo: x.next_down(), hi: x.next_up() }
    }

    /// Around a value that a routine gave as `x`.
    fn routine(x: f64) -> Self {
        let widen = |x: f64, step: fn(f64) -> f64| (0..ROUTINE_ULPS).fold(x, |x, _| step(x));
        Interval { lo: widen(x, f64::next_down), hi: widen(x, f64::next_up) }
    }

    /// True if `x/(2π) − phase` may be an integer for an x inside. Where doubles are so coarse that this cannot be
    /// told, it may be.
    fn may_meet(&self, phase: f64) -> bool {
        let turn = Interval { lo: 2.0 * PI_DOWN, hi: 2.0 * PI_UP };
        let turns = self.div(&turn).sub(&Interval::point(phase));
        turns.lo.ceil() <= turns.hi.floor()
    }

    /// The range of sine or cosine, given its values at the ends and the phases of its maxima and minima.
    fn wave(&self, f: fn(f64) -> f64, maximum: f64, minimum: f64) -> Self {
        if self.lo.is_infinite() || self.hi.is_infinite() {
            return Interval { lo: -1.0, hi: 1.0 };
        }
        let [a, b] = [self.lo, self.hi].map(|x| Interval::routine(f(x)));
        let lo = if self.may_meet(minimum) { -1.0 } else { a.lo.min(b.lo).max(-1.0) };
        let hi = if self.may_meet(maximum) { 1.0 } else { a.hi.max(b.hi).min(1.0) };
        Interval { lo, hi }
    }
}

/// The double below π, which is the one nearest to it.
const PI_DOWN: f64 = std::f64::consts::PI;
/// The double above π.
const PI_UP: f64 = PI_DOWN.next_up();

impl Domain for Interval {
    fn rational(r: &Rational) -> Self {
        let x = r.to_f64();
        if Rational::from_f64(x).as_ref() == Some(r) { Interval::point(x) } else { Interval::rounded(x) }
    }
    fn pi() -> Self {
        Interval { lo: PI_DOWN, hi: PI_UP }
    }
    fn neg(&self) -> Self {
        Interval { lo: -self.hi, hi: -self.lo }
    }
    fn add(&self, b: &Self) -> Self {
        Interval { lo: (self.lo + b.lo).next_down(), hi: (self.hi + b.hi).next_up() }
    }
    fn sub(&self, b: &Self) -> Self {
        self.add(&b.neg())
    }
    fn mul(&self, b: &Self) -> Self {
        // 0 times an end without bound is 0: numbers inside are finite.
        let corner = |x: f64, y: f64| {
            if x == 0.0 || y == 0.0 { Interval { lo: 0.0, hi: 0.0 } } else { Interval::rounded(x * y) }
        };
        Interval::hull([
            corner(self.lo, b.lo),
            corner(self.lo, b.hi),
            corner(self.hi, b.lo),
            corner(self.hi, b.hi),
        ])
    }
    /// All numbers if the divisor contains 0.
    fn div(&self, b: &Self) -> Self {
        if b.contains(0.0) {
            return Interval::WHOLE;
        }
        // ∞/∞ stands for quotients between those of the other corners, which include 0 and ∞.
        let corner = |x: f64, y: f64| match x / y {
            q if q.is_nan() || x == 0.0 => Interval { lo: 0.0, hi: 0.0 },
            q => Interval::rounded(q),
        };
        Interval::hull([
            corner(self.lo, b.lo),
            corner(self.lo, b.hi),
            corner(self.hi, b.lo),
            corner(self.hi, b.hi),
        ])
    }
    /// Of what is not negative; what is negative has no root and is left out. All numbers if nothing remains, which
    /// claims nothing.
    fn sqrt(&self) -> Self {
        if self.hi < 0.0 {
            return Interval::WHOLE;
        }
        let lo = if self.lo <= 0.0 { 0.0 } else { self.lo.sqrt().next_down() };
        let hi = if self.hi == 0.0 { 0.0 } else { self.hi.sqrt().next_up() };
        Interval { lo, hi }
    }
    /// From −1 to 1 if 0 may be inside.
    fn sign(&self) -> Self {
        Interval { lo: self.lo.sign(), hi: self.hi.sign() }
    }
    fn sin_cos(&self) -> (Self, Self) {
        (self.wave(f64::sin, 0.25, 0.75), self.wave(f64::cos, 0.0, 0.5))
    }
    /// From −π to π if the box touches the half line y = 0, x ≤ 0.
    fn atan2(&self, x: &Self) -> Self {
        if self.contains(0.0) && x.lo <= 0.0 {
            return Interval { lo: -PI_UP, hi: PI_UP };
        }
        // The angle of a point has no extremum inside, nor on an edge: the extrema are at corners.
        let corner = |y: f64, x: f64| Interval::routine(y.atan2(x));
        Interval::hull([
            corner(self.lo, x.lo),
            corner(self.lo, x.hi),
            corner(self.hi, x.lo),
            corner(self.hi, x.hi),
        ])
    }
}
