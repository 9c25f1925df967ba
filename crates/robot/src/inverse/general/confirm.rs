//! Whether elimination missed something where configurations coincide: descents from all over the arm lead nowhere else.
//!
//! Roots are counted with their noise. Where a joint stands at a quarter turn, entries vanish together, several
//! configurations share roots, and a count may be right of another polynomial. Such poses are rare, and people write them
//! down.

use super::solve::{GeneralSolver, ROUGH, SINGULAR, TOLERANCE};
use crate::geometry::Transform;
use crate::inverse::answer::{Answer, Doubt, Solution};
use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::random::Random;

/// How many descents.
const DESCENTS: usize = 48;
/// Beside solutions with a smallest singular value below this, others may nearly coincide; how many of them are left along
/// the motion that the hand hardly sees.
const BESIDE: f64 = 1e-3;
const ALONG: usize = 8;
/// A turn this near to a quarter turn is one.
const ALIKE: f64 = 1e-6;
/// A configuration further from all solutions than this is none of them: one that a descent reaches, and one near which it
/// converges slowly.
const APART: f64 = 1e-4;
const AROUND: f64 = 0.1;

impl GeneralSolver {
    /// Adds what descents find and a complete answer does not have, and takes back that it is complete.
    pub(super) fn confirm(&self, pose: &Transform<f64>, size: f64, answer: &mut Answer) {
        if !answer.is_complete() || !(self.is_geared() || self.is_faint() || self.is_special(answer)) {
            return;
        }
        let mut random = Random(1);
        let beside = answer.solutions.iter().filter(|s| s.guard < BESIDE).take(ALONG);
        let mut starts: Vec<Vec<f64>> = beside
            .flat_map(|s| newton::along_hidden(&self.robot, Goal::Pose, &s.q, &[], &self.space))
            .collect();
        starts.extend((0..DESCENTS).map(|_| self.space.anywhere(&mut random, size)));
        for start in starts {
            let found = newton::descend(&self.robot, Goal::Pose, pose, &start, &[], size);
            let Some((mut q, residual)) = found.filter(|f| f.1 <= TOLERANCE) else { continue };
            let guard = newton::least_seen(&self.robot, Goal::Pose, &q, &[], size);
            let is_slow = residual > ROUGH || guard < SINGULAR;
            let near = if is_slow { AROUND } else { APART };
            let is_known = answer.solutions.iter().any(|s| self.space.distance(&s.q, &q) <= near)
                || answer.families.iter().any(|f| self.is_on(pose, size, &f.curve, &q));
            if is_known {
                continue;
            }
            answer.doubt = Some(Doubt::Sampled);
            if !is_slow {
                self.space.wrap(&mut q);
                let within_limits = self.space.within(&q);
                answer.solutions.push(Solution { guard, ..Solution::found(q, residual, within_limits) });
            }
        }
        // Descents of such an arm crawl, and may all stop before a configuration that is missing.
        if self.is_faint() {
            answer.doubt = Some(Doubt::Sampled);
        }
    }

    /// Whether configurations are as hard to see everywhere as they are [beside](BESIDE) singular ones: of six axes that
    /// are nearly parallel, for one.
    fn is_faint(&self) -> bool {
        self.seen < BESIDE
    }

    /// True if a joint of a solution stands at a quarter turn, or the hand hardly sees some motion of the joints.
    fn is_special(&self, answer: &Answer) -> bool {
        let is_square = |s: &Solution| {
            let mut angles = s.q.iter().zip(&self.space.is_angle).filter(|(_, is_angle)| **is_angle);
            s.guard < BESIDE || angles.any(|(x, _)| (2.0 * x).sin().abs() < ALIKE)
        };
        !answer.families.is_empty() || answer.solutions.iter().any(is_square)
    }
}
