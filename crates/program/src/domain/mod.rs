//! Kinds of number that a program can be run over, one operation at a time.

mod extended;
mod interval;
mod residue;

pub use extended::Extended;
pub use interval::Interval;
pub use residue::{Dependency, Residue};

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
    /// The sign: 1, −1, or the number itself where it is 0 or none
    #[must_use]
    fn sign(&self) -> Self;
}

/// Numbers of the hardware; constants go by way of the nearest double, as in the evaluators.
macro_rules! hardware {
    ($number:ident) => {
        impl Domain for $number {
            fn rational(r: &Rational) -> Self {
                r.to_f64() as $number
            }
            fn pi() -> Self {
                std::$number::consts::PI
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
                $number::sqrt(*self)
            }
            fn sin_cos(&self) -> (Self, Self) {
                $number::sin_cos(*self)
            }
            fn atan2(&self, x: &Self) -> Self {
                $number::atan2(*self, *x)
            }
            fn sign(&self) -> Self {
                crate::kernel::sign(*self)
            }
        }
    };
}
hardware!(f32);
hardware!(f64);
