//! A fast timing of a path, from rest to rest, under velocity, acceleration and jerk limits, and torque limits if there are any.
//!
//! With the path p(τ), x = τ̇², u = x'/2 the velocity is p' √x, the acceleration p' u + p'' x, and the jerk
//! (p' u' + 3 p'' u + p''' x) √x. All but the factor √x is linear in x and its derivatives, and x is a quadratic spline
//! in τ. The jerk limit |…| ≤ j / √x is approximated from inside by the tangent of 1/√x, which is below it; the
//! duration ∫ dτ/√x is convex. So each step is convex and feasible, and the next one starts from a better tangent: the
//! convex-concave procedure of Debrouwere et al., *Time-optimal path following for robots with convex-concave
//! constraints using sequential convex programming*, IEEE Transactions on Robotics 29 (6), 2013; solved by Newton's
//! method with logarithmic barriers (Boyd & Vandenberghe, *Convex Optimization*, ch. 11) on a banded matrix.
//!
//! The torques a u + b x + c + f + k √x (see [`TorqueLimits`]) are linear but for viscous friction, of which the root is
//! treated as that of the jerk is; where it helps to brake it is counted on.
//!
//! The result is a local optimum, not proved to be the fastest motion. To start from rest smoothly, τ is not s:
//! s = end · (10τ³ − 15τ⁴ + 6τ⁵) makes the path itself start and end without velocity and acceleration.

mod banded;
mod barrier;
mod spline;
mod timed;
mod torques;
mod warped;

pub use timed::SmoothTimedPath;

use super::MAX_SAMPLES;
use super::error::{Failure, MotionError, finite};
use super::limits::Limits;
use super::path::JointPath;
use super::timing::{TorqueLimits, fitting};
use torques::Loads;

/// Where a limit is exceeded between the points at which it is imposed it is tightened there, so many times at most.
const ROUNDS: usize = 4;
/// Points of each interval at which the limits are checked in a round.
const CHECKS: usize = 10;
/// Points of each interval at which they are checked in the end.
const LAST_CHECKS: usize = 40;
/// A motion that is to be slowed down by less than this factor is not worth another round.
const SLOWNESS: f64 = 1.0005;
/// Where friction grows with the speed slowing down needs several steps, so many at most, and a little more at each.
const STEPS: usize = 200;
const BEYOND: f64 = 1.0 + 1e-9;

/// Fast timings under jerk limits: the options, and [`time`](Self::time).
#[derive(Clone, Debug, PartialEq)]
pub struct JerkLimited {
    /// About so many intervals between the ends, [`MIN_INTERVALS`](crate::motion::timing::MIN_INTERVALS)
    /// at least between knots of the path.
    pub intervals: usize,
    /// The duration is at most by this share longer than the local optimum on the grid.
    pub gap: f64,
}

impl Default for JerkLimited {
    /// 250 intervals, a gap of 10⁻³.
    fn default() -> Self {
        Self { intervals: 250, gap: 1e-3 }
    }
}

impl JerkLimited {
    /// A timing of `path` from rest to rest, with no acceleration at its ends, within `limits`.
    ///
    /// The limits hold at forty points of each interval at least, and on parabolas through them: where they are exceeded they are tightened, and what is
    /// left in the end is removed by slowing down the whole motion ([`SmoothTimedPath::slowed`] says by how much).
    ///
    /// # Errors
    /// If an input is not finite or does not fit, there are no jerk limits, the path does not know q''', or q' or q''
    /// jumps (parabolic blends, corners), where no jerk limit holds without a stop.
    pub fn time<P: JointPath>(&self, path: P, limits: &Limits) -> Result<SmoothTimedPath<P>, MotionError> {
        self.time_within(path, limits, None)
    }

    /// The same within torque limits, too, which hold where the others do. Where the arm stands still it is to be within them
    /// all along the path, with Coulomb's friction against it.
    ///
    /// # Errors
    /// As [`time`](Self::time), and if the arm cannot carry itself somewhere ([`MotionError::Torque`]).
    pub fn time_within<P: JointPath>(
        &self,
        path: P,
        limits: &Limits,
        torque_limits: Option<&TorqueLimits>,
    ) -> Result<SmoothTimedPath<P>, MotionError> {
        let jerk = limits.jerk().ok_or(MotionError::NoJerkLimits)?;
        fitting(path.dof(), limits, torque_limits)?;
        if self.intervals > MAX_SAMPLES {
            return Err(MotionError::TooMany("intervals", self.intervals as f64));
        }
        finite("the gap and the end of the path", &[self.gap, path.end()])?;
        if path.end() <= 0.0 {
            return Err(MotionError::ZeroLength);
        }
        if !path.has_third_derivative() {
            return Err(MotionError::NoThirdDerivative);
        }
        warped::smooth(&path)?;
        let grid = warped::grid(&path, self.intervals)?;
        let loads = torque_limits.map(|torques| Loads::new(torques, &path, &grid)).transpose()?;
        let is_viscous = torque_limits.is_some_and(TorqueLimits::is_viscous);
        let mut problem = barrier::Problem::new(&path, limits, jerk, loads.as_ref(), grid)?;
        problem.solve(self.gap);
        let table = loads.as_ref().map(|l| l.table(&path, &problem.spline().grid, CHECKS)).transpose()?;
        for _ in 0..ROUNDS {
            let ratios = timed::ratios(&path, problem.spline(), limits, jerk, table.as_ref(), CHECKS);
            if timed::slowness(&ratios, is_viscous) <= SLOWNESS {
                break;
            }
            problem.tighten(&ratios);
            problem.solve(self.gap);
        }
        let mut x = problem.into_spline();
        let table = loads.map(|l| l.table(&path, &x.grid, LAST_CHECKS)).transpose()?;
        let mut slowed = 1.0;
        for _ in 0..STEPS {
            let ratios = timed::ratios(&path, &x, limits, jerk, table.as_ref(), LAST_CHECKS);
            let by = timed::slowness(&ratios, is_viscous);
            if by > 1.0 {
                let by = if is_viscous { by * BEYOND } else { by };
                x.slow(by);
                slowed *= by;
            }
            if by <= 1.0 || !is_viscous || !slowed.is_finite() {
                return timed::SmoothTimedPath::new(path, x, slowed);
            }
        }
        Err(MotionError::NoAnswer(Failure::Unsound))
    }
}
