//! Members along a family of solutions, in order: the arm as it moves with its hand still.

use super::answer::{Answer, Doubt, Family, Solution};
use super::dispatch::{InverseKinematics, TOLERANCE};
use super::newton;
use super::self_motion::follow_loosely;
use crate::geometry::Transform;
use crate::space::JointSpace;
use std::f64::consts::TAU;

/// The most members.
pub const MAX_MEMBERS: usize = 400;
/// Steps of a whole turn: of 5°.
const STEPS: i32 = 72;
/// A joint stands still whose part of a unit vector is less.
const STILL: f64 = 1e-9;

/// Members of a family, in order.
#[derive(Clone, PartialEq, Debug)]
pub struct Members {
    /// Configurations (radians and metres, one entry a joint), neighbours next to each other and without jumps of whole
    /// turns; the first again at the end, but for whole turns, if the self-motion is closed. At least one.
    pub members: Vec<Vec<f64>>,
    /// Whether the arm comes back to where it was.
    pub is_closed: bool,
}

/// A configuration this near to a solution is told of as that one (radians, and lengths by the reach).
const NEAR: f64 = 1e-3;

impl InverseKinematics {
    /// Adds a configuration that is known to have the pose to an answer that lacks it, which is then not complete.
    ///
    /// # Panics
    /// If there is not one entry per joint.
    pub fn include(&self, pose: &Transform<f64>, answer: &mut Answer, q: &[f64]) {
        assert_eq!(q.len(), self.robot.joints, "one entry per joint");
        let residual = newton::distance(&self.robot, self.goal, pose, q, self.size(pose));
        let mut all = answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative));
        let is_listed = all.any(|s| self.space.distance(&s.q, q) <= NEAR || self.space.is_listed_as(q, &s.q));
        if !residual.is_finite()
            || residual > TOLERANCE
            || is_listed
            || self.family_of(pose, answer, q).is_some()
        {
            return;
        }
        if self.nearest(pose, answer, q).is_some_and(|n| n.distance <= NEAR) {
            return;
        }
        let mut own = q.to_vec();
        self.space.wrap(&mut own);
        let within_limits = self.space.within(&own);
        answer.add(Solution::found(own, residual, within_limits), None);
        (answer.doubt, answer.obstacle) = (answer.doubt.or(Some(Doubt::Sampled)), None);
    }

    /// The members of a family that [`solve`](Self::solve) found for a pose, [`MAX_MEMBERS`] at most, whatever the limits
    /// of joints that turn. A family with several parameters is its representative alone.
    pub fn members(&self, pose: &Transform<f64>, family: &Family) -> Members {
        let start = &family.representative.q;
        if family.dimension != 1 {
            return Members { members: vec![start.clone()], is_closed: false };
        }
        let pose = &newton::nearest_rigid(pose).0;
        if !family.curve.is_empty() {
            return self.thinned(family.curve.clone());
        }
        if family.is_affine {
            return self.along(pose, family);
        }
        let held: Vec<(usize, f64)> = self.given.iter().map(|&j| (j, start[j])).collect();
        let (robot, space) = (self.robot.held(&held), self.space.held(&self.given));
        let is_free = |j: &usize| !self.given.contains(j);
        let free: Vec<usize> = (0..start.len()).filter(is_free).collect();
        let own: Vec<f64> = free.iter().map(|&j| start[j]).collect();
        let curve = follow_loosely((&robot, &space, self.goal), pose, &own, TOLERANCE).curve;
        let whole = |q: Vec<f64>| {
            let mut all = start.clone();
            free.iter().zip(q).for_each(|(&j, x)| all[j] = x);
            all
        };
        self.thinned(curve.into_iter().map(whole).collect())
    }

    /// A curve with as many members as are allowed, its ends among them.
    fn thinned(&self, mut members: Vec<Vec<f64>>) -> Members {
        let last = members.len() - 1;
        // What is shorter than a triangle does not come back.
        let is_closed = last > 2 && self.space.is_same(&members[0], &members[last]);
        if last >= MAX_MEMBERS {
            let kept = (0..MAX_MEMBERS).map(|k| k * last / (MAX_MEMBERS - 1));
            members = kept.map(|k| members[k].clone()).collect();
        }
        Members { members, is_closed }
    }

    /// Along a straight line through the representative: a whole turn of the joint that turns most, and back as far if the
    /// arm is not where it was then.
    fn along(&self, pose: &Transform<f64>, family: &Family) -> Members {
        let start = &family.representative.q;
        let direction = scaled(&self.space, &family.direction);
        let at = |k: i32| -> Vec<f64> {
            let part = f64::from(k) / f64::from(STEPS);
            start.iter().zip(&direction).map(|(x, d)| x + part * d).collect()
        };
        let size = self.size(pose);
        // A member may miss the pose as a solution may, or as the one does that stands for the family.
        let tolerance = TOLERANCE.max(2.0 * family.representative.residual);
        let holds = |q: &Vec<f64>| {
            newton::distance(&self.robot, self.goal, pose, q, size) <= tolerance
                && (0..q.len()).all(|j| direction[j] == 0.0 || self.is_on_slide(j, q[j]))
        };
        let mut members: Vec<Vec<f64>> = (1..=STEPS).map(at).take_while(holds).collect();
        let is_round = members.len() == STEPS as usize && self.space.is_same(start, &at(STEPS));
        if !is_round {
            let back: Vec<Vec<f64>> = (1..=STEPS).map(|k| at(-k)).take_while(holds).collect();
            members = back.into_iter().rev().chain([start.clone()]).chain(members).collect();
        } else {
            members.insert(0, start.clone());
        }
        self.thinned(members)
    }

    /// True if a joint turns, or slides to a place within its limits, or where there are none within twice the reach.
    fn is_on_slide(&self, joint: usize, x: f64) -> bool {
        let far = 2.0 * self.space.reach;
        let [low, high] = self.space.limits[joint].unwrap_or([-far, far]);
        self.space.is_angle[joint] || (low..=high).contains(&x)
    }
}

/// A direction so long that the joint that turns most makes a whole turn; if none turns, that the slide that goes furthest
/// goes as far as twice the reach.
fn scaled(space: &JointSpace, direction: &[f64]) -> Vec<f64> {
    let most = |is_angle: bool| {
        let own = direction.iter().zip(&space.is_angle).filter(|p| *p.1 == is_angle);
        own.fold(0.0_f64, |m, p| m.max(p.0.abs()))
    };
    let (turn, slide) = (most(true), most(false));
    let by = if turn > STILL { TAU / turn } else { 2.0 * space.reach / slide.max(STILL) };
    direction.iter().map(|d| d * by).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::space::Periods;

    #[test]
    fn directions_are_scaled_to_a_turn() {
        let space = {
            let is_angle = vec![true, true, false];
            let turning = Periods::whole_turns(is_angle.iter().copied());
            JointSpace { is_angle, limits: vec![None; 3], reach: 2.0, foot: Vector([0.0; 3]), turning }
        };
        let d = scaled(&space, &[0.6, -0.6, 0.0]);
        assert!((d[0] - TAU).abs() < 1e-12 && (d[1] + TAU).abs() < 1e-12 && d[2] == 0.0);
        assert_eq!(scaled(&space, &[0.0, 0.0, -0.5]), [0.0, 0.0, -4.0]);
        assert_eq!(scaled(&space, &[0.0; 3]), [0.0; 3]);
    }
}
