//! Direct dynamics by the factored inertia matrix.

use super::inertia::inertia_matrix;
use super::model::{Dynamics, Wrench};
use super::newton_euler::drive_torques;
use crate::scalar::Scalar;
use std::fmt;

/// A = LDLᵀ, without roots.
#[derive(Clone, Debug)]
pub struct Factored<T> {
    /// L below its diagonal, row by row; 1 on it.
    pub lower: Vec<Vec<T>>,
    /// D.
    pub diagonal: Vec<T>,
}

/// An inertia matrix that is singular: this joint moves nothing that has mass.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Singular {
    /// The joint, from 0.
    pub joint: usize,
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "joint {} moves no mass of its own", self.joint + 1)
    }
}

impl std::error::Error for Singular {}

/// The factors of a symmetric matrix.
pub fn factored<T: Scalar>(matrix: &[Vec<T>]) -> Factored<T> {
    let n = matrix.len();
    let (mut lower, mut diagonal) = (vec![vec![T::zero(); n]; n], vec![T::zero(); n]);
    for j in 0..n {
        let mut pivot = matrix[j][j];
        for k in 0..j {
            pivot = pivot - lower[j][k] * lower[j][k] * diagonal[k];
        }
        diagonal[j] = pivot;
        for i in j + 1..n {
            let mut entry = matrix[i][j];
            for k in 0..j {
                entry = entry - lower[i][k] * (lower[j][k] * diagonal[k]);
            }
            lower[i][j] = entry / pivot;
        }
    }
    Factored { lower, diagonal }
}

impl<T: Scalar> Factored<T> {
    /// The solution x of A x = b.
    ///
    /// # Panics
    /// If `b` has another length.
    pub fn solve(&self, b: &[T]) -> Vec<T> {
        let n = self.diagonal.len();
        assert_eq!(b.len(), n, "one entry a row");
        let mut x = b.to_vec();
        for i in 0..n {
            for k in 0..i {
                x[i] = x[i] - self.lower[i][k] * x[k];
            }
        }
        for (entry, &d) in x.iter_mut().zip(&self.diagonal) {
            *entry = *entry / d;
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] = x[i] - self.lower[k][i] * x[k];
            }
        }
        x
    }
}

impl Factored<f64> {
    /// The first row, from 0, whose pivot is rounding beside the diagonal entry of the matrix.
    pub fn lost(&self, matrix: &[Vec<f64>]) -> Option<usize> {
        let is_lost = |&j: &usize| self.diagonal[j].is_nan() || self.diagonal[j] <= ROUNDING * matrix[j][j];
        (0..self.diagonal.len()).find(is_lost)
    }
}

/// Pivots below this part of a diagonal entry are rounding.
pub(super) const ROUNDING: f64 = 1e-13;

/// The joint accelerations under torques `tau` in the state `(q, qd)`, with a wrench that the tool exerts: A⁻¹(τ − C q̇ − Q −
/// friction − Jᵀ w).
///
/// # Errors
/// If the inertia matrix is singular.
///
/// # Panics
/// If `q`, `qd` or `tau` does not have one entry per joint.
pub fn direct_dynamics(
    arm: &Dynamics<f64>,
    q: &[f64],
    qd: &[f64],
    tau: &[f64],
    wrench: Option<&Wrench<f64>>,
) -> Result<Vec<f64>, Singular> {
    let n = arm.joints();
    assert_eq!(tau.len(), n, "one entry per joint");
    let matrix = inertia_matrix(arm, q);
    let factors = factored(&matrix);
    if let Some(joint) = factors.lost(&matrix) {
        return Err(Singular { joint });
    }
    let coasting = drive_torques(arm, q, qd, &vec![0.0; n], wrench);
    let rest: Vec<f64> = tau.iter().zip(coasting).map(|(t, c)| t - c).collect();
    Ok(factors.solve(&rest))
}
