//! The motion of closed loops, in all their joints: the state is put back to where the loops are closed after each step.

use super::adaptive::Adaptive;
use super::problem::{Contact, Equations, Slope};
use super::{Moment, NoMotion, Simulation, Torques, begun, followed};
use crate::dynamics::closed::{ClosedDynamics, NoAcceleration};
use crate::dynamics::energy::{kinetic_energy, potential_energy};
use crate::dynamics::newton_euler::friction;

/// Closed loops and the torques of their driven joints.
struct Closed<'a> {
    of: &'a ClosedDynamics,
    torques: &'a Torques,
}

impl Equations for Closed<'_> {
    fn slope(&self, t: f64, y: &[f64], _: &[Contact]) -> Result<Slope, NoMotion> {
        if y.iter().any(|x| !x.is_finite()) {
            return Err(NoMotion::NotFinite { t });
        }
        let n = self.of.tree().joints();
        let (all, rates) = (&y[..n], &y[n..2 * n]);
        let torques = self.torques.at(t);
        let accelerations = self.of.accelerations(all, rates, &torques).map_err(|why| match why {
            NoAcceleration::Meets => NoMotion::Meets { t },
            NoAcceleration::Massless(motion) => NoMotion::Massless { motion, t },
        })?;
        let supplied: f64 = torques.iter().zip(rates).map(|(a, b)| a * b).sum();
        let dissipated: f64 = friction(self.of.tree(), rates).iter().zip(rates).map(|(a, b)| a * b).sum();
        let rate: Vec<f64> =
            rates.iter().copied().chain(accelerations).chain([supplied, dissipated, 0.0]).collect();
        match rate.iter().all(|x| x.is_finite()) {
            true => Ok(Slope { rate, held: vec![0.0; n] }),
            false => Err(NoMotion::NotFinite { t }),
        }
    }

    fn contacts(&self, _: f64, _: &[f64]) -> Result<Vec<Contact>, NoMotion> {
        Ok(vec![Contact::Slides(0.0); self.of.tree().joints()])
    }

    fn is_over(&self, _: usize, _: Contact, _: &[f64], _: &[f64]) -> bool {
        false
    }

    fn settle(&self, y: &mut [f64]) -> bool {
        let n = self.of.tree().joints();
        let (all, rest) = y.split_at_mut(n);
        self.of.loops().settle(all, &mut rest[..n]);
        true
    }
}

/// The motion of closed loops from a configuration `(q, p)` with the rates `qd` of the driven joints, under torques of these, for
/// `duration` seconds, every `dt` seconds and at its end. Samples hold all joints, the driven ones first.
///
/// # Errors
/// If the driven joints do not tell the rates of the passive ones at the start, a joint has Coulomb's friction, the duration, the step or
/// the tolerance is not positive, there are too many samples, or the motion cannot be followed: what was found until then is beside it.
///
/// # Panics
/// If `q`, `p`, `qd` or a row of torques does not have one entry per joint.
pub fn simulate_closed(
    of: &ClosedDynamics,
    (q, p, qd): (&[f64], &[f64], &[f64]),
    torques: &Torques,
    (duration, dt): (f64, f64),
    tolerance: f64,
) -> Result<Simulation, (NoMotion, Simulation)> {
    assert_eq!([qd.len(), torques.joints()], [q.len(); 2], "one entry per joint");
    let simulation = begun(duration, dt, tolerance)?;
    let tree = of.tree();
    if tree.drives.iter().any(|d| d.coulomb != 0.0) {
        return Err((NoMotion::Coulomb, simulation));
    }
    let Ok(start) = of.at(q, p) else { return Err((NoMotion::Meets { t: 0.0 }, simulation)) };
    let n = tree.joints();
    let y: Vec<f64> = q.iter().chain(p).copied().chain(start.rates(qd)).chain([0.0; 3]).collect();
    let moment = |t: f64, y: &[f64]| -> Moment {
        let (all, rates) = (y[..n].to_vec(), y[n..2 * n].to_vec());
        let mut driving = torques.at(t);
        driving.resize(n, 0.0);
        Moment {
            t,
            kinetic: kinetic_energy(tree, &all, &rates),
            potential: potential_energy(tree, &all),
            torques: driving,
            supplied: y[2 * n],
            dissipated: y[2 * n + 1],
            exerted: y[2 * n + 2],
            q: all,
            qd: rates,
        }
    };
    let problem = Closed { of, torques };
    let mut stepper = Adaptive::new(tolerance, duration);
    followed(simulation, torques, y, (duration, dt), moment, |from_to, y, counts| {
        stepper.run(&problem, from_to, y, counts)
    })
}
