//! Kinetic and potential energy.

use super::model::{Dynamics, Moved};
use crate::geometry::Vector;
use crate::scalar::Scalar;

/// The kinetic energy, joules, with that of the rotors as the joints feel them.
///
/// # Panics
/// If `q` or `qd` does not have one entry per joint.
pub fn kinetic_energy<T: Scalar>(arm: &Dynamics<T>, q: &[T], qd: &[T]) -> T {
    assert_eq!([q.len(), qd.len()], [arm.joints(); 2], "one entry per joint");
    let half = T::one() / T::int(2);
    let mut twice = T::zero();
    for (link, Moved { turning, velocity, .. }) in arm.links.iter().zip(arm.velocities(q, qd)) {
        // 2T = ωᵀJω + 2 MS·(V × ω) + M V²
        let (body, crossed) = (&link.body, link.body.first_moment.dot(velocity.cross(turning)));
        let spin = turning.dot(body.tensor() * turning);
        twice = twice + spin + (crossed + crossed) + body.mass * velocity.dot(velocity);
    }
    for (drive, &rate) in arm.drives.iter().zip(qd) {
        twice = twice + drive.rotor * (rate * rate);
    }
    twice * half
}

/// The potential energy in the field of gravity, joules; 0 with all mass at the origin of the base.
///
/// # Panics
/// If `q` does not have one entry per joint.
pub fn potential_energy<T: Scalar>(arm: &Dynamics<T>, q: &[T]) -> T {
    assert_eq!(q.len(), arm.joints(), "one entry per joint");
    let mut moment = Vector::zero();
    for (link, x) in arm.links.iter().zip(arm.frames(arm.links.iter().map(|l| l.place(q)))) {
        moment = moment + x.translation.scale(link.body.mass) + x.rotation * link.body.first_moment;
    }
    -arm.gravity.dot(moment)
}
