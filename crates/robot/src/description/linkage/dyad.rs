//! The dyads of planar loops in closed form: two links between two places that are known, with three joints that turn or slide.
//!
//! Straight-line code over [`Scalar`]: numbers, or the formulas of them. Vectors of the plane are complex numbers; an unknown
//! direction is one of length 1. Of two solutions `sign`, which is 1 or −1, takes one.

use crate::scalar::Scalar;
use std::ops::{Add, Mul, Neg, Sub};

/// A complex number.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Complex<T> {
    /// The real part.
    pub re: T,
    /// The imaginary part.
    pub im: T,
}

impl<T: Scalar> Complex<T> {
    /// x + iy
    pub fn new(re: T, im: T) -> Self {
        Complex { re, im }
    }

    /// e(φ)
    pub fn direction(angle: T) -> Self {
        let (im, re) = angle.sin_cos();
        Complex { re, im }
    }

    /// x − iy
    #[must_use]
    pub fn conj(self) -> Self {
        Complex { re: self.re, im: -self.im }
    }

    /// |z|²
    pub fn square(self) -> T {
        self.re * self.re + self.im * self.im
    }

    /// z·k
    #[must_use]
    pub fn scale(self, k: T) -> Self {
        Complex { re: self.re * k, im: self.im * k }
    }

    /// z/k
    #[must_use]
    pub fn over(self, k: T) -> Self {
        Complex { re: self.re / k, im: self.im / k }
    }
}

impl<T: Scalar> Add for Complex<T> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Complex { re: self.re + o.re, im: self.im + o.im }
    }
}

impl<T: Scalar> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Complex { re: self.re - o.re, im: self.im - o.im }
    }
}

impl<T: Scalar> Neg for Complex<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Complex { re: -self.re, im: -self.im }
    }
}

impl<T: Scalar> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Complex { re: self.re * o.re - self.im * o.im, im: self.re * o.im + self.im * o.re }
    }
}

/// Three joints that turn, A·e₁ + B·e₂ = P: the square of twice the area of the triangle that A and B make with P.
///
/// With w = A·e₁: |w|² = |A|² and w·P = (|P|² + |A|² − |B|²)/2 = k, so that the part of w across P is h/|P| with h² = |P|²|A|² − k².
pub fn rrr_square<T: Scalar>(a: Complex<T>, b: Complex<T>, p: Complex<T>) -> T {
    let k = rrr_along(a, b, p);
    p.square() * a.square() - k * k
}

fn rrr_along<T: Scalar>(a: Complex<T>, b: Complex<T>, p: Complex<T>) -> T {
    (p.square() + a.square() - b.square()) / T::int(2)
}

/// e₁ and e₂ of three joints that turn; h is the root of [`rrr_square`] with its sign: twice the area of the triangle, turning
/// from P to A·e₁.
pub fn rrr<T: Scalar>(a: Complex<T>, b: Complex<T>, p: Complex<T>, h: T) -> [Complex<T>; 2] {
    // w = P(k + ih)/|P|²
    let w = (p * Complex::new(rrr_along(a, b, p), h)).over(p.square());
    rrr_of(a, b, p, w)
}

/// e₁ and e₂ from w = A·e₁.
fn rrr_of<T: Scalar>(a: Complex<T>, b: Complex<T>, p: Complex<T>, w: Complex<T>) -> [Complex<T>; 2] {
    [(w * a.conj()).over(a.square()), ((p - w) * b.conj()).over(b.square())]
}

/// The other solution of three joints that turn: w mirrored at P, P/P̄·w̄.
pub fn rrr_mirrored<T: Scalar>(
    a: Complex<T>,
    b: Complex<T>,
    p: Complex<T>,
    e1: Complex<T>,
) -> [Complex<T>; 2] {
    let w = (p * p * (a * e1).conj()).over(p.square());
    rrr_of(a, b, p, w)
}

/// A turn and a slide along u that does not turn with it, A·e + u·r = P: what the root is taken of.
///
/// Across u: Im(A·e·ū) = Im(P·ū) = s, so that along it Re(A·e·ū) = ±h with h² = |A|²|u|² − s².
pub fn rrp_square<T: Scalar>(a: Complex<T>, u: Complex<T>, p: Complex<T>) -> T {
    let s = (p * u.conj()).im;
    a.square() * u.square() - s * s
}

/// e and r; h is the root of [`rrp_square`] with its sign.
pub fn rrp<T: Scalar>(a: Complex<T>, u: Complex<T>, p: Complex<T>, h: T) -> (Complex<T>, T) {
    let q = p * u.conj();
    let along = Complex::new(h, q.im);
    // A·e = (h + is)·u/|u|²
    let e = (along * u * a.conj()).over(u.square() * a.square());
    (e, (q.re - h) / u.square())
}

/// A slide that turns, (A + u·r)·e = P: what the root is taken of.
///
/// With A·ū = m + io: |u|²·r + m = ±h with h² = |P|²|u|² − o².
pub fn rpr_square<T: Scalar>(a: Complex<T>, u: Complex<T>, p: Complex<T>) -> T {
    let o = (a * u.conj()).im;
    p.square() * u.square() - o * o
}

/// e and r; h is the root of [`rpr_square`] with its sign.
pub fn rpr<T: Scalar>(a: Complex<T>, u: Complex<T>, p: Complex<T>, h: T) -> (Complex<T>, T) {
    let c = a * u.conj();
    let r = (h - c.re) / u.square();
    // (A + u·r)·ū = h + io, of which the square is |P|²|u|²
    let e = (p * u.conj() * Complex::new(h, c.im).conj()).over(p.square() * u.square());
    (e, r)
}

/// Two slides, u·r + v·s = P: r and s, and what they are divided by, Im(ū·v).
pub fn slides<T: Scalar>(u: Complex<T>, v: Complex<T>, p: Complex<T>) -> ([T; 2], T) {
    let determinant = (u.conj() * v).im;
    let r = (p.conj() * v).im / determinant;
    let s = (u.conj() * p).im / determinant;
    ([r, s], determinant)
}
