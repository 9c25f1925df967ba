//! All configurations with the first or the last joint at a value, by elimination.
//!
//! Turning the first joint moves everything behind it as a whole: with that joint held at 0 the remaining six joints are
//! the same arm for all its values, and only the pose is moved. So one elimination is prepared and serves all values.

use crate::geometry::Transform;
use crate::inverse::general::GeneralSolver;
use crate::mechanism::{Link, Robot};
use crate::space::JointSpace;

/// Values at which the ends are compared.
const VALUES: usize = 9;

/// The joint that is held, and the rest of the arm.
#[derive(Clone, Debug)]
pub(super) struct Locked {
    /// The joint's number.
    pub joint: usize,
    is_first: bool,
    /// What stands before and behind the joint's own transform, up to the base or the tool.
    outer: Transform<f64>,
    link: Link<f64>,
    joints: usize,
    rest: GeneralSolver,
}

impl Locked {
    /// With the first or the last joint held, whichever leaves more configurations at a sample pose; nothing if
    /// elimination serves neither.
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Option<Self> {
        let n = robot.joints;
        let mut ends: Vec<Locked> =
            [true, false].iter().filter_map(|&is_first| Locked::at_end(robot, space, is_first)).collect();
        let q: Vec<f64> = (0..n).map(|j| middle(space, j) + 0.3 + 0.1 * j as f64).collect();
        let pose = robot.pose(&q);
        let score = |end: &Locked| -> usize {
            let [low, high] = end.span(space);
            let value = |k: usize| low + (high - low) * (k as f64 + 0.5) / VALUES as f64;
            (0..VALUES).map(|k| end.configurations(&pose, value(k)).0.len()).sum()
        };
        let scores: Vec<usize> = ends.iter().map(score).collect();
        let best = (0..ends.len()).max_by_key(|&k| (scores[k], k))?;
        Some(ends.swap_remove(best))
    }

    fn at_end(robot: &Robot<f64>, space: &JointSpace, is_first: bool) -> Option<Self> {
        let joint = if is_first { 0 } else { robot.joints - 1 };
        let uses = |l: &Link<f64>| l.movers().any(|m| m.joint == joint);
        let count = robot.links.len();
        let place = if is_first {
            robot.links.iter().position(Link::moves)?
        } else {
            robot.links.iter().rposition(Link::moves)?
        };
        let link = robot.links[place].clone();
        let is_alone = robot.links.iter().filter(|l| uses(l)).count() == 1
            && link.movers().all(|m| m.joint == joint)
            && uses(&link);
        if !is_alone {
            return None;
        }
        let still = vec![0.0; robot.joints];
        let product = |links: &[Link<f64>]| {
            links.iter().fold(Transform::identity(), |x: Transform<f64>, l| x * l.transform(&still))
        };
        let outer = if is_first {
            robot.base * product(&robot.links[..place])
        } else {
            product(&robot.links[place + 1..count]) * robot.tool
        };
        let rest = GeneralSolver::quick(&robot.held(&[(joint, 0.0)]), &space.held(&[joint])).ok()?;
        Some(Locked { joint, is_first, outer, link, joints: robot.joints, rest })
    }

    /// The values that the joint is given.
    pub fn span(&self, space: &JointSpace) -> [f64; 2] {
        let far = space.half_range(self.joint);
        space.limits[self.joint].unwrap_or([-far, far])
    }

    /// All configurations with the joint at a value, and whether they are all.
    pub fn configurations(&self, pose: &Transform<f64>, value: f64) -> (Vec<Vec<f64>>, bool) {
        let at = |x: f64| {
            let mut q = vec![0.0; self.joints];
            q[self.joint] = x;
            let own = self.link.transform(&q);
            if self.is_first { self.outer * own } else { own * self.outer }
        };
        let moved = if self.is_first {
            at(0.0) * at(value).inverse() * *pose
        } else {
            *pose * at(value).inverse() * at(0.0)
        };
        let answer = self.rest.solve(&moved);
        let whole = |rest: &Vec<f64>| {
            let mut q = rest.clone();
            q.insert(self.joint, value);
            q
        };
        (answer.solutions.iter().map(|s| whole(&s.q)).collect(), answer.doubt.is_none())
    }
}

fn middle(space: &JointSpace, joint: usize) -> f64 {
    space.limits[joint].map_or(0.0, |[low, high]| (low + high) / 2.0)
}
