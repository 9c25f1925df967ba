//! Torque limits along a path.
//!
//! With q̇ = q' ṡ and q̈ = q' u + q'' x the torques are a u + b x + c + f + k √x: a = A q', b = A q'' + C(q, q') q', c gravity,
//! f Coulomb's friction in the direction of q' (in both where that turns round within an interval), k = FV q'. Without viscous friction
//! a limit is a strip in u and x; with it the stages are [curved](super::curved).

use super::grid::Sampled;
use super::stage::{Strip, strip};
use crate::dynamics::{Dynamics, gravity_torques, inertia_matrix, inverse_dynamics};
use crate::motion::error::{MotionError, finite};
use crate::motion::limits::{Limits, Range};
use crate::motion::path::{JointPath, PathPoint, Side};

/// A joint that is slower than this part of the fastest turns round.
const TURN: f64 = 1e-9;

/// An arm with masses, and what its drives can do: N m, N for slides.
#[derive(Clone, PartialEq, Debug)]
pub struct TorqueLimits {
    arm: Dynamics<f64>,
    ranges: Vec<Range>,
}

/// Refuses limits that are not those of so many joints.
pub(in crate::motion) fn fitting(
    dof: usize,
    limits: &Limits,
    torques: Option<&TorqueLimits>,
) -> Result<(), MotionError> {
    let dofs = [Some(("limits", limits.dof())), torques.map(|t| ("torque limits", t.dof()))];
    match dofs.into_iter().flatten().find(|(_, found)| *found != dof) {
        Some((what, found)) => Err(MotionError::Joints { what, expected: dof, found }),
        None => Ok(()),
    }
}

/// The torque of a joint at a point of the path, a u + b x + c + f + k √x.
#[derive(Clone, Copy)]
pub(in crate::motion) struct Torque {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub f: f64,
    pub k: f64,
}

/// The torques at the grid points, approached from both sides: entry `i * dof + joint`.
pub(super) struct Torques<'a> {
    limits: &'a TorqueLimits,
    behind: Vec<Torque>,
    before: Vec<Torque>,
    /// The least and the greatest of Coulomb's friction within the intervals: entry `i * dof + joint`.
    friction: Vec<[f64; 2]>,
}

impl TorqueLimits {
    /// The same in both directions, one entry a joint.
    ///
    /// # Errors
    /// If a limit is not a positive finite number, or there is not one for each joint.
    pub fn symmetric(arm: Dynamics<f64>, torques: &[f64]) -> Result<Self, MotionError> {
        const WHAT: &str = "torque limits";
        finite(WHAT, torques)?;
        if torques.len() != arm.joints() {
            return Err(MotionError::Joints { what: WHAT, expected: arm.joints(), found: torques.len() });
        }
        match torques.iter().find(|t| **t <= 0.0) {
            Some(&wrong) => Err(MotionError::NotPositive(WHAT, wrong)),
            None => Ok(TorqueLimits { arm, ranges: torques.iter().map(|&t| Range::symmetric(t)).collect() }),
        }
    }

    /// How many joints have limits.
    pub fn dof(&self) -> usize {
        self.ranges.len()
    }

    /// What the drives can do, joint by joint.
    pub fn ranges(&self) -> &[Range] {
        &self.ranges
    }

    /// The arm that they move.
    pub fn arm(&self) -> &Dynamics<f64> {
        &self.arm
    }

    /// The torques along a path at a point of it, joint by joint.
    pub(in crate::motion) fn along(&self, q: &[f64], dq: &[f64], ddq: &[f64]) -> Vec<Torque> {
        let (arm, gravity) = (&self.arm, gravity_torques(&self.arm, q));
        // A q'' + C q' + Q + FV q'
        let all = inverse_dynamics(arm, q, dq, ddq, None);
        let pulled =
            inertia_matrix(arm, q).into_iter().map(|row| row.iter().zip(dq).map(|(m, d)| m * d).sum());
        pulled
            .enumerate()
            .map(|(j, a)| {
                let drive = arm.drives[j];
                let k = drive.viscous * dq[j];
                let rubbed = if dq[j] == 0.0 { 0.0 } else { drive.coulomb * dq[j].signum() };
                Torque { a, b: all[j] - gravity[j] - k, c: gravity[j], f: rubbed, k }
            })
            .collect()
    }

    /// Whether the arm stands still at the parameter `s` within the limits, Coulomb's friction against it.
    ///
    /// # Errors
    /// If not, or a torque is not finite.
    pub(in crate::motion) fn carried(&self, s: f64, torques: &[Torque]) -> Result<(), MotionError> {
        for (joint, (t, range)) in torques.iter().zip(&self.ranges).enumerate() {
            finite("torques along the path", &[t.a, t.b, t.c, t.f, t.k])?;
            if !(range.lower < t.c - t.f.abs() && t.c + t.f.abs() < range.upper) {
                return Err(MotionError::Torque { joint, s });
            }
        }
        Ok(())
    }

    /// Whether joints have Coulomb's friction, one by one.
    pub(super) fn rubbed(&self) -> Vec<bool> {
        self.arm.drives.iter().map(|d| d.coulomb != 0.0).collect()
    }

    /// Whether a joint has viscous friction.
    pub(crate) fn is_viscous(&self) -> bool {
        self.arm.drives.iter().any(|d| d.viscous != 0.0)
    }

    /// By how much torques exceed their limits at a point, as a part of what is left beside those at rest; 1 at the limit.
    pub(super) fn share(&self, torques: &[Torque], u: f64, x: f64) -> f64 {
        let of = |(t, range): (&Torque, &Range)| {
            let moving = t.a * u + t.b * x + t.k * x.sqrt();
            let resting = t.c + t.f;
            let left = if moving < 0.0 { range.lower - resting } else { range.upper - resting };
            if moving == 0.0 { 0.0 } else { moving / left }
        };
        torques.iter().zip(&self.ranges).map(of).fold(0.0, f64::max)
    }
}

impl<'a> Torques<'a> {
    /// The torques at the points of a grid.
    ///
    /// # Errors
    /// If the arm cannot carry itself at a point within the limits.
    pub fn new<P: JointPath>(
        limits: &'a TorqueLimits,
        path: &P,
        grid: &Sampled,
    ) -> Result<Self, MotionError> {
        let dof = grid.dof;
        let (mut behind, mut before) = (vec![], vec![]);
        let mut point = PathPoint::zeros(dof);
        for (i, &s) in grid.s.iter().enumerate() {
            path.eval_into(s, Side::Behind, &mut point);
            for (all, [dq, ddq, _]) in [(&mut behind, &grid.behind), (&mut before, &grid.before)] {
                let entries = i * dof..(i + 1) * dof;
                let torques = limits.along(&point.q, &dq[entries.clone()], &ddq[entries]);
                limits.carried(s, &torques)?;
                all.extend(torques);
            }
        }
        let mut friction = vec![];
        for (i, s) in grid.s.windows(2).enumerate() {
            let [first, last] = [&grid.behind[0][i * dof..], &grid.before[0][(i + 1) * dof..]];
            path.eval_into(f64::midpoint(s[0], s[1]), Side::Behind, &mut point);
            let greatest = point.dq.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
            for (joint, &middle) in point.dq.iter().enumerate() {
                // What hardly moves at a grid point turns round there.
                let signs = [first[joint], middle, last[joint]];
                let signs = signs.map(|d| if d.abs() <= TURN * greatest { 0.0 } else { d.signum() });
                let (drive, range) = (limits.arm.drives[joint], limits.ranges[joint]);
                let found = signs.into_iter().filter(|s| *s != 0.0).map(|s| s * drive.coulomb);
                let [least, most] = found
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], f| [least.min(f), most.max(f)]);
                let [least, most] = if least > most { [0.0; 2] } else { [least, most] };
                friction.push([least, most]);
                for t in [behind[i * dof + joint], before[(i + 1) * dof + joint]] {
                    if !(range.lower < t.c + least && t.c + most < range.upper) {
                        return Err(MotionError::Torque { joint, s: s[0] });
                    }
                }
            }
        }
        Ok(Torques { limits, behind, before, friction })
    }

    /// Whether there is a root in the torques.
    pub fn has_roots(&self) -> bool {
        self.behind.iter().chain(&self.before).any(|t| t.k != 0.0)
    }

    /// What the drives can do, joint by joint.
    pub fn ranges(&self) -> &[Range] {
        &self.limits.ranges
    }

    /// The torque of a joint at the start and at the end of interval `i`.
    pub fn ends(&self, i: usize, joint: usize) -> [Torque; 2] {
        let dof = self.limits.dof();
        [self.behind[i * dof + joint], self.before[(i + 1) * dof + joint]]
    }

    /// The least and the greatest friction of a joint within interval `i`, by Coulomb.
    pub fn friction(&self, i: usize, joint: usize) -> [f64; 2] {
        self.friction[i * self.limits.dof() + joint]
    }

    /// Two strips a joint for each end of interval `i`, the upper limit and the lower one, without viscous friction.
    pub fn strips(&self, i: usize, step: f64, reach: f64, flat: &mut f64, out: &mut Vec<Strip>) {
        for (joint, range) in self.limits.ranges.iter().enumerate() {
            let [start, end] = self.ends(i, joint);
            // Where the joint turns round, friction is met in both directions.
            let [f_least, f_most] = self.friction(i, joint);
            for (t, step) in [(start, 0.0), (end, step)] {
                let upper = Range { lower: f64::NEG_INFINITY, upper: range.upper - t.c - f_most };
                let lower = Range { lower: range.lower - t.c - f_least, upper: f64::INFINITY };
                for range in [upper, lower] {
                    // At the next point x is x + 2Δu: (a + 2Δb) u + b x.
                    out.push(strip(t.a + step * t.b, t.b, range, reach, flat));
                }
            }
        }
    }
}
