//! What the evaluators need of `f32` and `f64`.

use crate::evaluate::file::{Double, File, Single};
use crate::kernel;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A floating-point number with block routines for its functions: `f32` or `f64`, and no other.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + PartialOrd
    + From<i8>
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The registers of a block.
    type File: File<Self>;
    /// The nearest number of this kind.
    fn from_f64(x: f64) -> Self;
    /// `√a`
    #[must_use]
    fn sqrt(self) -> Self;
    /// `s = sin x`, `c = cos x`, lane by lane; with fused multiplications inside or without.
    fn sin_cos_lanes<const FUSED: bool, const N: usize>(x: &[Self; N], s: &mut [Self; N], c: &mut [Self; N]);
    /// `a = atan2(y, x)`, lane by lane.
    fn atan2_lanes<const FUSED: bool, const N: usize>(y: &[Self; N], x: &[Self; N], a: &mut [Self; N]);
}

impl Real for f64 {
    type File = Double;
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn sin_cos_lanes<const FUSED: bool, const N: usize>(x: &[Self; N], s: &mut [Self; N], c: &mut [Self; N]) {
        kernel::sin_cos_lanes::<FUSED, N>(x, s, c);
    }
    #[inline(always)]
    fn atan2_lanes<const FUSED: bool, const N: usize>(y: &[Self; N], x: &[Self; N], a: &mut [Self; N]) {
        kernel::atan2_lanes::<FUSED, N>(y, x, a);
    }
}

impl Real for f32 {
    type File = Single;
    fn from_f64(x: f64) -> Self {
        x as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn sin_cos_lanes<const FUSED: bool, const N: usize>(x: &[Self; N], s: &mut [Self; N], c: &mut [Self; N]) {
        kernel::sin_cos_lanes_f32::<FUSED, N>(x, s, c);
    }
    #[inline(always)]
    fn atan2_lanes<const FUSED: bool, const N: usize>(y: &[Self; N], x: &[Self; N], a: &mut [Self; N]) {
        kernel::atan2_lanes_f32::<FUSED, N>(y, x, a);
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}
