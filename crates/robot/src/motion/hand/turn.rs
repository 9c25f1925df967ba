//! Rotations as vectors along the axis, as long as the angle.

use crate::geometry::orientation::{OrientationSet, extract, rotation};
use crate::geometry::{Rotation, Vector};

/// The rotation vector, its length in [0, π].
pub fn vector(r: &Rotation<f64>) -> Vector<f64> {
    let values = extract(r, OrientationSet::AxisAngle).values;
    Vector([values[0], values[1], values[2]]).scale(values[3])
}

/// The rotation about a vector by its length.
pub fn about(v: Vector<f64>) -> Rotation<f64> {
    let angle = v.norm();
    if angle < 1e-300 {
        return Rotation::identity();
    }
    let axis = v.scale(1.0 / angle);
    rotation(OrientationSet::AxisAngle, &[axis[0], axis[1], axis[2], angle]).unwrap_or(Rotation::identity())
}

/// The way from a to b by the shorter turn, at s in [0, 1] (SLERP: Shoemake 1985).
pub fn between(a: &Rotation<f64>, b: &Rotation<f64>, s: f64) -> Rotation<f64> {
    *a * about(vector(&(a.inverse() * *b)).scale(s))
}
