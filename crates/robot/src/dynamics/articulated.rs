//! Direct dynamics by articulated bodies (Featherstone 2008, ch. 7): no matrix of the whole arm.
//!
//! Spatial vectors of link k are in frame k, angular part first.

use super::direct::{ROUNDING, Singular};
use super::model::Dynamics;
use super::newton_euler::friction;
use crate::description::JointKind;
use crate::geometry::{Body, Transform, Vector};

type Six = [f64; 6];
type Matrix = [Six; 6];

/// The joint accelerations under torques `tau` in the state `(q, qd)`; `None` for an arm some joint of which moves several axes, or
/// some axis of which several joints move.
///
/// # Errors
/// If a joint moves nothing that has mass.
///
/// # Panics
/// If `q`, `qd` or `tau` does not have one entry per joint.
pub fn articulated_bodies(
    arm: &Dynamics<f64>,
    q: &[f64],
    qd: &[f64],
    tau: &[f64],
) -> Option<Result<Vec<f64>, Singular>> {
    let n = arm.joints();
    assert_eq!([q.len(), qd.len(), tau.len()], [n; 3], "one entry per joint");
    // Joint and factor of each axis.
    let mut of_axis: Vec<(usize, f64)> = vec![];
    for link in &arm.links {
        let &[(joint, factor)] = &link.value.terms[..] else { return None };
        if of_axis.iter().any(|a| a.0 == joint) {
            return None;
        }
        of_axis.push((joint, factor));
    }
    let (m, friction) = (arm.links.len(), friction(arm, qd));
    let places: Vec<Transform<f64>> = arm.links.iter().map(|l| l.place(q)).collect();
    let axis = |k: usize| if arm.links[k].kind == JointKind::Revolute { 2 } else { 5 };
    let (mut inertia, mut bias, mut drift) = (vec![], vec![], vec![]);
    let mut velocities: Vec<Six> = vec![];
    for (k, link) in arm.links.iter().enumerate() {
        let mut own: Six = [0.0; 6];
        own[axis(k)] = of_axis[k].1 * qd[of_axis[k].0];
        let carried = moved(&places[k], &link.parent.map_or([0.0; 6], |p| velocities[p]));
        let velocity: Six = std::array::from_fn(|i| carried[i] + own[i]);
        let spatial = spatial(&link.body);
        // p = v ×* I v,   c = v × S q̇
        bias.push(cross_force(&velocity, &times(&spatial, &velocity)));
        drift.push(cross_motion(&velocity, &own));
        inertia.push(spatial);
        velocities.push(velocity);
    }
    let mut pivots = vec![0.0; m];
    let mut rests = vec![0.0; m];
    for k in (0..m).rev() {
        let (joint, factor) = of_axis[k];
        let s = axis(k);
        let column: Six = std::array::from_fn(|i| inertia[k][i][s]);
        let own = inertia[k][s][s];
        let pivot = own + arm.drives[joint].rotor / (factor * factor);
        if pivot.is_nan() || pivot <= ROUNDING * spatial(&arm.links[k].body)[s][s].abs() {
            return Some(Err(Singular { joint }));
        }
        let rest = (tau[joint] - friction[joint]) / factor - bias[k][s];
        (pivots[k], rests[k]) = (pivot, rest);
        if let Some(parent) = arm.links[k].parent {
            let mut articulated = inertia[k];
            for (row, &a) in articulated.iter_mut().zip(&column) {
                for (entry, &b) in row.iter_mut().zip(&column) {
                    *entry -= a * b / pivot;
                }
            }
            let pushed = times(&articulated, &drift[k]);
            let push: Six = std::array::from_fn(|i| bias[k][i] + pushed[i] + column[i] * rest / pivot);
            let (back, force) = (carried_inertia(&places[k], &articulated), carried(&places[k], &push));
            for i in 0..6 {
                bias[parent][i] += force[i];
                for j in 0..6 {
                    inertia[parent][i][j] += back[i][j];
                }
            }
        }
    }
    let g = arm.gravity;
    let base: Six = [0.0, 0.0, 0.0, -g[0], -g[1], -g[2]];
    let mut accelerations: Vec<Six> = vec![];
    let mut qdd = vec![0.0; n];
    for k in 0..m {
        let before = moved(&places[k], &arm.links[k].parent.map_or(base, |p| accelerations[p]));
        let mut acceleration: Six = std::array::from_fn(|i| before[i] + drift[k][i]);
        let s = axis(k);
        let pulled: f64 = (0..6).map(|i| inertia[k][i][s] * acceleration[i]).sum();
        let rate = (rests[k] - pulled) / pivots[k];
        acceleration[s] += rate;
        accelerations.push(acceleration);
        qdd[of_axis[k].0] = rate / of_axis[k].1;
    }
    Some(Ok(qdd))
}

fn parts(v: &Six) -> [Vector<f64>; 2] {
    [Vector([v[0], v[1], v[2]]), Vector([v[3], v[4], v[5]])]
}

fn joined([Vector([a, b, c]), Vector([x, y, z])]: [Vector<f64>; 2]) -> Six {
    [a, b, c, x, y, z]
}

/// A motion given about the origin of the frame before, about the own one.
fn moved(x: &Transform<f64>, v: &Six) -> Six {
    let ([turn, shift], back) = (parts(v), x.rotation.inverse());
    joined([back * turn, back * (shift + turn.cross(x.translation))])
}

/// A moment and a force given about the own origin, about that of the frame before.
fn carried(x: &Transform<f64>, f: &Six) -> Six {
    let [moment, force] = parts(f);
    let force = x.rotation * force;
    joined([x.rotation * moment + x.translation.cross(force), force])
}

/// X* I X⁻¹, column by column.
fn carried_inertia(x: &Transform<f64>, inertia: &Matrix) -> Matrix {
    let mut m = [[0.0; 6]; 6];
    for c in 0..6 {
        let mut unit = [0.0; 6];
        unit[c] = 1.0;
        let column = carried(x, &times(inertia, &moved(x, &unit)));
        (0..6).for_each(|r| m[r][c] = column[r]);
    }
    m
}

fn times(m: &Matrix, v: &Six) -> Six {
    std::array::from_fn(|r| (0..6).map(|c| m[r][c] * v[c]).sum())
}

fn cross_motion(v: &Six, w: &Six) -> Six {
    let ([a, b], [c, d]) = (parts(v), parts(w));
    joined([a.cross(c), a.cross(d) + b.cross(c)])
}

fn cross_force(v: &Six, f: &Six) -> Six {
    let ([turn, shift], [moment, force]) = (parts(v), parts(f));
    joined([turn.cross(moment) + shift.cross(force), turn.cross(force)])
}

/// [J MS^; −MS^ M]
fn spatial(body: &Body<f64>) -> Matrix {
    let (j, Vector([x, y, z]), m) = (body.tensor().rows(), body.first_moment, body.mass);
    [
        [j[0][0], j[0][1], j[0][2], 0.0, -z, y],
        [j[1][0], j[1][1], j[1][2], z, 0.0, -x],
        [j[2][0], j[2][1], j[2][2], -y, x, 0.0],
        [0.0, z, -y, m, 0.0, 0.0],
        [-z, 0.0, x, 0.0, m, 0.0],
        [y, -x, 0.0, 0.0, 0.0, m],
    ]
}
