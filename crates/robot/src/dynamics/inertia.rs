//! The inertia matrix by composite bodies (Walker and Orin 1982).

use super::model::{Dynamics, Wrench};
use super::newton_euler::carried;
use crate::description::JointKind;
use crate::geometry::{Body, Vector};
use crate::scalar::Scalar;

/// A(q): the torques A q̈ accelerate the arm by q̈ from rest, gravity left aside; row by row, symmetric, rotors on its diagonal.
///
/// # Panics
/// If `q` does not have one entry per joint.
pub fn inertia_matrix<T: Scalar>(arm: &Dynamics<T>, q: &[T]) -> Vec<Vec<T>> {
    assert_eq!(q.len(), arm.joints(), "one entry per joint");
    let places: Vec<_> = arm.links.iter().map(|l| l.place(q)).collect();
    let m = arm.links.len();
    let mut of_axes = vec![vec![T::zero(); m]; m];
    let mut bodies: Vec<Body<T>> = arm.links.iter().map(|l| l.body).collect();
    for (k, link) in arm.links.iter().enumerate().rev() {
        let body = bodies[k];
        let mut wrench = of_unit(&body, link.kind);
        let mut next = Some(k);
        while let Some(i) = next {
            of_axes[i][k] = match arm.links[i].kind {
                JointKind::Revolute => wrench[1][2],
                JointKind::Prismatic => wrench[0][2],
            };
            of_axes[k][i] = of_axes[i][k];
            next = arm.links[i].parent;
            if next.is_some() {
                wrench = carried(&places[i], wrench);
            }
        }
        if let Some(parent) = link.parent {
            bodies[parent] = bodies[parent] + body.seen_from(&places[k]);
        }
    }
    // A = Gᵀ A of the axes G + rotors
    let columns: Vec<Vec<T>> = (0..m).map(|i| arm.at_joints(&of_axes[i])).collect();
    let n = arm.joints();
    let mut matrix = vec![vec![T::zero(); n]; n];
    for j in 0..n {
        let column: Vec<T> = columns.iter().map(|c| c[j]).collect();
        for (i, entry) in arm.at_joints(&column).into_iter().enumerate().take(j + 1) {
            matrix[i][j] = entry;
            matrix[j][i] = entry;
        }
        matrix[j][j] = matrix[j][j] + arm.drives[j].rotor;
    }
    matrix
}

/// What gives a body the acceleration 1 about the z of its frame, or along it.
fn of_unit<T: Scalar>(body: &Body<T>, kind: JointKind) -> Wrench<T> {
    let ([.., xz, _, yz, zz], [mx, my, _], o) = (body.inertia, body.first_moment.0, T::zero());
    match kind {
        JointKind::Revolute => [Vector([-my, mx, o]), Vector([xz, yz, zz])],
        JointKind::Prismatic => [Vector([o, o, body.mass]), Vector([my, -mx, o])],
    }
}
