//! The scaled Jacobian of the hand and its singular values.
//!
//! Rows: the rotation (radians) and the displacement by a length, in the base; those that a goal does not give are 0.
//! Columns: the joints, slides by the same length, so that all entries are without dimension.

use crate::geometry::Transform;
use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::inverse::numeric::{add_product, solve6};
use crate::mechanism::Robot;
use crate::velocity::{Svd, dot, svd};

/// What a configuration is measured with.
#[derive(Clone, Copy, Debug)]
pub(in crate::inverse) struct Frame<'a> {
    pub robot: &'a Robot<f64>,
    pub goal: Goal,
    /// Whether a joint turns.
    pub is_angle: &'a [bool],
    /// What lengths are divided by, metres.
    pub size: f64,
}

impl Frame<'_> {
    /// A unit of a joint: a radian, or the length.
    pub fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.size }
    }

    /// One column a joint.
    pub fn jacobian(&self, q: &[f64]) -> Vec<[f64; 6]> {
        newton::jacobian(self.robot, self.goal, q, &[], self.size)
    }

    /// The singular values at a configuration.
    pub fn singular(&self, q: &[f64]) -> Svd {
        svd(self.jacobian(q))
    }

    /// The least change of the joints, in their units, that takes an error away to first order, of the first `rank` singular
    /// directions.
    pub fn step(&self, q: &[f64], error: &[f64; 6], rank: usize) -> Vec<f64> {
        if rank < 6 {
            return self.singular(q).solve(error, rank);
        }
        // Jᵀ(J Jᵀ)⁻¹e: what is missed by an arm near a singularity is left to the next step.
        let columns = self.jacobian(q);
        let mut square = [[0.0; 6]; 6];
        columns.iter().for_each(|c| add_product(&mut square, c));
        let x = solve6(&mut square, error);
        columns.iter().map(|c| dot(c, &x)).collect()
    }

    /// The error of a pose as rotation vector and displacement by the length, both in the base.
    pub fn error(&self, wanted: &Transform<f64>, q: &[f64]) -> [f64; 6] {
        newton::error(self.goal, wanted, &self.robot.pose(q), self.size)
    }
}
