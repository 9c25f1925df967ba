//! Solutions by descent, for arms that no other method serves, and what other methods may leave aside.

use super::answer::{Answer, Doubt, Obstacle, Solution};
use super::dispatch::{InverseKinematics, TOLERANCE};
use super::newton;
use super::self_motion::{follow, self_motion};
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
            answer.doubt = Some(Doubt::Searched);
            answer.solutions.push(Solution::found(q, residual, within_limits));
            return;
        }
        if outcome.beyond_reach.is_some() {
            // That there is none is proved.
            answer.doubt = None;
        }
        answer.obstacle = Some(self.obstacle(pose, outcome.q));
    }

    /// Further solutions as [`search_more`](Self::search_more) finds them; the nearest configuration that the joints that
    /// are given allow, if there are none.
    pub(super) fn search_held(&self, pose: &Transform<f64>, given: &[f64], answer: &mut Answer) {
        let nearest = self.search_more(pose, given, answer);
        if answer.is_reachable() {
            return;
        }
        if self.numeric.solve(pose, None).beyond_reach.is_some() {
            // No value of the joints reaches it.
            answer.doubt = None;
        }
        answer.obstacle = nearest.map(|q| self.obstacle(pose, q));
    }

    fn obstacle(&self, pose: &Transform<f64>, q: Vec<f64>) -> Obstacle {
        let (angle, distance) = newton::gap(&self.robot, self.goal, pose, &q);
        Obstacle { unknown: None, q, angle, distance, violated: vec![] }
    }

    /// Further solutions by descents from configurations all over, the joints that are given at their values, until many one
    /// after the other find no other; one is enough where solutions are curves or more. Answers the
    /// nearest configuration that any of the others came to.
    pub(super) fn search_more(
        &self,
        pose: &Transform<f64>,
        given: &[f64],
        answer: &mut Answer,
    ) -> Option<Vec<f64>> {
        let size = self.size(pose);
        let is_isolated = self.robot.joints - given.len() <= newton::rank(&self.robot, self.goal);
        let mut random = Random(1);
        let (mut tried, mut in_vain) = (0, 0);
        let mut nearest: Option<(Vec<f64>, f64)> = None;
        while tried < MOST_DESCENTS && in_vain < DESCENTS && (is_isolated || !answer.is_reachable()) {
            (tried, in_vain) = (tried + 1, in_vain + 1);
            let mut start = self.space.anywhere(&mut random, size);
            self.given.iter().zip(given).for_each(|(&j, x)| start[j] = *x);
            let found = newton::descend(&self.robot, self.goal, pose, &start, &self.given, size);
            let Some((mut q, residual)) = found else { continue };
            self.space.wrap(&mut q);
            if residual > TOLERANCE {
                if nearest.as_ref().is_none_or(|n| residual < n.1) {
                    nearest = Some((q, residual));
                }
                continue;
            }
            // What converges slowly lies beside a solution where roots coincide, or is one of those.
            let near = if residual <= ROUGH { 0.0 } else { BESIDE };
            let is_known =
                |s: &Solution| self.space.is_same(&s.q, &q) || self.space.distance(&s.q, &q) <= near;
            if answer.solutions.iter().any(is_known) || answer.families.iter().any(|f| self.is_near(f, &q)) {
                continue;
            }
            in_vain = 0;
            let within_limits = self.space.within(&q);
            let motion = if is_isolated && given.is_empty() {
                self_motion(&self.robot, &self.space, self.goal, pose, &q)
            } else {
                None
            };
            answer.doubt = Some(Doubt::Searched);
            answer.add(Solution::found(q, residual, within_limits), motion);
        }
        nearest.map(|n| n.0)
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
            answer.add(Solution::found(q, residual, within_limits), Some(motion));
        }
    }
}
