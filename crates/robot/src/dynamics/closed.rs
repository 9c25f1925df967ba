//! Closed loops with masses, in numbers: the tree of bodies with all its joints, and what the closures say of how these move
//! (Khalil and Dombre 2002, ch. 10).
//!
//! With the rates of all joints S q̇ in those of the driven ones, their accelerations S q̈ + c, the torques of the driven joints are Sᵀ
//! times those of the tree, and the inertia is SᵀAS. Motions are followed in all joints, for driven joints alone say nothing at a dead
//! point: accelerations are the part N y of all that the closures allow, with NᵀAN y = Nᵀ(τ − h − A c).

use super::direct::{ROUNDING, factored};
use super::energy::{kinetic_energy, potential_energy};
use super::inertia::inertia_matrix;
use super::model::{Dynamics, NoNumbers, weights_of};
use super::momentum::{Momentum, momentum};
use super::newton_euler::{drive_torques, friction, gravity_torques, velocity_torques};
use crate::closure::Loops;
use crate::description::Linkage;
use denavit_symbolic::Symbol;
use std::fmt;

/// A linkage with masses.
pub struct ClosedDynamics {
    loops: Loops,
    /// All joints, the driven ones first; those that are cut move no link.
    tree: Dynamics<f64>,
}

/// A linkage at a configuration at which the driven joints tell how all others move.
pub struct Held<'a> {
    of: &'a ClosedDynamics,
    /// All joints.
    all: Vec<f64>,
    /// S, a row a joint.
    rates: Vec<Vec<f64>>,
}

/// Assembly modes meet: so many motions of passive joints are possible with the driven ones at rest, of these joints (from 0).
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Meets {
    /// The passive joints that are left free.
    pub free: Vec<usize>,
}

impl fmt::Display for Meets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<String> = self.free.iter().map(|k| format!("p{}", k + 1)).collect();
        write!(
            f,
            "with the driven joints at rest passive ones can move ({}): assembly modes meet here",
            names.join(", ")
        )
    }
}

impl std::error::Error for Meets {}

/// Rᵀ of a matrix by its rows, times a vector with an entry a row.
fn transposed(rows: &[Vec<f64>], by: &[f64]) -> Vec<f64> {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns).map(|j| rows.iter().zip(by).map(|(row, x)| row[j] * x).sum()).collect()
}

fn times(rows: &[Vec<f64>], by: &[f64]) -> Vec<f64> {
    rows.iter().map(|row| row.iter().zip(by).map(|(a, b)| a * b).sum()).collect()
}

/// SᵀAS
fn seen_through(matrix: &[Vec<f64>], rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = rows.first().map_or(0, Vec::len);
    let column = |j: usize| {
        let own: Vec<f64> = rows.iter().map(|row| row[j]).collect();
        transposed(rows, &times(matrix, &own))
    };
    (0..columns).map(column).collect()
}

impl ClosedDynamics {
    /// A linkage with the masses of its rows, in numbers.
    ///
    /// # Errors
    /// If it says nothing of masses, a mass is negative, or a parameter has no value.
    pub fn new(linkage: &Linkage) -> Result<Self, NoNumbers> {
        let d = linkage.all_rows();
        if !linkage.tree.rows.iter().any(|r| r.body().is_some()) {
            return Err(NoNumbers::NoMasses);
        }
        let loops = Loops::new(linkage).map_err(NoNumbers::Missing)?;
        let all = linkage.driven().into_iter().chain(linkage.passive());
        let all: Vec<Symbol> = all.map(|v| v.symbol).collect();
        let tree = Dynamics::of_tree(&linkage.tree, &all, weights_of(&d, &all)?, |s| d.value(s));
        Ok(ClosedDynamics { loops, tree })
    }

    /// Its geometry.
    pub fn loops(&self) -> &Loops {
        &self.loops
    }

    /// All its joints as they move without closures, the driven ones first.
    pub fn tree(&self) -> &Dynamics<f64> {
        &self.tree
    }

    /// The linkage where its joints are.
    ///
    /// # Errors
    /// If the driven joints do not tell how the passive ones move.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn at(&self, q: &[f64], p: &[f64]) -> Result<Held<'_>, Meets> {
        let free = |free: Vec<usize>| Meets { free };
        let g = self.loops.passive_rates(q, p).map_err(free)?;
        let n = q.len();
        let one = |j: usize| (0..n).map(|k| f64::from(u8::from(j == k))).collect();
        let rates = (0..n).map(one).chain(g).collect();
        Ok(Held { of: self, all: [q, p].concat(), rates })
    }

    /// The accelerations of all joints under torques of the driven ones, in a state that the closures allow.
    ///
    /// # Errors
    /// The joint, from 0, that has no inertia, or what is left free.
    pub(super) fn accelerations(
        &self,
        all: &[f64],
        rates: &[f64],
        torques: &[f64],
    ) -> Result<Vec<f64>, NoAcceleration> {
        let allowed = self.loops.allowed(all, rates).ok_or(NoAcceleration::Meets)?;
        let still = vec![0.0; all.len()];
        let matrix = inertia_matrix(&self.tree, all);
        let coasting = drive_torques(&self.tree, all, rates, &still, None);
        let bent = times(&matrix, &allowed.drift);
        let mut driving = torques.to_vec();
        driving.resize(all.len(), 0.0);
        let rest: Vec<f64> = driving.iter().zip(coasting).zip(bent).map(|((t, c), b)| t - c - b).collect();
        // By rows: joint by joint what the free motions do.
        let free: Vec<Vec<f64>> =
            (0..all.len()).map(|j| allowed.free.iter().map(|motion| motion[j]).collect()).collect();
        let own = seen_through(&matrix, &free);
        let factors = factored(&own);
        let largest = (0..own.len()).map(|k| own[k][k]).fold(0.0, f64::max);
        let is_lost = |k: usize| factors.diagonal[k].is_nan() || factors.diagonal[k] <= ROUNDING * largest;
        if let Some(k) = (0..own.len()).find(|&k| is_lost(k)) {
            return Err(NoAcceleration::Massless(k));
        }
        let y = factors.solve(&transposed(&free, &rest));
        Ok(times(&free, &y).iter().zip(&allowed.drift).map(|(a, b)| a + b).collect())
    }
}

/// Why no acceleration follows.
pub(super) enum NoAcceleration {
    /// Assembly modes meet.
    Meets,
    /// This motion, from 0, moves no mass.
    Massless(usize),
}

impl Held<'_> {
    /// The rates of all joints.
    ///
    /// # Panics
    /// If there is not one rate for each driven joint, here and below.
    pub fn rates(&self, qd: &[f64]) -> Vec<f64> {
        assert_eq!(Some(qd.len()), self.rates.first().map(Vec::len), "one rate for each driven joint");
        times(&self.rates, qd)
    }

    /// Their accelerations.
    pub fn accelerations(&self, qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        let drift = self.of.loops.drift(&self.all, &self.rates(qd), qd.len());
        times(&self.rates, qdd).iter().zip(drift).map(|(a, b)| a + b).collect()
    }

    /// The torques of the driven joints that accelerate them so: those of masses, rotors, gravity and friction.
    pub fn torques(&self, qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        let (rates, changes) = (self.rates(qd), self.accelerations(qd, qdd));
        transposed(&self.rates, &drive_torques(&self.of.tree, &self.all, &rates, &changes, None))
    }

    /// The inertia matrix of the driven joints.
    pub fn inertia(&self) -> Vec<Vec<f64>> {
        seen_through(&inertia_matrix(&self.of.tree, &self.all), &self.rates)
    }

    /// The torques of gravity.
    pub fn gravity(&self) -> Vec<f64> {
        transposed(&self.rates, &gravity_torques(&self.of.tree, &self.all))
    }

    /// The centrifugal and Coriolis torques, with those by which the passive joints change their rates.
    pub fn velocity(&self, qd: &[f64]) -> Vec<f64> {
        let (tree, rates) = (&self.of.tree, self.rates(qd));
        let drift = self.accelerations(qd, &vec![0.0; qd.len()]);
        let bent = times(&inertia_matrix(tree, &self.all), &drift);
        let own = velocity_torques(tree, &self.all, &rates);
        transposed(&self.rates, &own.iter().zip(bent).map(|(a, b)| a + b).collect::<Vec<f64>>())
    }

    /// The torques of friction, of all joints, as the driven ones feel it.
    pub fn friction(&self, qd: &[f64]) -> Vec<f64> {
        transposed(&self.rates, &friction(&self.of.tree, &self.rates(qd)))
    }

    /// The accelerations of the driven joints under torques; nothing, but the first joint that moves no mass, if none follow.
    ///
    /// # Errors
    /// The joint, from 0.
    pub fn under(&self, qd: &[f64], torques: &[f64]) -> Result<Vec<f64>, super::Singular> {
        let matrix = self.inertia();
        let factors = factored(&matrix);
        if let Some(joint) = factors.lost(&matrix) {
            return Err(super::Singular { joint });
        }
        let coasting = self.torques(qd, &vec![0.0; qd.len()]);
        let rest: Vec<f64> = torques.iter().zip(coasting).map(|(t, c)| t - c).collect();
        Ok(factors.solve(&rest))
    }

    /// The kinetic and the potential energy, joules.
    pub fn energies(&self, qd: &[f64]) -> [f64; 2] {
        let tree = &self.of.tree;
        [kinetic_energy(tree, &self.all, &self.rates(qd)), potential_energy(tree, &self.all)]
    }

    /// The momentum.
    pub fn momentum(&self, qd: &[f64]) -> Momentum {
        momentum(&self.of.tree, &self.all, &self.rates(qd))
    }
}
