//! Eight doubles side by side, and the arithmetic on them.
//!
//! Each operation is one loop over the eight lanes, which the compiler turns into vector instructions; a set of
//! instructions says whether products inside sums keep all their digits.

use crate::instructions::Instructions;

/// Number of lanes.
pub const WIDTH: usize = 8;

/// Eight doubles.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Lanes(pub [f64; WIDTH]);

/// `a b + c`.
#[inline(always)]
pub fn mul_add<I: Instructions>(a: f64, b: f64, c: f64) -> f64 {
    if I::FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Stands in loops over lanes: it generates no code, and keeps the compiler from making vectors across iterations, with
/// gathers and scatters, instead of along the lanes.
#[inline(always)]
pub fn one_by_one() {
    std::hint::black_box(());
}

impl Lanes {
    /// Zeros.
    pub const ZERO: Lanes = Lanes([0.0; WIDTH]);
    /// Ones.
    pub const ONE: Lanes = Lanes([1.0; WIDTH]);

    /// The same number in each lane.
    #[inline(always)]
    pub fn splat(x: f64) -> Lanes {
        Lanes([x; WIDTH])
    }

    /// `self b + c`.
    #[inline(always)]
    pub fn mul_add<I: Instructions>(self, b: Lanes, c: Lanes) -> Lanes {
        let mut out = c;
        for l in 0..WIDTH {
            out.0[l] = mul_add::<I>(self.0[l], b.0[l], c.0[l]);
        }
        out
    }

    /// `c - self b`.
    #[inline(always)]
    pub fn mul_sub<I: Instructions>(self, b: Lanes, c: Lanes) -> Lanes {
        let mut out = c;
        for l in 0..WIDTH {
            out.0[l] = mul_add::<I>(-self.0[l], b.0[l], c.0[l]);
        }
        out
    }

    /// `self x + c` with one number for all lanes.
    #[inline(always)]
    pub fn scale_add<I: Instructions>(self, x: f64, c: Lanes) -> Lanes {
        let mut out = c;
        for l in 0..WIDTH {
            out.0[l] = mul_add::<I>(self.0[l], x, c.0[l]);
        }
        out
    }

    /// `self x` with one number for all lanes.
    #[inline(always)]
    pub fn scale(self, x: f64) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] *= x;
        }
        out
    }

    /// `self + b`.
    #[inline(always)]
    pub fn plus(self, b: Lanes) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] += b.0[l];
        }
        out
    }

    /// `self - b`.
    #[inline(always)]
    pub fn minus(self, b: Lanes) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] -= b.0[l];
        }
        out
    }

    /// `self b`.
    #[inline(always)]
    pub fn times(self, b: Lanes) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] *= b.0[l];
        }
        out
    }

    /// `self / b`.
    #[inline(always)]
    pub fn over(self, b: Lanes) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] /= b.0[l];
        }
        out
    }

    /// `-self`.
    #[inline(always)]
    pub fn negated(self) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] = -out.0[l];
        }
        out
    }

    /// `|self|`.
    #[inline(always)]
    pub fn magnitude(self) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] = out.0[l].abs();
        }
        out
    }

    /// The square root.
    #[inline(always)]
    pub fn root(self) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] = out.0[l].sqrt();
        }
        out
    }

    /// The larger of the two.
    #[inline(always)]
    pub fn larger(self, b: Lanes) -> Lanes {
        let mut out = self;
        for l in 0..WIDTH {
            out.0[l] = if b.0[l] > self.0[l] { b.0[l] } else { self.0[l] };
        }
        out
    }

    /// `yes` in the lanes where `self < b`, else `no`.
    #[inline(always)]
    pub fn where_less(self, b: Lanes, yes: Lanes, no: Lanes) -> Lanes {
        let mut out = no;
        for l in 0..WIDTH {
            out.0[l] = if self.0[l] < b.0[l] { yes.0[l] } else { no.0[l] };
        }
        out
    }

    /// `yes` in the lanes where `self` is `x`, else `no`.
    #[inline(always)]
    pub fn where_is(self, x: f64, yes: Lanes, no: Lanes) -> Lanes {
        let mut out = no;
        for l in 0..WIDTH {
            out.0[l] = if self.0[l] == x { yes.0[l] } else { no.0[l] };
        }
        out
    }

    /// The largest of the lanes; lanes that are not numbers are passed over.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        let mut out = f64::NEG_INFINITY;
        for l in 0..WIDTH {
            out = if self.0[l] > out { self.0[l] } else { out };
        }
        out
    }
}
