//! Single precision.

use crate::domain::Domain;
use denavit_symbolic::Rational;

impl Domain for f32 {
    /// By way of the nearest double, as the evaluators do it.
    fn rational(r: &Rational) -> Self {
        r.to_f64() as f32
    }
    fn pi() -> Self {
        std::f32::consts::PI
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
        f32::sqrt(*self)
    }
    fn sin_cos(&self) -> (Self, Self) {
        f32::sin_cos(*self)
    }
    fn atan2(&self, x: &Self) -> Self {
        f32::atan2(*self, *x)
    }
}
