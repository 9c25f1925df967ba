//! Solutions by descent, for arms that no other method serves, and what other methods may leave aside.

use super::answer::{Answer, Doubt, Family, Obstacle, Solution};
use super::branch::Branch;
use super::dispatch::{InverseKinematics, TOLERANCE};
use super::newton;
use super::self_motion::{follow, is_self_motion};
use crate::geometry::Transform;
use crate::random::Random;

/// Descents that look for self-motions, and in vain for further solutions.
const DESCENTS: usize = 64;
/// Descents for one pose.
const MOST_DESCENTS: usize = 640;
/// A larger residual than this is left where Newton's method converges slowly.
const ROUGH: f64 = 1e-13;
/// Solutions this near to what it found then are what it was on the way to (radians, and lengths by the reach).
const BESIDE: f64 = 0.1;
impl InverseKinematics {
    /// By descent: a solution, or the nearest configuration.
    pub(super) fn search(&self, pose: &Transform<f64>, answer: &mut Answer) {
        let size = self.size(pose);
        let miss = |q: &[f64]| newton::distance(&self.robot, self.goal, pose, q, size);
        let mut outcome = self.numeric.solve(pose, self.seed.as_deref());
        if miss(&outcome.q) > TOLERANCE && outcome.beyond_reach.is_none() {
            let unlimited = self.unlimited.solve(pose, self.seed.as_deref());
            outcome =
                if miss(&unlimited.q) <= TOLERANCE { unlimited } else { self.numeric.nearest(pose, None) };
        }
        let residual = miss(&outcome.q);
        if residual <= TOLERANCE {
            let mut q = outcome.q;
            self.space.wrap(&mut q);
            let within_limits = self.space.within(&q);
            let (branch, guard) = (Branch::default(), 0.0);
            answer.doubt = Some(Doubt::Searched);
            answer.solutions.push(Solution { q, residual, branch, multiplicity: 1, within_limits, guard });
            return;
        }
        if outcome.beyond_reach.is_some() {
            // That there is none is proved.
            answer.doubt = None;
        }
        let (angle, distance) = newton::gap(&self.robot, self.goal, pose, &outcome.q);
        answer.obstacle = Some(Obstacle { unknown: None, q: outcome.q, angle, distance, violated: vec![] });
    }

    /// Further solutions by descents from configurations all over, the joints that are given at their values, until many one
    /// after the other find no other; one is enough where solutions are curves or more.
    pub(super) fn search_on(&self, pose: &Transform<f64>, given: &[f64], answer: &mut Answer) {
        let size = self.size(pose);
        let is_isolated = self.robot.joints - given.len() <= newton::rank(&self.robot, self.goal);
        let mut random = Random(1);
        let (mut tried, mut in_vain) = (0, 0);
        while tried < MOST_DESCENTS && in_vain < DESCENTS && (is_isolated || !answer.is_reachable()) {
            (tried, in_vain) = (tried + 1, in_vain + 1);
            let half = |j: usize| if self.space.is_angle[j] { self.space.half_range(j) } else { size };
            let mut start: Vec<f64> =
                (0..self.robot.joints).map(|j| (2.0 * random.unit() - 1.0) * half(j)).collect();
            self.given.iter().zip(given).for_each(|(&j, x)| start[j] = *x);
            let found = newton::descend(&self.robot, self.goal, pose, &start, &self.given, size);
            let Some((mut q, residual)) = found.filter(|f| f.1 <= TOLERANCE) else { continue };
            self.space.wrap(&mut q);
            // What converges slowly lies beside a solution where roots coincide, or is one of those.
            let near = if residual <= ROUGH { 0.0 } else { BESIDE };
            let is_known =
                |s: &Solution| self.space.is_same(&s.q, &q) || self.space.distance(&s.q, &q) <= near;
            if answer.solutions.iter().any(is_known) || answer.families.iter().any(|f| self.is_near(f, &q)) {
                continue;
            }
            in_vain = 0;
            let within_limits = self.space.within(&q);
            let (branch, guard) = (Branch::default(), 0.0);
            let new = Solution { q, residual, branch, multiplicity: 1, within_limits, guard };
            let is_curve = is_isolated
                && given.is_empty()
                && is_self_motion(&self.robot, &self.space, self.goal, &new.q).is_some();
            if is_curve {
                let motion = follow(&self.robot, &self.space, self.goal, pose, &new.q);
                answer.families.push(Family::followed(new, motion));
            } else {
                answer.solutions.push(new);
            }
        }
    }

    /// Self-motions that a parameter's samples miss, because it stays the same along them or nearly so: found by descent
    /// from configurations all over, and followed.
    pub(super) fn follow_more(&self, pose: &Transform<f64>, answer: &mut Answer) {
        let mut random = Random(1);
        let size = self.size(pose);
        let span = |j: usize| {
            let half = self.space.half_range(j);
            self.space.limits[j].unwrap_or(if self.space.is_angle[j] { [-half, half] } else { [0.0, size] })
        };
        let spans: Vec<[f64; 2]> = (0..self.robot.joints).map(span).collect();
        for _ in 0..DESCENTS {
            let seed: Vec<f64> = spans.iter().map(|[low, high]| low + random.unit() * (high - low)).collect();
            let outcome = self.numeric.solve(pose, Some(&seed));
            let residual = newton::distance(&self.robot, self.goal, pose, &outcome.q, size);
            let mut q = outcome.q;
            self.space.wrap(&mut q);
            if residual > TOLERANCE || answer.families.iter().any(|f| self.is_near(f, &q)) {
                continue;
            }
            let motion = follow(&self.robot, &self.space, self.goal, pose, &q);
            let within_limits = self.space.within(&q);
            let (branch, guard) = (Branch::default(), 0.0);
            let found = Solution { q, residual, branch, multiplicity: 1, within_limits, guard };
            answer.families.push(Family::followed(found, motion));
        }
    }
}
