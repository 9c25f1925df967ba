//! The momentum of an arm: of its mass, and about its centre of mass.

use super::model::{Dynamics, Moved};
use crate::geometry::Vector;

/// Mass, centre of mass and momentum, along the axes of the base; rotors aside.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Momentum {
    /// All mass that moves, kg.
    pub mass: f64,
    /// Its centre in the base, metres; the origin without mass.
    pub centre: Vector<f64>,
    /// Kilogram metres a second.
    pub linear: Vector<f64>,
    /// About the centre of mass, kilogram square metres a second.
    pub angular: Vector<f64>,
}

/// The momentum in the state `(q, qd)`.
///
/// # Panics
/// If `q` or `qd` does not have one entry per joint.
pub fn momentum(arm: &Dynamics<f64>, q: &[f64], qd: &[f64]) -> Momentum {
    assert_eq!([q.len(), qd.len()], [arm.joints(); 2], "one entry per joint");
    let moving = arm.velocities(q, qd);
    let frames = arm.frames(moving.iter().map(|m| m.place));
    let (mut mass, mut moment) = (0.0, Vector::zero());
    let (mut linear, mut about_base) = (Vector::zero(), Vector::zero());
    for ((link, x), Moved { turning, velocity, .. }) in arm.links.iter().zip(frames).zip(moving) {
        // P = M V + ω × MS, and J ω + MS × V about the origin of the frame.
        let body = &link.body;
        let own = x.rotation * (velocity.scale(body.mass) + turning.cross(body.first_moment));
        let spin = x.rotation * (body.tensor() * turning + body.first_moment.cross(velocity));
        linear = linear + own;
        about_base = about_base + spin + x.translation.cross(own);
        mass += body.mass;
        moment = moment + x.translation.scale(body.mass) + x.rotation * body.first_moment;
    }
    let centre = if mass == 0.0 { Vector::zero() } else { moment.scale(1.0 / mass) };
    Momentum { mass, centre, linear, angular: about_base - centre.cross(linear) }
}
