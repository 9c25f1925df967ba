//! Kinds of number that a program can be run over, one operation at a time.

mod extended;
mod interval;
mod single;

pub use extended::Extended;
pub use interval::Interval;

use denavit_symbolic::Rational;

/// What the operations mean for one kind of number.
pub trait Domain: Clone {
    /// An exact constant.
    fn rational(r: &Rational) -> Self;
    /// The constant π.
    fn pi() -> Self;
    /// `−a`
    #[must_use]
    fn neg(&self) -> Self;
    /// `a + b`
    #[must_use]
    fn add(&self, b: &Self) -> Self;
    /// `a − b`
    #[must_use]
    fn sub(&self, b: &Self) -> Self;
    /// `a · b`
    #[must_use]
    fn mul(&self, b: &Self) -> Self;
    /// `a / b`
    #[must_use]
    fn div(&self, b: &Self) -> Self;
    /// `√a`
    #[must_use]
    fn sqrt(&self) -> Self;
    /// `(sin a, cos a)`, a in radians
    #[must_use]
    fn sin_cos(&self) -> (Self, Self);
    /// `atan2(y, x)` for `y` = self, in [−π, π]
    #[must_use]
    fn atan2(&self, x: &Self) -> Self;
}

impl Domain for f64 {
    fn rational(r: &Rational) -> Self {
        r.to_f64()
    }
    fn pi() -> Self {
        std::f64::consts::PI
    }
    fn neg(&self) -> Self {
        -self
    }
    fn add(&self, b: &Self) -> Self {
        self + b
    }
    fn sub(&self, b: &Self) -> Self {
        self - b
    }
    fn mul(&self, b: &Self) -> Self {
        self * b
    }
    fn div(&self, b: &Self) -> Self {
        self / b
    }
    fn sqrt(&self) -> Self {
        f64::sqrt(*self)
    }
    fn sin_cos(&self) -> (Self, Self) {
        f64::sin_cos(*self)
    }
    fn atan2(&self, x: &Self) -> Self {
        f64::atan2(*self, *x)
    }
}
