//! Intervals of doubles that hold every value which rounding could hide, and rectangles of the complex plane made of two.

use crate::complex::Complex;
use std::ops::{Add, Mul, Neg, Sub};

/// All numbers from `lo` to `hi`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// The least.
    pub lo: f64,
    /// The greatest.
    pub hi: f64,
}

impl Interval {
    /// 0.
    pub const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };

    /// A number alone.
    pub const fn point(x: f64) -> Self {
        Interval { lo: x, hi: x }
    }

    /// All numbers at most `radius` away from `x`.
    pub fn around(x: f64, radius: f64) -> Self {
        Interval { lo: (x - radius).next_down(), hi: (x + radius).next_up() }
    }

    /// True unless every number of it has the same sign.
    pub fn holds_zero(self) -> bool {
        // Written so that an interval that is no number holds everything.
        !(self.lo > 0.0 || self.hi < 0.0)
    }

    /// True if it lies in the inside of another.
    pub fn is_inside(self, other: Self) -> bool {
        self.lo > other.lo && self.hi < other.hi
    }

    /// True if no number is in both.
    pub fn is_apart_from(self, other: Self) -> bool {
        self.hi < other.lo || other.hi < self.lo
    }

    /// The greatest distance from 0.
    pub fn size(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// x².
    pub fn squared(self) -> Self {
        let (a, b) = (self.lo * self.lo, self.hi * self.hi);
        let lo = if self.holds_zero() { 0.0 } else { a.min(b).next_down().max(0.0) };
        Interval { lo, hi: a.max(b).next_up() }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Interval { lo: (self.lo + b.lo).next_down(), hi: (self.hi + b.hi).next_up() }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Interval { lo: (self.lo - b.hi).next_down(), hi: (self.hi - b.lo).next_up() }
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let ends = [self.lo * b.lo, self.lo * b.hi, self.hi * b.lo, self.hi * b.hi];
        if ends.iter().any(|e| e.is_nan()) {
            return Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
        }
        let lo = ends[0].min(ends[1]).min(ends[2].min(ends[3]));
        let hi = ends[0].max(ends[1]).max(ends[2].max(ends[3]));
        Interval { lo: lo.next_down(), hi: hi.next_up() }
    }
}

/// A rectangle of the complex plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rectangle {
    /// The real parts.
    pub re: Interval,
    /// The imaginary parts.
    pub im: Interval,
}

impl Rectangle {
    /// 0.
    pub const ZERO: Rectangle = Rectangle { re: Interval::ZERO, im: Interval::ZERO };

    /// A real interval.
    pub const fn real(re: Interval) -> Self {
        Rectangle { re, im: Interval::ZERO }
    }

    /// A number alone.
    pub const fn point(z: Complex) -> Self {
        Rectangle { re: Interval::point(z.re), im: Interval::point(z.im) }
    }

    /// The square around a number.
    pub fn around(z: Complex, radius: f64) -> Self {
        Rectangle { re: Interval::around(z.re, radius), im: Interval::around(z.im, radius) }
    }

    /// True unless 0 is certainly not in it.
    pub fn holds_zero(self) -> bool {
        self.re.holds_zero() && self.im.holds_zero()
    }

    /// True if it lies in the inside of another.
    pub fn is_inside(self, other: Self) -> bool {
        self.re.is_inside(other.re) && self.im.is_inside(other.im)
    }

    /// True if no number is in both.
    pub fn is_apart_from(self, other: Self) -> bool {
        self.re.is_apart_from(other.re) || self.im.is_apart_from(other.im)
    }
}

impl Add for Rectangle {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Rectangle { re: self.re + b.re, im: self.im + b.im }
    }
}

impl Sub for Rectangle {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Rectangle { re: self.re - b.re, im: self.im - b.im }
    }
}

impl Mul for Rectangle {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Rectangle { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}

impl Mul<Rectangle> for Interval {
    type Output = Rectangle;
    fn mul(self, b: Rectangle) -> Rectangle {
        Rectangle { re: self * b.re, im: self * b.im }
    }
}
