//! Which vector instructions the processor has, and how loops get compiled for each set of them.
//!
//! All `unsafe` code of the crate is here: the calls of functions that are compiled for instructions which an [`Isa`]
//! has found, and the vector loads and stores of the transposition.
#![allow(unsafe_code)]

use crate::evaluate::real::Real;

/// A set of vector instructions that this processor has: a value exists only where they were found.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Isa(Set);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Set {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// How the routines for sine, cosine and arctangent round; both keep to 2 units in the last place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Arithmetic {
    /// With fused multiplications inside: the faster one where the hardware has them.
    Fused,
    /// Without: the same bits on every machine.
    Strict,
}

/// Loops that can be compiled for any set of instructions. `run` must be `#[inline(always)]`, as must be what it
/// calls, for the compiler to use them; but what it gives to [`Instructions::apart`].
pub(crate) trait Work {
    /// Does it.
    fn run<I: Instructions, const FUSED: bool>(self);
}

/// A set of instructions at compile time. Only [`Isa::run`] names one, where the processor has them.
pub(crate) trait Instructions {
    /// Does some work in a function of its own, which all that calls for it share.
    fn apart<W: Work, const FUSED: bool>(work: W);
}

enum Portable {}

impl Instructions for Portable {
    #[inline(never)]
    fn apart<W: Work, const FUSED: bool>(work: W) {
        work.run::<Self, FUSED>();
    }
}

/// A set of vector instructions, and how work gets compiled for it.
#[cfg(target_arch = "x86_64")]
macro_rules! set {
    ($set:ident, $features:literal) => {
        enum $set {}

        impl Instructions for $set {
            #[inline]
            fn apart<W: Work, const FUSED: bool>(work: W) {
                #[inline(never)]
                #[target_feature(enable = $features)]
                fn compiled<W: Work, const FUSED: bool>(work: W) {
                    work.run::<$set, FUSED>();
                }
                // SAFETY: see [`Instructions`].
                unsafe { compiled::<W, FUSED>(work) }
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
set!(Avx2, "avx2,fma");
#[cfg(target_arch = "x86_64")]
set!(Avx512, "avx512f,avx512dq,avx512vl,avx2,fma");

impl Isa {
    /// The instructions that every processor of this architecture has (NEON on AArch64).
    pub const PORTABLE: Isa = Isa(Set::Portable);

    /// All sets that this processor has, the fastest first.
    pub fn available() -> Vec<Isa> {
        let mut found = vec![];
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                found.push(Isa(Set::Avx512));
            }
            found.push(Isa(Set::Avx2));
        }
        found.push(Isa::PORTABLE);
        found
    }

    /// The fastest set that this processor has.
    pub fn detect() -> Isa {
        static FOUND: std::sync::OnceLock<Isa> = std::sync::OnceLock::new();
        *FOUND.get_or_init(|| Isa::available()[0])
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Portable if cfg!(target_arch = "aarch64") => "NEON",
            Set::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "AVX-512",
        }
    }

    /// Fused where the hardware has fused multiplications, strict elsewhere.
    pub fn arithmetic(self) -> Arithmetic {
        match self.0 {
            Set::Portable if cfg!(any(target_arch = "aarch64", target_feature = "fma")) => Arithmetic::Fused,
            Set::Portable => Arithmetic::Strict,
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 | Set::Avx512 => Arithmetic::Fused,
        }
    }

    /// Does some work, compiled for this set.
    #[inline]
    pub(crate) fn run<W: Work>(self, arithmetic: Arithmetic, work: W) {
        // `Isa::available` makes `Avx2` and `Avx512` only where their instructions are found.
        match (self.0, arithmetic) {
            #[cfg(target_arch = "x86_64")]
            (Set::Avx512, Arithmetic::Fused) => Avx512::apart::<W, true>(work),
            #[cfg(target_arch = "x86_64")]
            (Set::Avx512, Arithmetic::Strict) => Avx512::apart::<W, false>(work),
            #[cfg(target_arch = "x86_64")]
            (Set::Avx2, Arithmetic::Fused) => Avx2::apart::<W, true>(work),
            #[cfg(target_arch = "x86_64")]
            (Set::Avx2, Arithmetic::Strict) => Avx2::apart::<W, false>(work),
            (Set::Portable, Arithmetic::Fused) => Portable::apart::<W, true>(work),
            (Set::Portable, Arithmetic::Strict) => Portable::apart::<W, false>(work),
        }
    }
}

/// Copies numbers without leaving them in the cache, where the processor can. [`settle_copies`] must follow before
/// another thread reads them.
#[inline]
pub(crate) fn copy_past_cache<T: Real>(from: &[T], to: &mut [T]) {
    assert_eq!(from.len(), to.len(), "as many to write as to read");
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{__m128i, _mm_loadu_si128, _mm_stream_si128};
        const STEP: usize = size_of::<__m128i>();
        let bytes = size_of_val(from);
        let (source, target) = (from.as_ptr().cast::<u8>(), to.as_mut_ptr().cast::<u8>());
        let head = target.align_offset(STEP).min(bytes);
        let end = bytes - (bytes - head) % STEP;
        // SAFETY: both slices are `bytes` long, and [0, head), [head, end), [end, bytes) cover them. Steps of the
        // middle begin at multiples of STEP in the target; the source may have any alignment. `Real` is f32 or f64,
        // which have no padding and hold any bits.
        unsafe {
            std::ptr::copy_nonoverlapping(source, target, head);
            for k in (head..end).step_by(STEP) {
                let (source, target) = (source.add(k).cast::<__m128i>(), target.add(k).cast::<__m128i>());
                // Miri does not know the store that bypasses the cache.
                if cfg!(miri) {
                    target.write(_mm_loadu_si128(source));
                } else {
                    _mm_stream_si128(target, _mm_loadu_si128(source));
                }
            }
            std::ptr::copy_nonoverlapping(source.add(end), target.add(end), bytes - end);
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    to.copy_from_slice(from);
}

/// Waits until what [`copy_past_cache`] wrote can be seen by all threads.
pub(crate) fn settle_copies() {
    // Miri does not know the fence, as it does not know the stores.
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    // SAFETY: a fence, without conditions.
    unsafe {
        std::arch::x86_64::_mm_sfence();
    }
}
