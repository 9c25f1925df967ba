//! What torque limits leave of the motion along the path, at points of its intervals.
//!
//! A torque is a u + b x + k √x and what is needed at rest, c + f. The former, by what the limit leaves beside the latter, is
//! at most 1. Where a joint turns round within an interval Coulomb's friction f is met there in both directions.

use super::timed::{checked, point_of_path};
use super::{LAST_CHECKS, MotionError};
use crate::motion::path::{JointPath, PathPoint};
use crate::motion::timing::TorqueLimits;

/// a, b and k of something that is at most 1: a u + b x + k √x.
pub(super) type Row = [f64; 3];

/// An arm with torque limits on a path that is divided.
pub(super) struct Loads<'a> {
    limits: &'a TorqueLimits,
    /// The least and the greatest friction of each joint in each interval: entry `interval * dof + joint`.
    friction: Vec<[f64; 2]>,
}

/// The rows of all joints at so many points of each interval.
pub(super) struct Table {
    a_point: usize,
    rows: Vec<Row>,
}

impl<'a> Loads<'a> {
    /// # Errors
    /// If the arm cannot carry itself at a point within the limits, or a torque is not finite.
    pub(super) fn new<P: JointPath>(
        limits: &'a TorqueLimits,
        path: &P,
        grid: &[f64],
    ) -> Result<Self, MotionError> {
        let dof = limits.dof();
        let mut friction = vec![[f64::INFINITY, f64::NEG_INFINITY]; dof * (grid.len() - 1)];
        for (i, range) in friction.chunks_exact_mut(dof).enumerate() {
            for check in 0..LAST_CHECKS {
                let (place, side) = checked(check, LAST_CHECKS);
                let (s, PathPoint { q, dq, ddq, .. }) = point_of_path(path, grid, i, place, side);
                let torques = limits.along(&q, &dq, &ddq);
                limits.carried(s, &torques)?;
                for ([least, most], t) in range.iter_mut().zip(&torques) {
                    (*least, *most) = (least.min(t.f), most.max(t.f));
                }
            }
        }
        Ok(Loads { limits, friction })
    }

    /// Two rows a joint at a point of an interval, with derivatives by τ, and its parameter s.
    ///
    /// # Errors
    /// If the arm cannot carry itself there within the limits, or a torque is not finite.
    pub(super) fn rows(&self, interval: usize, s: f64, point: &PathPoint) -> Result<Vec<Row>, MotionError> {
        let torques = self.limits.along(&point.q, &point.dq, &point.ddq);
        self.limits.carried(s, &torques)?;
        let mut rows = Vec::with_capacity(2 * torques.len());
        for (joint, (t, range)) in torques.iter().zip(self.limits.ranges()).enumerate() {
            let [least, most] = self.friction[interval * torques.len() + joint];
            let (upper, lower) = (range.upper - t.c - most, range.lower - t.c - least);
            if upper <= 0.0 || lower >= 0.0 {
                return Err(MotionError::Torque { joint, s });
            }
            rows.extend([upper, lower].map(|left| [t.a, t.b, t.k].map(|part| part / left)));
        }
        Ok(rows)
    }

    /// The rows at `checks` points of each interval.
    ///
    /// # Errors
    /// As [`rows`](Self::rows).
    pub(super) fn table<P: JointPath>(
        &self,
        path: &P,
        grid: &[f64],
        checks: usize,
    ) -> Result<Table, MotionError> {
        let a_point = 2 * self.limits.dof();
        let mut rows = Vec::with_capacity(a_point * checks * (grid.len() - 1));
        for interval in 0..grid.len() - 1 {
            for check in 0..checks {
                let (place, side) = checked(check, checks);
                let (s, point) = point_of_path(path, grid, interval, place, side);
                rows.extend(self.rows(interval, s, &point)?);
            }
        }
        Ok(Table { a_point, rows })
    }
}

impl Table {
    /// How much of what is left the torques take at a point.
    pub(super) fn share(&self, point: usize, u: f64, x: f64) -> f64 {
        let rows = &self.rows[point * self.a_point..][..self.a_point];
        rows.iter().map(|[a, b, k]| a * u + b * x + k * x.sqrt()).fold(0.0, f64::max)
    }
}
