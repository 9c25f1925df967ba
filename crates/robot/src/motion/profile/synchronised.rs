//! Several joints that start and arrive together, from rest to rest.

use super::{Phases, Polynomial, Profile, Sample, double_s, trapezoidal};
use crate::motion::error::{MotionError, joints};
use crate::motion::limits::Limits;
use crate::motion::trajectory::{JointState, Trajectory};

/// Which time law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// Cubic: velocity is a parabola.
    Cubic,
    /// Quintic: no acceleration at the ends; a jerk limit holds where there is one.
    Quintic,
    /// Trapezoidal velocity: the fastest under velocity and acceleration limits.
    Trapezoidal,
    /// Jerk-limited: the fastest under velocity, acceleration and jerk limits.
    DoubleS,
}

/// The time law of one joint.
#[derive(Clone, Debug, PartialEq)]
pub enum TimeLaw {
    /// Cubic or quintic.
    Polynomial(Polynomial),
    /// Trapezoidal or jerk-limited.
    Phases(Phases),
}

impl Profile for TimeLaw {
    fn duration(&self) -> f64 {
        match self {
            Self::Polynomial(p) => p.duration(),
            Self::Phases(p) => p.duration(),
        }
    }

    fn at(&self, t: f64) -> Sample {
        match self {
            Self::Polynomial(p) => p.at(t),
            Self::Phases(p) => p.at(t),
        }
    }
}

/// Time laws of all joints, of the same duration.
#[derive(Clone, Debug, PartialEq)]
pub struct JointMove {
    laws: Vec<TimeLaw>,
    duration: f64,
}

impl JointMove {
    pub(in crate::motion) fn new(laws: Vec<TimeLaw>, duration: f64) -> Self {
        Self { laws, duration }
    }

    /// The time laws, one a joint.
    pub fn laws(&self) -> &[TimeLaw] {
        &self.laws
    }

    /// The jerk at `t` seconds, one entry a joint; where it jumps, the one behind.
    pub fn jerk(&self, t: f64) -> Vec<f64> {
        self.laws.iter().map(|law| law.at(t).jerk).collect()
    }
}

impl Trajectory for JointMove {
    fn dof(&self) -> usize {
        self.laws.len()
    }

    fn duration(&self) -> f64 {
        self.duration
    }

    fn eval(&self, t: f64) -> JointState {
        let samples: Vec<Sample> = self.laws.iter().map(|law| law.at(t)).collect();
        JointState {
            q: samples.iter().map(|s| s.position).collect(),
            qd: samples.iter().map(|s| s.velocity).collect(),
            qdd: samples.iter().map(|s| s.acceleration).collect(),
        }
    }
}

/// All joints from rest to rest: the slowest joint decides how long it takes, and the laws of the others are slowed
/// down to that time, so that their limits hold with room to spare. Where nothing moves it takes no time.
///
/// Where the limits of the acceleration differ between the directions the smaller one holds for both.
///
/// # Errors
/// If the lists have not one finite number for each joint of the limits; if the law is [`Law::DoubleS`] and there
/// are no jerk limits; if a joint must move in a direction in which its limits forbid it.
pub fn synchronised(from: &[f64], to: &[f64], limits: &Limits, law: Law) -> Result<JointMove, MotionError> {
    joints("start", limits.dof(), from)?;
    joints("end", limits.dof(), to)?;
    let fastest: Vec<TimeLaw> =
        (0..from.len()).map(|i| fastest(from[i], to[i], limits, law, i)).collect::<Result<_, _>>()?;
    let duration = fastest.iter().map(Profile::duration).fold(0.0, f64::max);
    let laws = fastest.into_iter().zip(from).map(|(law, &q)| stretched(law, q, duration)).collect();
    Ok(JointMove { laws, duration })
}

fn fastest(from: f64, to: f64, limits: &Limits, law: Law, joint: usize) -> Result<TimeLaw, MotionError> {
    if from == to {
        return Ok(TimeLaw::Polynomial(Polynomial::constant(from, 0.0)));
    }
    let range = limits.velocity()[joint];
    let v = if to > from { range.upper } else { -range.lower };
    let a = limits.acceleration()[joint].both_ways();
    let j = limits.jerk().map(|j| j[joint]);
    Ok(match law {
        Law::Cubic => TimeLaw::Polynomial(Polynomial::fastest_cubic(from, to, v, a)?),
        Law::Quintic => TimeLaw::Polynomial(Polynomial::fastest_quintic(from, to, v, a, j)?),
        Law::Trapezoidal => TimeLaw::Phases(trapezoidal([from, to], [0.0; 2], v, a)?),
        Law::DoubleS => {
            let j = j.ok_or(MotionError::NoJerkLimits)?;
            TimeLaw::Phases(double_s([from, to], [0.0; 2], v, a, j)?)
        }
    })
}

fn stretched(law: TimeLaw, from: f64, duration: f64) -> TimeLaw {
    let own = law.duration();
    if own == 0.0 {
        return TimeLaw::Polynomial(Polynomial::constant(from, duration));
    }
    match law {
        TimeLaw::Polynomial(p) => TimeLaw::Polynomial(p.slowed(duration / own)),
        TimeLaw::Phases(p) => TimeLaw::Phases(p.slowed(duration / own)),
    }
}
