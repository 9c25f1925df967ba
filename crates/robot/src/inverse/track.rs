//! One pose after the other, at the rate of a controller: the configuration nearest to the last one.
//!
//! The least change of the joints that reaches the pose within the limits is found by Newton's method on the pose's
//! equations, each step the one that ends nearest to the last configuration (sequential quadratic programming: Nocedal and
//! Wright, *Numerical Optimization*, 2006, ch. 18): with r the way back to it and J the Jacobian, in the joints' units,
//!
//! d = r + Jᵀ(J Jᵀ)⁻¹(e − J r).
//!
//! A joint that d takes beyond a limit stays at the limit, and the others make up for it. What does not lead to a solution
//! nearby is left to the full solution.

use super::answer::Solution;
use super::dispatch::{InverseKinematics, Nearest};
use super::newton;
use super::numeric::add_product;
use crate::geometry::Transform;

/// Where a configuration came from that follows another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Course {
    /// Within the limits, and no joint moves by more than half a radian, or half the reach.
    Followed,
    /// Within the limits, but further away: the nearest of all that are known.
    Jumped,
    /// There is none within the limits, as far as is known: the nearest of all leaves them.
    BeyondLimits,
}

/// A configuration that follows another.
#[derive(Clone, PartialEq, Debug)]
pub struct Tracked {
    /// The joint variables, without jumps of whole turns where they were followed.
    pub q: Vec<f64>,
    /// What they miss the pose by (see [`Solution::residual`](super::Solution::residual)).
    pub residual: f64,
    /// The largest change of a joint, radians, and lengths by the reach.
    pub distance: f64,
    /// Joints (from 0) that are at a limit.
    pub at_limit: Vec<usize>,
    /// The smallest singular value of the Jacobian, lengths by the reach, or up to a third less. 0 where the goal is less
    /// than a pose, or fewer than six joints move.
    pub guard: f64,
    /// Where it came from.
    pub course: Course,
}

/// Steps of Newton's method; three or four are usual.
const STEPS: usize = 24;
/// A solution misses the pose by no more, and is nearest up to a step of this length.
const SOLVED: f64 = 1e-12;
const NEAREST: f64 = 1e-7;
/// What a step moves a joint by at most.
const LONGEST: f64 = 0.25;
/// Joints further away are not followed.
const NEARBY: f64 = 0.5;
/// What is added to the squares of the singular values: they are divided by.
const DAMPING: f64 = 1e-14;
/// What a joint may be beyond its limit for rounding, and how near it is at the limit.
const SLACK: f64 = 1e-9;

/// A symmetric matrix of the pose's six equations.
type Square = [[f64; 6]; 6];

impl InverseKinematics {
    /// The configuration for a pose that is nearest to the previous one, within the limits if one is; joints that are
    /// [given](Self::given) stay. Nothing where none was found: [`solve`](Self::solve) says why.
    ///
    /// A few steps of Newton's method where the pose is near to that of the previous configuration, and all that
    /// [`solve`](Self::solve) and [`nearest`](Self::nearest) take where they do not lead to it.
    ///
    /// # Panics
    /// If there is not one entry per joint.
    pub fn track(&self, pose: &Transform<f64>, previous: &[f64]) -> Option<Tracked> {
        assert_eq!(previous.len(), self.robot.joints, "one entry per joint");
        let pose = &newton::nearest_rigid(pose).0;
        self.followed(pose, previous).or_else(|| self.searched(pose, previous))
    }

    /// The solution next to a configuration, within the limits, if a few steps of Newton's method lead to one.
    pub(super) fn next(&self, pose: &Transform<f64>, from: &[f64]) -> Option<Solution> {
        let Tracked { mut q, residual, guard, .. } = self.followed(&newton::nearest_rigid(pose).0, from)?;
        self.space.wrap(&mut q);
        Some(Solution { guard, ..Solution::found(q, residual, true) })
    }

    /// By Newton's method from the previous configuration.
    fn followed(&self, pose: &Transform<f64>, previous: &[f64]) -> Option<Tracked> {
        let size = self.size(pose);
        let units: Vec<f64> =
            (0..previous.len()).map(|j| if self.space.is_angle[j] { 1.0 } else { size }).collect();
        let mut q: Vec<f64> = (0..previous.len()).map(|j| self.clamped(j, previous[j])).collect();
        if (0..q.len()).any(|j| (q[j] - previous[j]).abs() > NEARBY * units[j]) {
            return None;
        }
        for _ in 0..STEPS {
            let e = newton::error(self.goal, pose, &self.robot.pose(&q), size);
            let columns = newton::jacobian(&self.robot, self.goal, &q, &self.given, size);
            let back: Vec<f64> = (0..q.len()).map(|j| (previous[j] - q[j]) / units[j]).collect();
            let step = self.step(&columns, &e, &back, &q, &units)?;
            let longest = step.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let part = (LONGEST / longest).min(1.0);
            for j in 0..q.len() {
                q[j] += part * step[j] * units[j];
            }
            let missed = e.iter().map(|x| x * x).sum::<f64>().sqrt();
            if longest <= NEAREST && missed <= 1e-6 {
                break;
            }
        }
        for j in 0..q.len() {
            let limited = self.clamped(j, q[j]);
            if (limited - q[j]).abs() <= SLACK * units[j] {
                q[j] = limited;
            }
        }
        let tracked = self.tracked(pose, q, previous, Course::Followed);
        let is_within = (0..previous.len()).all(|j| self.clamped(j, tracked.q[j]) == tracked.q[j]);
        (tracked.residual <= SOLVED && tracked.distance <= NEARBY && is_within).then_some(tracked)
    }

    /// The nearest of all.
    fn searched(&self, pose: &Transform<f64>, previous: &[f64]) -> Option<Tracked> {
        let given: Vec<f64> = self.given.iter().map(|&j| previous[j]).collect();
        let answer = self.solve(pose, &given);
        let Nearest { q, within_limits, .. } = self.nearest(pose, &answer, previous)?;
        let mut tracked = self.tracked(pose, q, previous, Course::Jumped);
        tracked.course = match within_limits {
            false => Course::BeyondLimits,
            true if tracked.distance <= NEARBY => Course::Followed,
            true => Course::Jumped,
        };
        Some(tracked)
    }

    fn tracked(&self, pose: &Transform<f64>, q: Vec<f64>, previous: &[f64], course: Course) -> Tracked {
        let at_limit = |j: &usize| {
            let beside = [-SLACK, SLACK].map(|by| q[*j] + by * self.space.unit(*j));
            beside.iter().any(|&x| self.clamped(*j, x) != x)
        };
        let away = |j: usize| (q[j] - previous[j]).abs() / self.space.unit(j);
        Tracked {
            residual: newton::distance(&self.robot, self.goal, pose, &q, self.size(pose)),
            distance: (0..q.len()).map(away).fold(0.0, f64::max),
            at_limit: (0..q.len()).filter(at_limit).collect(),
            guard: self.guard(&q),
            q,
            course,
        }
    }

    /// The value of a joint that the limits allow, next to another.
    fn clamped(&self, joint: usize, x: f64) -> f64 {
        self.space.limits[joint].map_or(x, |[low, high]| x.max(low).min(high))
    }

    /// d, in the joints' units.
    fn step(
        &self,
        columns: &[[f64; 6]],
        e: &[f64; 6],
        back: &[f64],
        q: &[f64],
        units: &[f64],
    ) -> Option<Vec<f64>> {
        let n = q.len();
        let mut held: Vec<Option<f64>> = (0..n).map(|j| self.given.contains(&j).then_some(0.0)).collect();
        loop {
            // e − J r, where a joint that is held goes to its limit instead.
            let way = |j: usize| held[j].unwrap_or(back[j]);
            let mut rest = *e;
            let mut square = [[0.0; 6]; 6];
            for (j, c) in columns.iter().enumerate() {
                let by = way(j);
                for i in 0..6 {
                    rest[i] -= c[i] * by;
                }
                if held[j].is_none() {
                    add_product(&mut square, c);
                }
            }
            (0..6).for_each(|i| square[i][i] += DAMPING);
            let lambda = solved(&factored(&square)?, rest);
            let moved = |j: usize| match held[j] {
                Some(d) => d,
                None => back[j] + (0..6).map(|i| columns[j][i] * lambda[i]).sum::<f64>(),
            };
            let d: Vec<f64> = (0..n).map(moved).collect();
            // The joint that goes furthest beyond its limit stays there.
            let beyond = |j: usize| {
                let x = q[j] + d[j] * units[j];
                (self.clamped(j, x) - x).abs() / units[j]
            };
            let worst =
                (0..n).filter(|&j| held[j].is_none()).max_by(|&a, &b| beyond(a).total_cmp(&beyond(b)));
            match worst.filter(|&j| beyond(j) > 0.0) {
                None => return Some(d),
                Some(j) => held[j] = Some((self.clamped(j, q[j] + d[j] * units[j]) - q[j]) / units[j]),
            }
        }
    }

    /// 1/√‖(J Jᵀ)⁻¹‖, by Frobenius' norm.
    fn guard(&self, q: &[f64]) -> f64 {
        let columns = newton::jacobian(&self.robot, self.goal, q, &self.given, self.space.length());
        let mut square = [[0.0; 6]; 6];
        columns.iter().for_each(|c| add_product(&mut square, c));
        let Some(factor) = factored(&square) else { return 0.0 };
        let unit = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let norm: f64 = (0..6).flat_map(|k| solved(&factor, unit(k))).map(|x| x * x).sum();
        let guard = norm.sqrt().sqrt().recip();
        if guard.is_finite() { guard } else { 0.0 }
    }
}

/// Cholesky's factor of a symmetric matrix given by its lower half; nothing if it is not positive definite.
fn factored(square: &Square) -> Option<Square> {
    let mut l = [[0.0; 6]; 6];
    for i in 0..6 {
        for k in 0..=i {
            let rest = square[i][k] - (0..k).map(|m| l[i][m] * l[k][m]).sum::<f64>();
            if i == k {
                if rest.is_nan() || rest <= 0.0 {
                    return None;
                }
                l[i][i] = rest.sqrt();
            } else {
                l[i][k] = rest / l[k][k];
            }
        }
    }
    Some(l)
}

/// x with L Lᵀ x = b.
fn solved(l: &Square, b: [f64; 6]) -> [f64; 6] {
    let mut x = b;
    for i in 0..6 {
        x[i] = (x[i] - (0..i).map(|k| l[i][k] * x[k]).sum::<f64>()) / l[i][i];
    }
    for i in (0..6).rev() {
        x[i] = (x[i] - (i + 1..6).map(|k| l[k][i] * x[k]).sum::<f64>()) / l[i][i];
    }
    x
}
