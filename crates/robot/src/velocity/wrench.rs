//! Forces: what the joints must hold, and what they can.

use super::geometric::Jacobian;

/// A wrench has the rows of a twist: the force in newtons, then the moment about the point in newton metres.
pub type Wrench = [f64; 6];

/// The torques (newton metres; newtons for joints that slide) with which the joints hold a wrench that the body exerts
/// on what it touches: τ = Jᵀ w (the principle of virtual work), gravity and friction aside.
pub fn torques(jacobian: &Jacobian<f64>, wrench: &Wrench) -> Vec<f64> {
    jacobian.columns.iter().map(|c| c.iter().zip(wrench).map(|(a, b)| a * b).sum()).collect()
}

/// How far a wrench may be multiplied before a joint reaches its largest torque, and which joint that is; `None` if no
/// joint holds any of it: the structure does.
///
/// All wrenches that the limits allow are those with |Jᵀ w| ≤ limits, joint by joint.
pub fn largest_wrench(jacobian: &Jacobian<f64>, limits: &[f64], wrench: &Wrench) -> Option<(f64, usize)> {
    let torques = torques(jacobian, wrench);
    let size = torques.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
    let held = torques.iter().zip(limits).enumerate().filter(|(_, (t, _))| t.abs() > 1e-12 * size);
    held.map(|(j, (t, limit))| (limit / t.abs(), j)).min_by(|a, b| a.0.total_cmp(&b.0))
}
