//! Paths run through in a given time, and motions slowed down.

use super::error::MotionError;
use super::path::JointPath;
use super::profile::{Polynomial, Profile};
use super::trajectory::{JointState, Trajectory};

/// A path run through by a quintic law.
#[derive(Clone, Debug, PartialEq)]
pub struct InTime<P> {
    path: P,
    law: Polynomial,
}

impl<P: JointPath> InTime<P> {
    /// In so many seconds.
    ///
    /// # Errors
    /// If the duration is not a positive finite number.
    pub fn new(path: P, duration: f64) -> Result<Self, MotionError> {
        let law = Polynomial::quintic([0.0; 3], [path.end(), 0.0, 0.0], duration)?;
        Ok(InTime { path, law })
    }

    /// The largest velocity of each joint, looked for at many parameters, the knots of the path among them.
    pub fn fastest(&self) -> Vec<f64> {
        let end = self.path.end();
        let between = (0..=1000).map(|k| end * f64::from(k) / 1000.0);
        let mut fastest = vec![0.0_f64; self.path.dof()];
        for s in between.chain(self.path.knots().iter().copied()) {
            let speed = self.law.at(self.time(s)).velocity;
            for (f, d) in fastest.iter_mut().zip(self.path.eval(s).dq) {
                *f = f.max((d * speed).abs());
            }
        }
        fastest
    }

    /// When a parameter is reached: the law grows.
    fn time(&self, s: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.law.duration());
        for _ in 0..40 {
            let middle = f64::midpoint(low, high);
            if self.law.at(middle).position < s { low = middle } else { high = middle }
        }
        f64::midpoint(low, high)
    }
}

impl<P: JointPath> Trajectory for InTime<P> {
    fn dof(&self) -> usize {
        self.path.dof()
    }

    fn duration(&self) -> f64 {
        self.law.duration()
    }

    fn eval(&self, t: f64) -> JointState {
        let at = self.law.at(t);
        let point = self.path.eval(at.position);
        let pairs = point.dq.iter().zip(&point.ddq);
        JointState {
            qd: point.dq.iter().map(|d| d * at.velocity).collect(),
            qdd: pairs.map(|(d, dd)| d * at.acceleration + dd * at.velocity * at.velocity).collect(),
            q: point.q,
        }
    }
}

/// A motion slowed down.
pub struct Slowed {
    motion: Box<dyn Trajectory>,
    factor: f64,
}

impl Slowed {
    /// The motion, `factor` times as long; the factor is positive.
    pub fn new(motion: Box<dyn Trajectory>, factor: f64) -> Self {
        Slowed { motion, factor }
    }
}

impl Trajectory for Slowed {
    fn dof(&self) -> usize {
        self.motion.dof()
    }

    fn duration(&self) -> f64 {
        self.motion.duration() * self.factor
    }

    fn eval(&self, t: f64) -> JointState {
        let mut state = self.motion.eval(t / self.factor);
        state.qd.iter_mut().for_each(|v| *v /= self.factor);
        state.qdd.iter_mut().for_each(|a| *a /= self.factor * self.factor);
        state
    }
}
