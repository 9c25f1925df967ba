//! Inverse dynamics: the recursion of Newton and Euler (Luh, Walker and Paul 1980; Khalil and Dombre, *Modeling, Identification
//! and Control of Robots*, ch. 9), with first moments and inertias about the origins of the links' frames.
//!
//! Quantities of link k are expressed in frame k. A point fixed to the link at r accelerates with V̇ + U r, where
//! U = ω̇^ + ω^ω^.

use super::model::{Dynamics, Wrench};
use crate::description::JointKind;
use crate::geometry::{Axis, Body, Rotation, Transform, Vector};
use crate::scalar::Scalar;
use denavit_program::Domain as _;

/// How a link moves.
#[derive(Clone, Debug)]
pub(super) struct Motion<T> {
    /// Its frame in that of the link before.
    pub place: Transform<T>,
    /// ω, radians a second.
    pub turning: Vector<T>,
    /// ω̇
    pub turning_rate: Vector<T>,
    /// U
    pub spread: Rotation<T>,
    /// V̇, the acceleration of its origin less that of gravity.
    pub acceleration: Vector<T>,
}

/// The joint torques with which the arm accelerates by `qdd` in the state `(q, qd)`, under gravity, with its rotors and viscous
/// friction, and with a wrench that the tool exerts. Coulomb's friction is apart ([`friction`]): its sign is no formula.
///
/// # Panics
/// If `q`, `qd` or `qdd` does not have one entry per joint.
pub fn inverse_dynamics<T: Scalar>(
    arm: &Dynamics<T>,
    q: &[T],
    qd: &[T],
    qdd: &[T],
    wrench: Option<&Wrench<T>>,
) -> Vec<T> {
    let motions = motions(arm, q, qd, qdd, -arm.gravity);
    let mut wrenches: Vec<Wrench<T>> =
        arm.links.iter().zip(&motions).map(|(l, m)| of_body(&l.body, m)).collect();
    if let (Some(of_tool), Some(last)) = (wrench, wrenches.last_mut()) {
        let frames = arm.frames(motions.iter().map(|m| m.place));
        let x_0n = frames.last().map_or_else(Rotation::identity, |x| x.rotation);
        let [force, moment] = of_tool.map(|v| x_0n.inverse() * v);
        *last = [last[0] + force, last[1] + moment + arm.tool.translation.cross(force)];
    }
    let mut torques = arm.at_joints(&backward(arm, &motions, &wrenches));
    for (j, (torque, drive)) in torques.iter_mut().zip(&arm.drives).enumerate() {
        *torque = *torque + drive.torque(qd[j], qdd[j]);
    }
    torques
}

/// The torques of gravity: Q(q), what holds the arm at rest.
///
/// # Panics
/// If `q` does not have one entry per joint.
pub fn gravity_torques<T: Scalar>(arm: &Dynamics<T>, q: &[T]) -> Vec<T> {
    let still = vec![T::zero(); arm.joints()];
    inverse_dynamics(arm, q, &still, &still, None)
}

/// The centrifugal and Coriolis torques: C(q, q̇) q̇.
///
/// # Panics
/// If `q` or `qd` does not have one entry per joint.
pub fn velocity_torques<T: Scalar>(arm: &Dynamics<T>, q: &[T], qd: &[T]) -> Vec<T> {
    let still = vec![T::zero(); arm.joints()];
    let motions = motions(arm, q, qd, &still, Vector::zero());
    let wrenches: Vec<Wrench<T>> = arm.links.iter().zip(&motions).map(|(l, m)| of_body(&l.body, m)).collect();
    arm.at_joints(&backward(arm, &motions, &wrenches))
}

/// The torques of friction: FV q̇ + FS sign q̇. At rest Coulomb's friction is whatever holds the joint, and 0 here.
///
/// # Panics
/// If `qd` does not have one entry per joint.
pub fn friction(arm: &Dynamics<f64>, qd: &[f64]) -> Vec<f64> {
    assert_eq!(qd.len(), arm.joints(), "one entry per joint");
    arm.drives.iter().zip(qd).map(|(d, &v)| d.viscous * v + d.coulomb * v.sign()).collect()
}

/// The torques of the drives: [`inverse_dynamics`] with Coulomb's friction.
///
/// # Panics
/// If `q`, `qd` or `qdd` does not have one entry per joint.
pub fn drive_torques(
    arm: &Dynamics<f64>,
    q: &[f64],
    qd: &[f64],
    qdd: &[f64],
    wrench: Option<&Wrench<f64>>,
) -> Vec<f64> {
    let torques = inverse_dynamics(arm, q, qd, qdd, wrench);
    let rubbed = torques.into_iter().zip(friction(arm, qd)).zip(arm.drives.iter().zip(qd));
    // The viscous part is in the torques already.
    rubbed.map(|((torque, rubbed), (drive, &v))| torque + rubbed - drive.viscous * v).collect()
}

/// How the links move; the base accelerates by `base`.
pub(super) fn motions<T: Scalar>(
    arm: &Dynamics<T>,
    q: &[T],
    qd: &[T],
    qdd: &[T],
    base: Vector<T>,
) -> Vec<Motion<T>> {
    assert_eq!([q.len(), qd.len(), qdd.len()], [arm.joints(); 3], "one entry per joint");
    let (rates, changes) = (arm.rates(qd), arm.rates(qdd));
    let mut all: Vec<Motion<T>> = vec![];
    for (link, (&rate, &change)) in arm.links.iter().zip(rates.iter().zip(&changes)) {
        let place = link.place(q);
        let carried = carried_on(link.kind, &place, link.parent.map(|k| &all[k]), (rate, change), base);
        let [turning, turning_rate, acceleration] = carried;
        let spread = spread(turning, turning_rate);
        all.push(Motion { place, turning, turning_rate, spread, acceleration });
    }
    all
}

/// ω, ω̇ and V̇ of a link from those of the link before, in their own frames, at a rate and an acceleration of its axis; `base` is the
/// acceleration of the first origin.
pub(super) fn carried_on<T: Scalar>(
    kind: JointKind,
    place: &Transform<T>,
    before: Option<&Motion<T>>,
    (rate, change): (T, T),
    base: Vector<T>,
) -> [Vector<T>; 3] {
    let z = Vector::unit(Axis::Z);
    let back = place.rotation.inverse();
    let (turning, turning_rate, origin) = match before {
        None => (Vector::zero(), Vector::zero(), base),
        // V̇ₚ + Uₚ p
        Some(p) => (back * p.turning, back * p.turning_rate, p.acceleration + p.spread * place.translation),
    };
    let acceleration = back * origin;
    let across = turning.cross(z.scale(rate));
    match kind {
        // ω = ωₚ + z q̇,   ω̇ = ω̇ₚ + z q̈ + ωₚ × z q̇
        JointKind::Revolute => {
            [turning + z.scale(rate), turning_rate + z.scale(change) + across, acceleration]
        }
        // V̇ += z q̈ + 2 ω × z q̇
        JointKind::Prismatic => [turning, turning_rate, acceleration + z.scale(change) + across + across],
    }
}

/// U = ω̇^ + ω^ω^
pub(super) fn spread<T: Scalar>(Vector([x, y, z]): Vector<T>, Vector([a, b, c]): Vector<T>) -> Rotation<T> {
    let (xx, yy, zz) = (x * x, y * y, z * z);
    let (xy, xz, yz) = (x * y, x * z, y * z);
    Rotation::from_rows([
        [-(yy + zz), xy - c, xz + b],
        [xy + c, -(xx + zz), yz - a],
        [xz - b, yz + a, -(xx + yy)],
    ])
}

/// The force and the moment about the origin of its frame that move a body so.
pub(super) fn of_body<T: Scalar>(body: &Body<T>, m: &Motion<T>) -> Wrench<T> {
    let ms = body.first_moment;
    // F = M V̇ + U·MS
    let force = m.acceleration.scale(body.mass) + m.spread * ms;
    [force, moment(&body.inertia, ms, m)]
}

/// N = J ω̇ + ω × J ω + MS × V̇
pub(super) fn moment<T: Scalar>(inertia: &[T; 6], ms: Vector<T>, m: &Motion<T>) -> Vector<T> {
    let ([xx, xy, xz, yy, yz, zz], u) = (*inertia, m.spread.rows());
    let (Vector([x, y, z]), Vector([a, b, c])) = (m.turning, m.turning_rate);
    let spin = Vector([
        xx * a + (zz - yy) * (y * z) - yz * (u[2][2] - u[1][1]) - xy * u[2][0] + xz * u[1][0],
        yy * b + (xx - zz) * (x * z) - xz * (u[0][0] - u[2][2]) - yz * u[0][1] + xy * u[2][1],
        zz * c + (yy - xx) * (x * y) - xy * (u[1][1] - u[0][0]) - xz * u[1][2] + yz * u[0][2],
    ]);
    spin + ms.cross(m.acceleration)
}

/// The torques at the axes for what acts on each link, in its frame.
pub(super) fn backward<T: Scalar>(
    arm: &Dynamics<T>,
    motions: &[Motion<T>],
    wrenches: &[Wrench<T>],
) -> Vec<T> {
    let mut torques = vec![T::zero(); arm.links.len()];
    let mut all = wrenches.to_vec();
    for (k, link) in arm.links.iter().enumerate().rev() {
        let [force, moment] = all[k];
        torques[k] = match link.kind {
            JointKind::Revolute => moment[2],
            JointKind::Prismatic => force[2],
        };
        if let Some(parent) = link.parent {
            let behind = carried(&motions[k].place, [force, moment]);
            all[parent] = [all[parent][0] + behind[0], all[parent][1] + behind[1]];
        }
    }
    torques
}

/// A wrench about the origin of a frame about that of the frame in which it stands.
pub(super) fn carried<T: Scalar>(x: &Transform<T>, [force, moment]: Wrench<T>) -> Wrench<T> {
    let force = x.rotation * force;
    [force, x.rotation * moment + x.translation.cross(force)]
}
