//! Whether an answer at a singular pose has everything: descents from all over the arm lead nowhere else.
//!
//! Where equations leave unknowns open, or nearly so, solutions come from values that were tried. A descent knows nothing of
//! branches; what it finds beside the answer is added, and the answer may then not be complete.

use super::solve::{ROUGH, Solving};
use crate::geometry::Transform;
use crate::inverse::answer::{Answer, Doubt, Solution};
use crate::inverse::newton;
use crate::inverse::self_motion::{Frame, self_motion};
use crate::space::norm;
use denavit_program::solver::TOLERANCE;

/// How many descents.
const DESCENTS: usize = 48;
/// A descent that misses by no more than this is on its way to a solution, if there is one.
const VALLEY: f64 = 1e-6;
/// How many branches are left for a solution nearby.
const BRANCHES: usize = 16;
/// A larger residual than this is left where Newton's method does not find a root.
const BLURRED: f64 = 1e-11;
/// How many solutions are left along the motion that the hand hardly sees.
const ALONG: usize = 8;
/// Solutions this near to each other (radians, and lengths by the reach) with a solution between them are one.
const NEXT: f64 = 0.02;
/// Configurations that are further from all solutions than this (radians, and lengths by the reach) are none of them.
const AROUND: f64 = 0.1;
/// The smallest singular value of a regular configuration.
const REGULAR: f64 = 1e-3;

impl Solving<'_> {
    /// Adds what descents find and the answer does not have; `branches` are all that there are, however far from the pose.
    pub(super) fn confirm(
        &mut self,
        pose: &Transform<f64>,
        (variables, given): (&[f64], &[f64]),
        branches: &[Solution],
        answer: &mut Answer,
    ) {
        let size = self.size(pose);
        let mut starts = self.along(&answer.solutions);
        starts.extend(branches.iter().take(BRANCHES).map(|s| s.q.clone()));
        starts.extend(self.anywhere(pose, variables, DESCENTS));
        for start in starts {
            let found = newton::descend(&self.robot, self.goal, pose, &start, &self.given, size);
            let Some((mut q, residual)) = found.filter(|f| f.1 <= VALLEY.max(self.tolerance)) else {
                continue;
            };
            // What converges slowly lies between two roots that nearly coincide, and is none, or beside one that no number
            // is near enough to; of an arm with few joints that misses the pose a little, as it may, a regular configuration
            // is as near as it comes.
            let is_slow = residual > ROUGH && !self.is_regular(&q);
            self.space.wrap(&mut q);
            let is_beside = |s: &Solution| self.space.distance(&s.q, &q) <= AROUND;
            if residual > self.tolerance {
                // In a valley in which the hand hardly moves there may be solutions that no descent comes to.
                if is_slow && answer.is_reachable() && !answer.solutions.iter().any(is_beside) {
                    answer.doubt = Some(Doubt::Sampled);
                }
                continue;
            }
            if is_slow && answer.solutions.iter().any(is_beside) || self.is_known(pose, given, answer, &q) {
                continue;
            }
            answer.doubt = Some(Doubt::Sampled);
            // Within rounding of the pose, with no solution near, it stands for those that are there.
            if is_slow && residual > BLURRED {
                continue;
            }
            let within_limits = self.space.within(&q);
            let motion = if self.given.is_empty() && !is_slow {
                self_motion(&self.robot, &self.space, self.goal, pose, &q)
            } else {
                None
            };
            answer.add(Solution::found(q, residual, within_limits), motion);
        }
    }

    /// True if a solution is known to few digits only, where others may be as near to solving the pose.
    pub(super) fn is_blurred(&self, s: &Solution) -> bool {
        s.residual > BLURRED && self.tolerance <= TOLERANCE && self.is_beside(&s.q)
    }

    /// Configurations along the motion that the hand hardly sees, from solutions where there is one.
    fn along(&self, solutions: &[Solution]) -> Vec<Vec<f64>> {
        let mut starts = vec![];
        for s in solutions.iter().filter(|s| s.residual > ROUGH || self.is_beside(&s.q)).take(ALONG) {
            starts.extend(newton::along_hidden(&self.robot, self.goal, &s.q, &self.given, &self.space));
        }
        starts
    }

    /// True if the hand sees every joint move.
    fn is_regular(&self, q: &[f64]) -> bool {
        let frame = Frame {
            robot: &self.robot,
            goal: self.goal,
            is_angle: &self.space.is_angle,
            size: self.space.length(),
        };
        frame.singular(q).values.last().is_some_and(|least| *least > REGULAR)
    }

    /// True if a configuration is a solution of the answer, or a member of one of its families.
    fn is_known(&mut self, pose: &Transform<f64>, given: &[f64], answer: &Answer, q: &[f64]) -> bool {
        let space = &self.solver.space;
        let size = self.size(pose);
        let is_between = |a: &[f64]| {
            let middle: Vec<f64> = a.iter().zip(space.moved(a, q)).map(|(x, d)| x + d / 2.0).collect();
            newton::distance(&self.robot, self.goal, pose, &middle, size) <= ROUGH
        };
        let is_one = |s: &Solution| {
            let away = space.distance(&s.q, q);
            away <= 1e-5 || away <= NEXT && is_between(&s.q)
        };
        let all = answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative));
        if all.into_iter().any(is_one) || self.is_in_a_family(pose, given, &answer.families, q) {
            return true;
        }
        // A family that was followed, or one that has further parameters: the way along it to the nearest member.
        let way = |p: &[f64]| space.moved(p, q);
        answer.families.iter().any(|f| {
            let away = |p: &&Vec<f64>| norm(&space.way(p, q));
            let nearest = f.curve.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            let from = nearest.unwrap_or(&f.representative.q);
            let slid = newton::slide(&self.robot, self.goal, pose, from, (&self.given, way), size);
            space.distance(&slid, q) <= 1e-4
        })
    }
}
