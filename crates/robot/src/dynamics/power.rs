//! What holds a wrench that the arm exerts, and where power goes.

use super::model::{Dynamics, Wrench};
use super::newton_euler::{friction, gravity_torques};
use crate::description::JointKind;
use crate::geometry::Vector;
use crate::mechanism::Robot;
use crate::velocity::{Viewpoint, geometric};

/// Work by time, watts: what the torques supply goes into friction, the surroundings of the tool and the energies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Power {
    /// What the torques supply.
    pub supplied: f64,
    /// What friction takes.
    pub dissipated: f64,
    /// What a wrench gives to the surroundings.
    pub exerted: f64,
    /// By which the potential energy grows.
    pub potential: f64,
    /// By which the kinetic energy grows.
    pub kinetic: f64,
}

/// The torques that hold a wrench, force and moment along the axes of the viewpoint, which the body exerts at its point: Jᵀ w.
///
/// # Panics
/// If `q` does not have one entry per joint, or the robot has no such frame.
pub fn holding_torques(robot: &Robot<f64>, q: &[f64], view: &Viewpoint<f64>, wrench: &[f64; 6]) -> Vec<f64> {
    let by = |column: &[f64; 6]| column.iter().zip(wrench).map(|(a, b)| a * b).sum();
    geometric(robot, q, view).columns.iter().map(by).collect()
}

/// The torques that hold a wrench, along the axes of the base, which a link exerts at a point of its own frame: for each axis z through
/// p on the way to it z·(m + (r − p) × f), or z·f of a slide.
///
/// # Panics
/// If `q` does not have one entry per joint, or there is no such link.
pub fn holding_at(
    arm: &Dynamics<f64>,
    q: &[f64],
    on: (usize, Vector<f64>),
    [force, moment]: Wrench<f64>,
) -> Vec<f64> {
    assert_eq!(q.len(), arm.joints(), "one entry per joint");
    let (link, point) = on;
    let frames = arm.frames(arm.links.iter().map(|l| l.place(q)));
    let r = frames[link].rotation * point + frames[link].translation;
    let mut at_axes = vec![0.0; arm.links.len()];
    let mut next = Some(link);
    while let Some(k) = next {
        let (z, p) = (frames[k].rotation.z(), frames[k].translation);
        at_axes[k] = match arm.links[k].kind {
            JointKind::Revolute => z.dot(moment + (r - p).cross(force)),
            JointKind::Prismatic => z.dot(force),
        };
        next = arm.links[k].parent;
    }
    arm.at_joints(&at_axes)
}

/// Where the power of `torques` goes in the state `(q, qd)`; `held` is what of them holds a wrench.
///
/// # Panics
/// If `q` or `qd` does not have one entry per joint.
pub fn power(arm: &Dynamics<f64>, q: &[f64], qd: &[f64], torques: &[f64], held: Option<&[f64]>) -> Power {
    Power::of(qd, torques, &friction(arm, qd), &gravity_torques(arm, q), held)
}

impl Power {
    /// Where the power of `torques` goes at these rates, with the torques of friction and of gravity and those that hold a wrench.
    pub fn of(qd: &[f64], torques: &[f64], friction: &[f64], gravity: &[f64], held: Option<&[f64]>) -> Self {
        let by_rates = |all: &[f64]| all.iter().zip(qd).map(|(t, v)| t * v).sum::<f64>();
        let (supplied, dissipated) = (by_rates(torques), by_rates(friction));
        let (potential, exerted) = (by_rates(gravity), held.map_or(0.0, by_rates));
        let kinetic = supplied - dissipated - exerted - potential;
        Power { supplied, dissipated, exerted, potential, kinetic }
    }
}
