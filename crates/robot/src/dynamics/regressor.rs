//! The torques as a linear function of the masses: τ = Wχ (Atkeson, An and Hollerbach 1986).

use super::model::Dynamics;
use super::newton_euler::{backward, motions, of_body};
use crate::geometry::{Body, PARAMETERS, Vector};
use crate::scalar::Scalar;

/// W, row by row, one row a joint: ten columns a link, in the order of [`PARAMETERS`], then one a drive for its rotor and one for
/// its viscous friction.
///
/// # Panics
/// If `q`, `qd` or `qdd` does not have one entry per joint.
pub fn regressor<T: Scalar>(arm: &Dynamics<T>, q: &[T], qd: &[T], qdd: &[T]) -> Vec<Vec<T>> {
    let motions = motions(arm, q, qd, qdd, -arm.gravity);
    let (m, n) = (arm.links.len(), arm.joints());
    let mut rows = vec![vec![]; n];
    for k in 0..m {
        for p in 0..PARAMETERS.len() {
            let mut one = [T::zero(); 10];
            one[p] = T::one();
            let mut wrenches = vec![[Vector::zero(); 2]; m];
            wrenches[k] = of_body(&Body::of(one), &motions[k]);
            let column = arm.at_joints(&backward(arm, &motions, &wrenches));
            rows.iter_mut().zip(column).for_each(|(row, entry)| row.push(entry));
        }
    }
    for (j, row) in rows.iter_mut().enumerate() {
        for rates in [qdd, qd] {
            row.extend((0..n).map(|i| if i == j { rates[j] } else { T::zero() }));
        }
    }
    rows
}
