//! The numbers that algorithms are written in.
//!
//! Straight-line code over [`Scalar`] runs on `f64`, where it is the oracle, and on [`Expr`], where it leaves
//! the formula. No algorithm over `Scalar` branches on a value.

use denavit_symbolic::Expr;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number (`f64`) or a formula (`Expr`).
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// An integer.
    fn int(n: i64) -> Self;
    /// 0
    #[inline]
    fn zero() -> Self {
        Self::int(0)
    }
    /// 1
    #[inline]
    fn one() -> Self {
        Self::int(1)
    }
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The square root that is not negative.
    fn sqrt(self) -> Self;
}

impl Scalar for f64 {
    #[inline]
    fn int(n: i64) -> Self {
        n as f64
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}

impl Scalar for Expr {
    #[inline]
    fn int(n: i64) -> Self {
        Expr::int(n)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        Expr::sin_cos(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        Expr::sqrt(self)
    }
}
