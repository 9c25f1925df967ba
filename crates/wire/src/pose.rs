//! Poses and orientations.

use denavit::geometry::{Transform, orientation};
use serde::Serialize;

/// A pose, 4×4 by rows, metres.
pub type Matrix = [[f64; 4]; 4];

/// A pose whose zeros have no sign.
pub fn matrix(pose: &Transform<f64>) -> Matrix {
    pose.matrix().map(|row| row.map(|x| x + 0.0))
}

/// A pose from its sixteen entries by rows; a zero has no sign.
///
/// # Panics
/// If there are fewer.
pub fn matrix_of(entries: &[f64]) -> Matrix {
    std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c] + 0.0))
}

/// Several of them, one behind the other.
pub fn matrices(entries: &[f64]) -> Vec<Matrix> {
    entries.chunks_exact(16).map(matrix_of).collect()
}

/// An orientation as values.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Orientation {
    /// How it is written: `rpy`, `zyz`, `quaternion`.
    pub set: String,
    /// Whether other values, far from these, stand for the same orientation.
    pub singular: bool,
    /// As many as the set has names, radians.
    pub values: Vec<f64>,
}

impl From<orientation::Orientation> for Orientation {
    fn from(found: orientation::Orientation) -> Self {
        Orientation { set: found.set.to_string(), singular: found.singular, values: found.values }
    }
}
