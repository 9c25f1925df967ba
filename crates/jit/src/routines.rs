//! Sine, cosine and arctangent as generated code calls them: several values in one call, by the C convention.
//!
//! Arguments are single doubles, so that they stay in registers: eight of them stored one by one and loaded as a vector
//! would make the processor wait until the stores have left its pipeline, which doubles the time of a short program.
//! The functions are those of [`denavit_program::kernel`], with the same bits at every width.

use denavit_program::{Arithmetic, Isa, kernel};
use std::mem::MaybeUninit;

/// Angles in one call.
pub(crate) const ANGLES: usize = 8;
/// Points in one call.
pub(crate) const POINTS: usize = 4;

/// Where a routine puts its results. One cache line each: generated code cannot align its own stack that far.
#[repr(C, align(64))]
pub(crate) struct Results {
    /// Sines, or the angles of points.
    pub first: [MaybeUninit<f64>; ANGLES],
    /// Cosines.
    pub second: [MaybeUninit<f64>; ANGLES],
}

impl Results {
    pub const NONE: Results =
        Results { first: [MaybeUninit::uninit(); ANGLES], second: [MaybeUninit::uninit(); ANGLES] };
}

/// The addresses of the routines.
#[derive(Clone, Copy)]
pub(crate) struct Routines {
    /// `extern "C" fn(x₀, …, x₇, &mut Results)`
    pub sin_cos: *const u8,
    /// `extern "C" fn(y₀, x₀, …, y₃, x₃, &mut Results)`
    pub atan2: *const u8,
}

impl Routines {
    /// Those that use some instructions and round in some way. They may be called where `isa` exists.
    pub fn of(isa: Isa, arithmetic: Arithmetic) -> Self {
        match isa.name() {
            #[cfg(target_arch = "x86_64")]
            "AVX-512" => avx512::routines(arithmetic),
            #[cfg(target_arch = "x86_64")]
            "AVX2" => avx2::routines(arithmetic),
            _ => portable::routines(arithmetic),
        }
    }
}

/// The routines compiled for some instructions.
macro_rules! routines {
    ($name:ident $(, #[$features:meta])?) => {
        mod $name {
            use super::{Arithmetic, Results, Routines};

            $(#[$features])?
            #[allow(clippy::too_many_arguments, reason = "each in a register")]
            extern "C" fn sin_cos<const FUSED: bool>(
                x0: f64,
                x1: f64,
                x2: f64,
                x3: f64,
                x4: f64,
                x5: f64,
                x6: f64,
                x7: f64,
                results: &mut Results,
            ) {
                super::sin_cos::<FUSED>([x0, x1, x2, x3, x4, x5, x6, x7], results);
            }

            $(#[$features])?
            #[allow(clippy::too_many_arguments, reason = "each in a register")]
            extern "C" fn atan2<const FUSED: bool>(
                y0: f64,
                x0: f64,
                y1: f64,
                x1: f64,
                y2: f64,
                x2: f64,
                y3: f64,
                x3: f64,
                results: &mut Results,
            ) {
                super::atan2::<FUSED>([y0, y1, y2, y3], [x0, x1, x2, x3], results);
            }

            pub(super) fn routines(arithmetic: Arithmetic) -> Routines {
                let (sin_cos, atan2) = match arithmetic {
                    Arithmetic::Fused => (sin_cos::<true> as *const u8, atan2::<true> as *const u8),
                    Arithmetic::Strict => (sin_cos::<false> as *const u8, atan2::<false> as *const u8),
                };
                Routines { sin_cos, atan2 }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
routines!(avx512, #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]);
#[cfg(target_arch = "x86_64")]
routines!(avx2, #[target_feature(enable = "avx2,fma")]);
routines!(portable);

// Arrays are taken by value, and the repairs get copies: an array of which the compiler keeps one address does not stay
// in registers. The benchmark notices: one configuration then takes almost twice the time.

#[inline(always)]
fn sin_cos<const FUSED: bool>(x: [f64; ANGLES], results: &mut Results) {
    for (i, x) in x.into_iter().enumerate() {
        let (sin, cos) = if FUSED { kernel::sin_cos_fused(x) } else { kernel::sin_cos_strict(x) };
        results.first[i].write(sin);
        results.second[i].write(cos);
    }
    if !x.iter().fold(true, |all, x| all & kernel::sin_cos_in_range(*x)) {
        let copy = x;
        repair_sin_cos(&copy, results);
    }
}

#[inline(always)]
fn atan2<const FUSED: bool>(y: [f64; POINTS], x: [f64; POINTS], results: &mut Results) {
    for (i, (y, x)) in y.into_iter().zip(x).enumerate() {
        let angle = if FUSED { kernel::atan2_fused(y, x) } else { kernel::atan2_strict(y, x) };
        results.first[i].write(angle);
    }
    if !y.iter().zip(&x).fold(true, |all, (y, x)| all & kernel::atan2_in_range(*y, *x)) {
        let copies = (y, x);
        repair_atan2(&copies.0, &copies.1, results);
    }
}

#[cold]
#[inline(never)]
fn repair_sin_cos(x: &[f64; ANGLES], results: &mut Results) {
    for (i, &x) in x.iter().enumerate() {
        if !kernel::sin_cos_in_range(x) {
            let (sin, cos) = kernel::sin_cos_huge(x);
            results.first[i].write(sin);
            results.second[i].write(cos);
        }
    }
}

#[cold]
#[inline(never)]
fn repair_atan2(y: &[f64; POINTS], x: &[f64; POINTS], results: &mut Results) {
    for (i, (&y, &x)) in y.iter().zip(x).enumerate() {
        if !kernel::atan2_in_range(y, x) {
            results.first[i].write(kernel::atan2_rare(y, x));
        }
    }
}
