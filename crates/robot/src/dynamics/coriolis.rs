//! The matrix C of the velocity torques, with Christoffel's symbols.

use super::model::Dynamics;
use super::newton_euler::velocity_torques;

/// C(q, q̇), row by row: C q̇ are the velocity torques and Ȧ − 2C is skew.
///
/// The velocity torques are a quadratic form in q̇; C q̇ᵣ is its symmetric bilinear form B(q̇, q̇ᵣ), which is
/// (h(q̇ + q̇ᵣ) − h(q̇ − q̇ᵣ))/4. This is the matrix of Christoffel's symbols.
///
/// # Panics
/// If `q` or `qd` does not have one entry per joint.
pub fn coriolis_matrix(arm: &Dynamics<f64>, q: &[f64], qd: &[f64]) -> Vec<Vec<f64>> {
    let n = arm.joints();
    // Of the size of q̇, so that neither part is lost beside the other.
    let size = qd.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let step = if size > 0.0 { size } else { 1.0 };
    let mut matrix = vec![vec![0.0; n]; n];
    for j in 0..n {
        let beside = |by: f64| {
            let mut moved = qd.to_vec();
            moved[j] += by;
            velocity_torques(arm, q, &moved)
        };
        let (more, less) = (beside(step), beside(-step));
        for (row, (a, b)) in matrix.iter_mut().zip(more.iter().zip(&less)) {
            row[j] = (a - b) / (4.0 * step);
        }
    }
    matrix
}
