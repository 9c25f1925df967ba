//! Torque limits along a path.
//!
//! With q̇ = q' ṡ and q̈ = q' u + q'' x the torques are a u + b x + c + k √x: a = A q', b = A q'' + C(q, q') q', c gravity and
//! Coulomb's friction f in the direction of q' (in both where that turns round within an interval), k = FV q'. Of the root a tangent
//! x/2ρ + ρ/2 is taken, which is nowhere below it: the torques are then within the limits, too. The tangents are laid at the speeds that
//! are found, and the passes run again. With viscous friction the timing is fast, then, and not proved to be the fastest.

use super::grid::Sampled;
use super::stage::{Strip, strip};
use crate::dynamics::{Dynamics, gravity_torques, inertia_matrix, inverse_dynamics};
use crate::motion::error::{MotionError, finite};
use crate::motion::limits::{Limits, Range};
use crate::motion::path::{JointPath, PathPoint, Side};

/// The part of the margin at rest that the tangent's constant takes at most.
const MARGIN: f64 = 0.25;
/// Tangents are laid at no less than this part of the speed that the margin allows.
const LEAST: f64 = 1e-3;

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

/// The torques at the grid points, approached from both sides: entry `i * dof + joint`; and ρ.
pub(super) struct Torques<'a> {
    limits: &'a TorqueLimits,
    behind: Vec<Torque>,
    before: Vec<Torque>,
    /// Where the tangents are laid, a speed a grid point.
    at: Vec<f64>,
    /// The highest speeds there.
    highest: Vec<f64>,
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

    /// Whether a joint has viscous friction, which is bounded by tangents.
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
        highest: &[f64],
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
        let highest = highest.iter().map(|x| x.sqrt()).collect();
        let mut torques = Torques { limits, behind, before, at: vec![], highest };
        torques.at = torques.highest.clone();
        torques.hold_margin();
        Ok(torques)
    }

    /// Whether there is a root in the torques.
    pub fn has_roots(&self) -> bool {
        self.behind.iter().chain(&self.before).any(|t| t.k != 0.0)
    }

    /// Lays the tangents at the speeds that were found.
    pub fn lay(&mut self, x: &[f64]) {
        self.at = x.iter().map(|x| x.sqrt()).collect();
        self.hold_margin();
    }

    /// Tangents whose constants leave most of what is left at rest.
    fn hold_margin(&mut self) {
        let dof = self.limits.dof();
        for (i, at) in self.at.iter_mut().enumerate() {
            let mut most = self.highest[i];
            for (joint, range) in self.limits.ranges.iter().enumerate() {
                for t in [self.behind[i * dof + joint], self.before[i * dof + joint]] {
                    let left = if t.k < 0.0 { t.c - range.lower } else { range.upper - t.c } - t.f.abs();
                    if t.k != 0.0 {
                        most = most.min(2.0 * MARGIN * left / t.k.abs());
                    }
                }
            }
            *at = at.clamp(LEAST * most, most);
        }
    }

    /// Two strips a joint for each end of interval `i`: the upper limit and the lower one.
    pub fn strips(&self, i: usize, step: f64, reach: f64, flat: &mut f64, out: &mut Vec<Strip>) {
        let dof = self.limits.dof();
        for (joint, range) in self.limits.ranges.iter().enumerate() {
            let (start, end) = (self.behind[i * dof + joint], self.before[(i + 1) * dof + joint]);
            // Where the joint turns round, friction is met in both directions.
            let (f_most, f_least) = (start.f.max(end.f), start.f.min(end.f));
            for (t, at, step) in [(start, self.at[i], 0.0), (end, self.at[i + 1], step)] {
                for is_upper in [true, false] {
                    // Friction that helps is not counted on.
                    let against = if is_upper { t.k.max(0.0) } else { t.k.min(0.0) };
                    let (slope, constant) = if against == 0.0 || at == 0.0 {
                        (0.0, 0.0)
                    } else {
                        (against / (2.0 * at), against * at / 2.0)
                    };
                    let (b, c) = (t.b + slope, t.c + constant + if is_upper { f_most } else { f_least });
                    let range = match is_upper {
                        true => Range { lower: f64::NEG_INFINITY, upper: range.upper - c },
                        false => Range { lower: range.lower - c, upper: f64::INFINITY },
                    };
                    // At the next point x is x + 2Δu: (a + 2Δb) u + b x.
                    out.push(strip(t.a + step * b, b, range, reach, flat));
                }
            }
        }
    }
}
