//! The motion of an arm under torques, over time.
//!
//! Two integrators: Dormand and Prince's pair of orders 5 and 4 with steps by its error, for which Coulomb's friction is what it is
//! (joints slide, or stick until something overcomes the friction; where one turns into the other is found, at the ends of steps and within
//! them, as far as a cubic through the velocities and the friction at the stages of a step show it), and Gauss's method of
//! order 4 with steps of one length, in joint variables and momenta, which is symplectic: without friction and with constant
//! torques the energy does not drift, it oscillates by the fourth power of the step.
//!
//! What the torques supply, friction takes and the tool gives away is integrated with the motion, so that the energy can be
//! balanced at any time: [`Moment::imbalance`] is the error of the integration.

mod adaptive;
mod closed;
mod problem;
mod symplectic;
mod torques;

pub use closed::simulate_closed;
pub use torques::Torques;

use super::energy::{kinetic_energy, potential_energy};
use super::model::{Dynamics, Wrench};
use problem::{Problem, Stop};
use std::fmt;

/// Steps that a simulation takes at most.
const MAX_STEPS: usize = 500_000;
/// Samples that are given at most: each ends a step.
const MAX_SAMPLES: usize = MAX_STEPS;

/// How a motion is integrated.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Method {
    /// Dormand and Prince's, with steps for this estimated error of each, relative and absolute (radians, metres, seconds, joules).
    Adaptive {
        /// The estimated error of a step.
        tolerance: f64,
    },
    /// Gauss's of order 4, with steps of at most so many seconds.
    Symplectic {
        /// The longest step.
        step: f64,
    },
}

/// What acts on an arm.
#[derive(Clone, Debug)]
pub struct Acting {
    /// The torques of the drives.
    pub torques: Torques,
    /// What the tool exerts, constant in the base.
    pub wrench: Option<Wrench<f64>>,
}

/// An arm at a time.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// Seconds.
    pub t: f64,
    /// The joint variables.
    pub q: Vec<f64>,
    /// Their rates.
    pub qd: Vec<f64>,
    /// The torques of the drives.
    pub torques: Vec<f64>,
    /// Joules.
    pub kinetic: f64,
    /// Joules; 0 with all mass at the origin of the base.
    pub potential: f64,
    /// What the torques have supplied since the start, joules.
    pub supplied: f64,
    /// What friction has taken since the start, joules.
    pub dissipated: f64,
    /// What the tool has given to its surroundings since the start, joules.
    pub exerted: f64,
}

/// A motion over time.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// At regular times, the start and the end among them.
    pub moments: Vec<Moment>,
    /// Steps that were taken.
    pub steps: usize,
    /// Steps that were refused, and taken again shorter.
    pub refused: usize,
    /// How often a joint began to slide or to stick.
    pub switched: usize,
}

/// Why there is no motion, or none to the end.
#[derive(Clone, PartialEq, Debug)]
pub enum NoMotion {
    /// The joint, from 0, moves no mass: no acceleration follows from torques.
    Singular {
        /// The joint.
        joint: usize,
        /// When.
        t: f64,
    },
    /// Closed loops are where assembly modes meet: which way they go on does not follow.
    Meets {
        /// When.
        t: f64,
    },
    /// A free motion of closed loops, from 0, moves no mass.
    Massless {
        /// The motion.
        motion: usize,
        /// When.
        t: f64,
    },
    /// More steps than are taken are needed; it came as far as this.
    Steps {
        /// When.
        t: f64,
    },
    /// The numbers became too large.
    NotFinite {
        /// When.
        t: f64,
    },
    /// The equations of a symplectic step were not solved: it is too long.
    NotSolved {
        /// When.
        t: f64,
    },
    /// Coulomb's friction has no derivative at rest: it needs steps by their error.
    Coulomb,
    /// More samples are asked for than are given.
    Samples,
    /// A duration, a time between samples, a step or a tolerance that is not positive.
    NotPositive,
}

impl fmt::Display for NoMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoMotion::Singular { joint, t } => {
                write!(f, "at {t} s joint {} moves no mass of its own", joint + 1)
            }
            NoMotion::Meets { t } => {
                write!(f, "at {t} s assembly modes meet: which way the loops go on does not follow")
            }
            NoMotion::Massless { motion, t } => {
                write!(f, "at {t} s free motion {} of the loops moves no mass", motion + 1)
            }
            NoMotion::Steps { t } => write!(f, "{MAX_STEPS} steps came as far as {t} s"),
            NoMotion::NotFinite { t } => write!(f, "after {t} s the numbers become too large"),
            NoMotion::NotSolved { t } => {
                write!(f, "at {t} s the step is too long for its equations to be solved")
            }
            NoMotion::Coulomb => f.write_str("Coulomb's friction needs steps by their error"),
            NoMotion::Samples => write!(f, "more than {MAX_SAMPLES} samples"),
            NoMotion::NotPositive => f.write_str("durations, steps and tolerances are positive"),
        }
    }
}

impl std::error::Error for NoMotion {}

impl Moment {
    /// By how much the energy is more than it was in `start`, less what came in and plus what went out: the error of the
    /// integration, joules.
    pub fn imbalance(&self, start: &Moment) -> f64 {
        let energy = |m: &Moment| m.kinetic + m.potential;
        energy(self) - energy(start) - (self.supplied - self.dissipated - self.exerted)
    }
}

impl Simulation {
    /// The joints, from 0, that leave these limits, with the first sample's time at which they are beyond: nothing stops them.
    pub fn leaves(&self, limits: &[Option<[f64; 2]>]) -> Vec<(usize, f64)> {
        let of = |(j, limits): (usize, &Option<[f64; 2]>)| {
            let [low, high] = (*limits)?;
            let m = self.moments.iter().find(|m| m.q[j] < low || m.q[j] > high)?;
            Some((j, m.t))
        };
        limits.iter().enumerate().filter_map(of).collect()
    }

    /// The largest imbalance of the energy in size, and the largest of the energies that it is to be compared with: kinetic,
    /// and potential less that of the start.
    pub fn drift(&self) -> (f64, f64) {
        let Some(start) = self.moments.first() else { return (0.0, 0.0) };
        let largest =
            |of: &dyn Fn(&Moment) -> f64| self.moments.iter().map(|m| of(m).abs()).fold(0.0, f64::max);
        let size = largest(&|m| m.kinetic).max(largest(&|m| m.potential - start.potential));
        (largest(&|m| m.imbalance(start)), size)
    }
}

/// The motion from the state `(q, qd)` for `duration` seconds, every `dt` seconds and at its end.
///
/// # Errors
/// If the duration, a step or a tolerance is not positive, there are too many samples, or the motion cannot be followed: what was
/// found until then is beside it.
///
/// # Panics
/// If `q`, `qd` or a row of torques does not have one entry per joint.
pub fn simulate(
    arm: &Dynamics<f64>,
    (q, qd): (&[f64], &[f64]),
    acting: &Acting,
    (duration, dt): (f64, f64),
    method: Method,
) -> Result<Simulation, (NoMotion, Simulation)> {
    let n = arm.joints();
    assert_eq!([q.len(), qd.len(), acting.torques.joints()], [n; 3], "one entry per joint");
    let (Method::Adaptive { tolerance: fine } | Method::Symplectic { step: fine }) = method;
    let simulation = begun(duration, dt, fine)?;
    let is_coulomb = arm.drives.iter().any(|d| d.coulomb != 0.0);
    if is_coulomb && matches!(method, Method::Symplectic { .. }) {
        return Err((NoMotion::Coulomb, simulation));
    }
    let problem = Problem { arm, acting };
    let moment = |t: f64, y: &[f64]| -> Moment {
        let (q, qd) = (y[..n].to_vec(), y[n..2 * n].to_vec());
        Moment {
            t,
            kinetic: kinetic_energy(arm, &q, &qd),
            potential: potential_energy(arm, &q),
            torques: acting.torques.at(t),
            supplied: y[2 * n],
            dissipated: y[2 * n + 1],
            exerted: y[2 * n + 2],
            q,
            qd,
        }
    };
    let y: Vec<f64> = q.iter().chain(qd).copied().chain([0.0; 3]).collect();
    let mut stepper = match method {
        Method::Adaptive { tolerance } => Stepper::Adaptive(adaptive::Adaptive::new(tolerance, duration)),
        Method::Symplectic { step } => Stepper::Symplectic(symplectic::Symplectic::new(step)),
    };
    let step = |from_to: (f64, f64), y: &mut Vec<f64>, counts: &mut Simulation| match &mut stepper {
        Stepper::Adaptive(s) => s.run(&problem, from_to, y, counts),
        Stepper::Symplectic(s) => s.run(&problem, from_to, y, counts),
    };
    followed(simulation, &acting.torques, y, (duration, dt), moment, step)
}

/// Nothing yet, if that is what can be simulated.
fn begun(duration: f64, dt: f64, fine: f64) -> Result<Simulation, (NoMotion, Simulation)> {
    let nothing = Simulation { moments: vec![], steps: 0, refused: 0, switched: 0 };
    if ![duration, dt, fine].iter().all(|x| x.is_finite() && *x > 0.0) {
        return Err((NoMotion::NotPositive, nothing));
    }
    if duration / dt > MAX_SAMPLES as f64 {
        return Err((NoMotion::Samples, nothing));
    }
    Ok(nothing)
}

/// The samples of a motion from the state `y`: steps end at these, and where the torques have a kink.
fn followed(
    mut simulation: Simulation,
    torques: &Torques,
    mut y: Vec<f64>,
    (duration, dt): (f64, f64),
    moment: impl Fn(f64, &[f64]) -> Moment,
    mut step: impl FnMut((f64, f64), &mut Vec<f64>, &mut Simulation) -> Result<(), Stop>,
) -> Result<Simulation, (NoMotion, Simulation)> {
    let samples = (duration / dt - 1e-9).ceil().max(1.0) as usize;
    simulation.moments.push(moment(0.0, &y));
    let mut t = 0.0;
    for k in 1..=samples {
        let until = if k == samples { duration } else { k as f64 * dt };
        let ends: Vec<f64> = torques.between(t, until).chain([until]).collect();
        for end in ends {
            if let Err(Stop { why, t, y }) = step((t, end), &mut y, &mut simulation) {
                if y.iter().all(|x| x.is_finite()) {
                    simulation.moments.push(moment(t, &y));
                }
                return Err((why, simulation));
            }
            t = end;
        }
        simulation.moments.push(moment(t, &y));
    }
    Ok(simulation)
}

enum Stepper {
    Adaptive(adaptive::Adaptive),
    Symplectic(symplectic::Symplectic),
}
