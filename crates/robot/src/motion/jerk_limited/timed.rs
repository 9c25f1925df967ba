//! A path with a timing of which the acceleration is continuous.

use super::spline::Spline;
use super::torques::Table;
use super::warped::{chain, warp};
use crate::motion::error::MotionError;
use crate::motion::limits::Limits;
use crate::motion::path::{JointPath, PathPoint, Side};
use crate::motion::trajectory::{JointState, Trajectory};

/// Gauss points of an interval, and their weights.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 64.0 / 225.0),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// A path and its timing from rest to rest, twice continuously differentiable.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothTimedPath<P> {
    path: P,
    x: Spline,
    time: Vec<f64>,
    slowed: f64,
}

impl<P: JointPath> SmoothTimedPath<P> {
    /// The motion of the spline, which was slowed down by a factor.
    pub(super) fn new(path: P, x: Spline, slowed: f64) -> Result<Self, MotionError> {
        if !slowed.is_finite() {
            return Err(MotionError::Stuck { s: 0.0 });
        }
        let mut timed = Self { path, x, time: vec![], slowed };
        let mut t = 0.0;
        timed.time.push(t);
        for i in 0..timed.x.grid.len() - 1 {
            t += timed.spent(i, 1.0);
            timed.time.push(t);
        }
        Ok(timed)
    }

    /// The path.
    pub fn path(&self) -> &P {
        &self.path
    }

    /// The factor by which the optimum on the grid was slowed down to hold the limits between its points: 1 or little
    /// more.
    pub fn slowed(&self) -> f64 {
        self.slowed
    }

    /// The jerk at the time `t`, one entry a joint (rad/s³ or m/s³); where it jumps, the one behind.
    pub fn jerk(&self, t: f64) -> Vec<f64> {
        let (i, place) = self.locate(t);
        let (point, [x, u, du]) = point(&self.path, &self.x, i, place, Side::Behind);
        jerk_of(&point, x, u, du).collect()
    }

    /// The time from the start of interval `i` to a place in it: ∫ dτ / √x.
    fn spent(&self, i: usize, place: f64) -> f64 {
        let h = self.x.grid[i + 1] - self.x.grid[i];
        let sum: f64 = GAUSS.iter().map(|(at, w)| w / self.x.at(i, at * place)[0].sqrt()).sum();
        sum * h * place
    }

    /// The interval and the place in it at the time `t`, held within the duration.
    fn locate(&self, t: f64) -> (usize, f64) {
        let n = self.time.len() - 1;
        let t = t.clamp(0.0, self.time[n]);
        let i = self.time[1..n].partition_point(|time| *time <= t);
        let (h, target) = (self.x.grid[i + 1] - self.x.grid[i], t - self.time[i]);
        let mut place = target / (self.time[i + 1] - self.time[i]);
        // Newton's method: the integrand is nearly constant.
        for _ in 0..20 {
            let off = self.spent(i, place) - target;
            let next = (place - off * self.x.at(i, place)[0].sqrt() / h).clamp(0.0, 1.0);
            let change = (next - place).abs();
            place = next;
            if change < 1e-15 {
                break;
            }
        }
        (i, place)
    }
}

/// The point of the path, derivatives by τ, and x, u, u' there.
fn point<P: JointPath>(path: &P, x: &Spline, i: usize, place: f64, side: Side) -> (PathPoint, [f64; 3]) {
    (point_of_path(path, &x.grid, i, place, side).1, x.at(i, place))
}

/// The parameter s at a place of interval `i`, and the point of the path there, with derivatives by τ.
pub(super) fn point_of_path<P: JointPath>(
    path: &P,
    grid: &[f64],
    i: usize,
    place: f64,
    side: Side,
) -> (f64, PathPoint) {
    let warped = warp(grid[i] + place * (grid[i + 1] - grid[i]));
    let s = warped[0] * path.end();
    // Rounding must not carry a grid point on a knot over to the wrong side.
    let knots = path.knots();
    let next = knots.partition_point(|k| *k < s - 1e-13 * path.end());
    let s = knots.get(next).copied().filter(|k| (k - s).abs() <= 1e-13 * path.end()).unwrap_or(s);
    let mut point = PathPoint::zeros(path.dof());
    path.eval_into(s, side, &mut point);
    chain(&mut point, warped, path.end());
    (s, point)
}

/// The place of one of so many points in an interval, and the side from which the path is looked at there.
pub(super) fn checked(check: usize, checks: usize) -> (f64, Side) {
    let side = if check + 1 == checks { Side::Before } else { Side::Behind };
    (check as f64 / (checks - 1) as f64, side)
}

/// The greatest ratios of velocity, acceleration, jerk and torque to their limits in each interval, by so many points of
/// it; the torque without what is needed at rest to what is left beside that.
pub(super) fn ratios<P: JointPath>(
    path: &P,
    x: &Spline,
    limits: &Limits,
    jerk: &[f64],
    table: Option<&Table>,
    checks: usize,
) -> Vec<[f64; 4]> {
    let ratio = |i: usize, check: usize| {
        let (place, side) = checked(check, checks);
        let (point, [x, u, du]) = point(path, x, i, place, side);
        let torque = table.map_or(0.0, |t| t.share(i * checks + check, u, x));
        let mut most = [0.0, 0.0, 0.0, torque];
        for (joint, third) in jerk_of(&point, x, u, du).enumerate() {
            let v = limits.velocity()[joint].share(point.dq[joint] * x.sqrt());
            let a = limits.acceleration()[joint].share(point.dq[joint] * u + point.ddq[joint] * x);
            let j = third.abs() / jerk[joint];
            most = [f64::max(most[0], v), f64::max(most[1], a), f64::max(most[2], j), torque];
        }
        most
    };
    (0..x.grid.len() - 1)
        .map(|i| {
            let checked: Vec<[f64; 4]> = (0..checks).map(|check| ratio(i, check)).collect();
            std::array::from_fn(|k| peak(&checked.iter().map(|r| r[k]).collect::<Vec<_>>()))
        })
        .collect()
}

/// The greatest value, and what parabolas through three neighbours rise above the middle one.
fn peak(values: &[f64]) -> f64 {
    let greatest = values.iter().copied().fold(0.0, f64::max);
    let rise = |w: &[f64]| w[1] + (2.0 * w[1] - w[0] - w[2]).max(0.0) / 8.0;
    values.windows(3).map(rise).fold(greatest, f64::max)
}

/// By how much a motion must be slowed down for no ratio to be above 1: enough for all but torques of which a part grows
/// with the speed, where it is a step on the way.
pub(super) fn slowness(ratios: &[[f64; 4]], is_viscous: bool) -> f64 {
    let torque = |t: f64| if is_viscous { t } else { t.sqrt() };
    ratios.iter().map(|[v, a, j, t]| v.max(a.sqrt()).max(j.cbrt()).max(torque(*t))).fold(1.0, f64::max)
}

/// (p' u' + 3 p'' u + p''' x) √x
fn jerk_of(point: &PathPoint, x: f64, u: f64, du: f64) -> impl Iterator<Item = f64> + '_ {
    let derivatives = point.dq.iter().zip(&point.ddq).zip(&point.dddq);
    derivatives.map(move |((p1, p2), p3)| (p1 * du + 3.0 * p2 * u + p3 * x) * x.sqrt())
}

impl<P: JointPath> Trajectory for SmoothTimedPath<P> {
    fn dof(&self) -> usize {
        self.path.dof()
    }

    fn duration(&self) -> f64 {
        self.time[self.time.len() - 1]
    }

    fn eval(&self, t: f64) -> JointState {
        let (i, place) = self.locate(t);
        let (PathPoint { q, dq, ddq, .. }, [x, u, _]) = point(&self.path, &self.x, i, place, Side::Behind);
        let qdd = dq.iter().zip(&ddq).map(|(p1, p2)| p1 * u + p2 * x).collect();
        JointState { q, qd: dq.iter().map(|p1| p1 * x.sqrt()).collect(), qdd }
    }
}
