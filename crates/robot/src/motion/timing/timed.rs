//! A path with its timing: between grid points s̈ is constant.

use crate::motion::error::MotionError;
use crate::motion::path::{JointPath, PathPoint, Side};
use crate::motion::trajectory::{JointState, Trajectory};

/// A path and the time at which it passes each parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedPath<P> {
    path: P,
    s: Vec<f64>,
    speed: Vec<f64>,
    time: Vec<f64>,
}

impl<P: JointPath> TimedPath<P> {
    /// With x = ṡ² at the grid points `s`: an interval takes 2Δ / (ṡᵢ + ṡᵢ₊₁).
    pub(super) fn new(path: P, s: Vec<f64>, x: Vec<f64>) -> Result<Self, MotionError> {
        let speed: Vec<f64> = x.iter().map(|x| x.sqrt()).collect();
        let mut time = Vec::with_capacity(s.len());
        let mut t = 0.0;
        time.push(t);
        for (s, v) in s.windows(2).zip(speed.windows(2)) {
            t += 2.0 * (s[1] - s[0]) / (v[0] + v[1]);
            time.push(t);
        }
        if !t.is_finite() {
            return Err(MotionError::Stuck { s: 0.0 });
        }
        Ok(Self { path, s, speed, time })
    }

    /// The path.
    pub fn path(&self) -> &P {
        &self.path
    }

    /// The grid points.
    pub fn parameters(&self) -> &[f64] {
        &self.s
    }

    /// ṡ at the grid points; between them its square is linear in s.
    pub fn speeds(&self) -> &[f64] {
        &self.speed
    }

    /// The times at the grid points.
    pub fn times(&self) -> &[f64] {
        &self.time
    }

    /// s, ṡ and s̈ at the time `t`, held within the duration.
    pub fn parameter_at(&self, t: f64) -> [f64; 3] {
        self.locate(t).0
    }

    /// The same, and the side from which to look at the path: what rounding puts at the end of an interval is still
    /// before it.
    fn locate(&self, t: f64) -> ([f64; 3], Side) {
        let n = self.s.len() - 1;
        let t = t.clamp(0.0, self.time[n]);
        let i = self.time[1..n].partition_point(|time| *time <= t);
        let (s, v, w) = (&self.s[i..i + 2], self.speed[i], self.speed[i + 1]);
        let u = (w * w - v * v) / (2.0 * (s[1] - s[0]));
        // From the nearer end, so that both ends are met exactly.
        let (before, after) = (t - self.time[i], self.time[i + 1] - t);
        let (at, speed) = if before <= after {
            (s[0] + before * (v + before * u / 2.0), v + before * u)
        } else {
            (s[1] - after * (w - after * u / 2.0), w - after * u)
        };
        let side = if at >= s[1] { Side::Before } else { Side::Behind };
        ([at.clamp(s[0], s[1]), speed.max(0.0), u], side)
    }
}

impl<P: JointPath> Trajectory for TimedPath<P> {
    fn dof(&self) -> usize {
        self.path.dof()
    }

    fn duration(&self) -> f64 {
        self.time[self.time.len() - 1]
    }

    fn eval(&self, t: f64) -> JointState {
        let ([s, v, u], side) = self.locate(t);
        let mut point = PathPoint::zeros(self.dof());
        self.path.eval_into(s, side, &mut point);
        let PathPoint { q, dq, ddq, .. } = point;
        let qdd = dq.iter().zip(&ddq).map(|(dq, ddq)| dq * u + ddq * v * v).collect();
        JointState { q, qd: dq.iter().map(|dq| dq * v).collect(), qdd }
    }
}
