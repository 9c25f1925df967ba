//! The equations of motion: A q̈ = τ − C q̇ − Q − friction − Jᵀ w, where joints that stick do not move.

use super::{Acting, NoMotion};
use crate::dynamics::direct::factored;
use crate::dynamics::inertia::inertia_matrix;
use crate::dynamics::model::Dynamics;
use crate::dynamics::newton_euler::{gravity_torques, inverse_dynamics};

/// Equations of motion of a state: joint variables, their rates, and what was supplied, dissipated and exerted.
pub(super) trait Equations {
    /// The rate of a state `y` at `t`.
    fn slope(&self, t: f64, y: &[f64], contacts: &[Contact]) -> Result<Slope, NoMotion>;

    /// How joints move from the state `y` on.
    fn contacts(&self, t: f64, y: &[f64]) -> Result<Vec<Contact>, NoMotion>;

    /// Whether a contact does not hold any more.
    fn is_over(&self, j: usize, contact: Contact, y: &[f64], held: &[f64]) -> bool;

    /// Puts a state that an integrator reached to where it must be; whether it was changed.
    fn settle(&self, _: &mut [f64]) -> bool {
        false
    }
}

/// An arm and what acts on it.
pub(super) struct Problem<'a> {
    pub arm: &'a Dynamics<f64>,
    pub acting: &'a Acting,
}

/// Where a motion ends before its end.
pub(super) struct Stop {
    pub why: NoMotion,
    pub t: f64,
    pub y: Vec<f64>,
}

/// How a joint moves.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Contact {
    /// In this direction, 1 or −1; 0 without Coulomb's friction.
    Slides(f64),
    /// Not at all: friction holds it.
    Sticks,
}

/// The rate of a state, and what friction has to hold at the joints that stick.
#[derive(Clone)]
pub(super) struct Slope {
    /// Of q, q̇, and of what was supplied, dissipated and exerted.
    pub rate: Vec<f64>,
    /// The torque of friction by joint, 0 where it does not stick.
    pub held: Vec<f64>,
}

impl Equations for Problem<'_> {
    fn slope(&self, t: f64, y: &[f64], contacts: &[Contact]) -> Result<Slope, NoMotion> {
        let n = self.arm.joints();
        let (q, qd) = (&y[..n], &y[n..2 * n]);
        if y.iter().any(|x| !x.is_finite()) {
            return Err(NoMotion::NotFinite { t });
        }
        let still = vec![0.0; n];
        let wrench = self.acting.wrench.as_ref();
        let torques = self.acting.torques.at(t);
        // With gravity, viscous friction and what the tool exerts.
        let coasting = inverse_dynamics(self.arm, q, qd, &still, wrench);
        let matrix = inertia_matrix(self.arm, q);
        let drives = &self.arm.drives;
        let rest: Vec<f64> = (0..n)
            .map(|j| match contacts[j] {
                Contact::Slides(direction) => torques[j] - coasting[j] - drives[j].coulomb * direction,
                Contact::Sticks => torques[j] - coasting[j],
            })
            .collect();
        let free: Vec<usize> = (0..n).filter(|&j| contacts[j] != Contact::Sticks).collect();
        let part: Vec<Vec<f64>> =
            free.iter().map(|&i| free.iter().map(|&j| matrix[i][j]).collect()).collect();
        let factors = factored(&part);
        if let Some(k) = factors.lost(&part) {
            return Err(NoMotion::Singular { joint: free[k], t });
        }
        let solved = factors.solve(&free.iter().map(|&j| rest[j]).collect::<Vec<f64>>());
        let mut accelerations = still.clone();
        free.iter().zip(solved).for_each(|(&j, a)| accelerations[j] = a);
        let held = (0..n)
            .map(|j| match contacts[j] {
                Contact::Slides(_) => 0.0,
                Contact::Sticks => {
                    rest[j] - matrix[j].iter().zip(&accelerations).map(|(m, a)| m * a).sum::<f64>()
                }
            })
            .collect();
        let supplied: f64 = torques.iter().zip(qd).map(|(a, b)| a * b).sum();
        let rubbed = |j: usize| match contacts[j] {
            Contact::Slides(direction) => (drives[j].viscous * qd[j] + drives[j].coulomb * direction) * qd[j],
            Contact::Sticks => 0.0,
        };
        let dissipated: f64 = (0..n).map(rubbed).sum();
        let exerted: f64 = wrench.map_or(0.0, |_| {
            let with = inverse_dynamics(self.arm, q, &still, &still, wrench);
            let without = gravity_torques(self.arm, q);
            (0..n).map(|j| (with[j] - without[j]) * qd[j]).sum()
        });
        let rate: Vec<f64> =
            qd.iter().copied().chain(accelerations).chain([supplied, dissipated, exerted]).collect();
        match rate.iter().all(|x| x.is_finite()) {
            true => Ok(Slope { rate, held }),
            false => Err(NoMotion::NotFinite { t }),
        }
    }

    /// Joints at rest with Coulomb's friction stick where it can hold them.
    fn contacts(&self, t: f64, y: &[f64]) -> Result<Vec<Contact>, NoMotion> {
        let n = self.arm.joints();
        let mut contacts: Vec<Contact> = (0..n)
            .map(|j| match (self.arm.drives[j].coulomb != 0.0, y[n + j]) {
                (false, _) => Contact::Slides(0.0),
                (true, 0.0) => Contact::Sticks,
                (true, v) => Contact::Slides(v.signum()),
            })
            .collect();
        // The one that friction holds the least is let go, until all others are held.
        for _ in 0..n {
            let held = self.slope(t, y, &contacts)?.held;
            let excess = |j: usize| held[j].abs() / self.arm.drives[j].coulomb.abs();
            let sticking = (0..n).filter(|&j| contacts[j] == Contact::Sticks && excess(j) > 1.0);
            let Some(j) = sticking.max_by(|&a, &b| excess(a).total_cmp(&excess(b))) else { break };
            contacts[j] = Contact::Slides(held[j].signum());
        }
        Ok(contacts)
    }

    /// A joint that slides came to rest and beyond, or one that sticks is pulled harder than friction holds it.
    fn is_over(&self, j: usize, contact: Contact, y: &[f64], held: &[f64]) -> bool {
        match contact {
            Contact::Slides(direction) => y[self.arm.joints() + j] * direction < 0.0,
            Contact::Sticks => held[j].abs() > self.arm.drives[j].coulomb.abs(),
        }
    }
}
