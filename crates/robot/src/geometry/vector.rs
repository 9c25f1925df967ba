//! Vectors in space and the three coordinate axes.

use crate::scalar::Scalar;
use std::fmt;
use std::ops::{Add, Index, Mul, Neg, Sub};

/// A coordinate axis of a frame.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Axis {
    /// The first axis.
    X,
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

impl Axis {
    /// The three axes in order.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

    /// 0, 1 or 2: the row or column that belongs to the axis.
    #[inline]
    pub fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(["x", "y", "z"][self.index()])
    }
}

/// Three coordinates of a point, a displacement or a free vector, in a frame that the context names.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Vector<T>(pub [T; 3]);

/// What is for 0, 1 and 2, in this order. Not by `array::map`, which the compiler may leave as a call.
#[inline(always)]
pub(crate) fn three<U>(mut of: impl FnMut(usize) -> U) -> [U; 3] {
    [of(0), of(1), of(2)]
}

impl<T: Scalar> Vector<T> {
    /// The vector with these coordinates.
    #[inline]
    pub fn new(x: T, y: T, z: T) -> Self {
        Vector([x, y, z])
    }

    /// The vector whose coordinates are 0.
    #[inline]
    pub fn zero() -> Self {
        Vector([T::zero(); 3])
    }

    /// The unit vector along an axis of the frame.
    #[inline]
    pub fn unit(axis: Axis) -> Self {
        Vector(Axis::ALL.map(|a| if a == axis { T::one() } else { T::zero() }))
    }

    /// The inner product a · b.
    #[inline]
    pub fn dot(self, b: Self) -> T {
        self.0[0] * b.0[0] + self.0[1] * b.0[1] + self.0[2] * b.0[2]
    }

    /// The cross product a × b.
    #[inline]
    pub fn cross(self, b: Self) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (self.0, b.0);
        Vector([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
    }

    /// Each coordinate times `k`.
    #[inline]
    pub fn scale(self, k: T) -> Self {
        Vector(three(|i| self.0[i] * k))
    }

    /// The Euclidean length, in the unit of the coordinates.
    pub fn norm(self) -> T {
        self.dot(self).sqrt()
    }

    /// The same coordinates in another scalar type.
    #[inline]
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Vector<U> {
        Vector(self.0.map(f))
    }
}

impl Vector<f64> {
    /// A unit vector across one of length 1: towards the axis that is farthest from it.
    pub fn any_across(self) -> Self {
        let least =
            Axis::ALL.into_iter().min_by(|a, b| self[a.index()].abs().total_cmp(&self[b.index()].abs()));
        let e = Vector::unit(least.unwrap_or(Axis::X));
        let across = e - self.scale(e.dot(self));
        across.scale(1.0 / across.norm())
    }
}

/// # Panics
/// If the index is not below 3.
impl<T> Index<usize> for Vector<T> {
    type Output = T;
    #[inline]
    fn index(&self, i: usize) -> &T {
        &self.0[i]
    }
}

impl<T: Scalar> Add for Vector<T> {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Vector([self.0[0] + b.0[0], self.0[1] + b.0[1], self.0[2] + b.0[2]])
    }
}

impl<T: Scalar> Sub for Vector<T> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Vector([self.0[0] - b.0[0], self.0[1] - b.0[1], self.0[2] - b.0[2]])
    }
}

impl<T: Scalar> Neg for Vector<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Vector(three(|i| -self.0[i]))
    }
}

impl<T: Scalar> Mul<T> for Vector<T> {
    type Output = Self;
    #[inline]
    fn mul(self, k: T) -> Self {
        self.scale(k)
    }
}
