//! All solutions of a pose by elimination, as solutions of the robot.

use super::arm::{SixAxes, Unsuited, rigid};
use super::geared::{Found, Geared};
use crate::geometry::Transform;
use crate::inverse::answer::{Answer, Doubt, Family, Solution};
use crate::inverse::branch::Branch;
use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::inverse::self_motion::{SelfMotion, follow, is_self_motion};
use crate::mechanism::Robot;
use crate::shared::Shared;
use crate::space::JointSpace;
use denavit_elimination::{self as elimination, Arm, Certificate, Plan, Unsuitable};

/// Finds the solutions of poses for any robot with six joints.
#[derive(Clone, Debug)]
pub struct GeneralSolver {
    /// The robot that is moved.
    pub robot: Robot<f64>,
    /// Its joints.
    pub space: JointSpace,
    method: Method,
    /// How much of the motion of the joints the hand sees at least, in most configurations.
    pub(super) seen: f64,
}

/// How the configurations are found.
#[derive(Clone, Debug)]
enum Method {
    /// By the elimination of six axes.
    Six(Box<Six>),
    /// One unknown drives all but five axes.
    Geared(Box<Geared>),
}

/// Six axes, how they are solved, and memory for it.
#[derive(Clone, Debug)]
struct Six {
    axes: SixAxes,
    plan: Plan,
    found: Shared<elimination::Answer>,
}

/// A solution may miss the pose by this (see [`Solution::residual`]).
pub(super) const TOLERANCE: f64 = 1e-9;
/// A smallest singular value below this may belong to a self-motion.
pub(super) const SINGULAR: f64 = 1e-5;
/// Members of a curve are not further apart (radians, lengths by the reach).
const NEXT: f64 = 0.2;
/// A configuration this near to a curve is on it.
const SAME: f64 = 1e-5;
/// A residual above this is more than rounding.
pub(super) const ROUGH: f64 = 1e-12;

impl GeneralSolver {
    /// For a robot with six axes; measures which eliminations suit it (up to a fifth of a second).
    ///
    /// # Errors
    /// See [`Unsuited`].
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Result<Self, Unsuited> {
        GeneralSolver::planned(robot, space, Plan::new)
    }

    /// The same where a few poses are to be solved: an elimination that suits, if not the best.
    ///
    /// # Errors
    /// See [`Unsuited`].
    pub fn quick(robot: &Robot<f64>, space: &JointSpace) -> Result<Self, Unsuited> {
        GeneralSolver::planned(robot, space, Plan::quick)
    }

    fn planned(
        robot: &Robot<f64>,
        space: &JointSpace,
        plan: impl Fn(&Arm) -> Result<Plan, Unsuitable>,
    ) -> Result<Self, Unsuited> {
        let method = match SixAxes::new(robot) {
            Ok(axes) => {
                let plan = plan(&axes.arm).map_err(|e| Unsuited::Degenerate(e.to_string()))?;
                let found = Shared::new(elimination::Answer::default());
                Method::Six(Box::new(Six { axes, plan, found }))
            }
            Err(Unsuited::Axes(n)) if n > 6 => Method::Geared(Box::new(Geared::new(robot, space)?)),
            Err(why) => return Err(why),
        };
        let seen = newton::usually_seen(robot, Goal::Pose, space);
        Ok(GeneralSolver { robot: robot.clone(), space: space.clone(), method, seen })
    }

    /// The arm, and how it is solved, if it has six axes.
    pub fn parts(&self) -> Option<(&SixAxes, &Plan)> {
        match &self.method {
            Method::Six(six) => Some((&six.axes, &six.plan)),
            Method::Geared(_) => None,
        }
    }

    /// Whether one joint drives several axes.
    pub(super) fn is_geared(&self) -> bool {
        matches!(self.method, Method::Geared(_))
    }

    /// How many splits of the loop a pose takes.
    pub fn splits(&self, pose: &Transform<f64>) -> u32 {
        match &self.method {
            Method::Six(six) => {
                let mut found = six.found.lend();
                six.plan.solve(&rigid(pose), &mut found);
                found.splits
            }
            Method::Geared(_) => 1,
        }
    }

    /// What elimination finds.
    fn roots(&self, pose: &Transform<f64>) -> (Vec<Found>, Certificate) {
        match &self.method {
            Method::Six(six) => {
                let mut found = six.found.lend();
                six.plan.solve(&rigid(pose), &mut found);
                let one = |s: &elimination::Solution| Found {
                    q: six.axes.joints(&s.q),
                    multiplicity: s.multiplicity,
                    singular: s.singular,
                };
                (found.solutions.iter().map(one).collect(), found.certificate)
            }
            Method::Geared(geared) => geared.solve(&self.robot, &self.space, pose),
        }
    }

    /// All solutions of a pose of the tool in the base, in ascending order of their joint variables.
    pub fn solve(&self, pose: &Transform<f64>) -> Answer {
        let mut answer = Answer::empty();
        let (found, certificate) = self.roots(pose);
        answer.doubt = match certificate {
            Certificate::Complete => None,
            Certificate::NearDoubleRoot => Some(Doubt::DoubleRoot),
            Certificate::Undecided => Some(Doubt::Uncounted),
        };
        let size = self.space.size(pose);
        self.collect(found, pose, size, &mut answer);
        self.families(pose, size, &mut answer);
        self.confirm(pose, size, &mut answer);
        answer.spread(&self.space);
        answer.solutions.sort_by(|a, b| {
            let unequal = a.q.iter().zip(&b.q).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne());
            unequal.unwrap_or(std::cmp::Ordering::Equal)
        });
        answer
    }

    /// Adds what was found and solves the pose.
    fn collect(&self, found: Vec<Found>, pose: &Transform<f64>, size: f64, answer: &mut Answer) {
        let miss = |q: &[f64]| newton::distance(&self.robot, Goal::Pose, pose, q, size);
        for found in found {
            let mut q = found.q;
            let mut residual = miss(&q);
            if residual > ROUGH
                && let Some((polished, better)) = newton::polish(&self.robot, Goal::Pose, pose, &q, &[], size)
                && better < residual
            {
                (q, residual) = (polished, better);
            }
            if residual > TOLERANCE || residual.is_nan() {
                continue;
            }
            self.space.wrap(&mut q);
            residual = miss(&q);
            // Two that have a solution between them are one.
            let between = |a: &[f64]| -> Vec<f64> {
                a.iter().zip(self.space.moved(a, &q)).map(|(x, d)| x + d / 2.0).collect()
            };
            let is_known = |s: &Solution| {
                let away = self.space.distance(&s.q, &q);
                away <= SAME || away <= NEXT / 10.0 && s.guard < SINGULAR && miss(&between(&s.q)) <= ROUGH
            };
            if answer.solutions.iter().any(is_known) {
                continue;
            }
            let within_limits = self.space.within(&q);
            let (branch, multiplicity, guard) = (Branch::default(), found.multiplicity, found.singular);
            answer.solutions.push(Solution { q, residual, branch, multiplicity, within_limits, guard });
        }
    }

    /// Where the Jacobian is singular at a solution, the arm may move with its hand still: the curve is followed, and
    /// what lies on it is no solution of its own.
    fn families(&self, pose: &Transform<f64>, size: f64, answer: &mut Answer) {
        let (robot, space, goal) = (&self.robot, &self.space, Goal::Pose);
        for s in std::mem::take(&mut answer.solutions) {
            let is_known = answer.families.iter().any(|f| self.is_on(pose, size, &f.curve, &s.q));
            let direction =
                if s.guard > SINGULAR || is_known { None } else { is_self_motion(robot, space, goal, &s.q) };
            let Some(direction) = direction else {
                if !is_known {
                    answer.solutions.push(s);
                }
                continue;
            };
            let motion = follow(robot, space, goal, pose, &s.q);
            answer.solutions.retain(|t| !self.is_on(pose, size, &motion.curve, &t.q));
            answer.families.push(Family::followed(s, SelfMotion { direction, ..motion }));
        }
    }

    /// True if a configuration lies on a curve of members.
    pub(super) fn is_on(&self, pose: &Transform<f64>, size: f64, curve: &[Vec<f64>], q: &[f64]) -> bool {
        let away = |p: &Vec<f64>| self.space.distance(p, q);
        let Some(nearest) = curve.iter().min_by(|a, b| away(a).total_cmp(&away(b))) else { return false };
        let way = |p: &[f64]| self.space.moved(p, q);
        away(nearest) < NEXT && {
            let slid = newton::slide(&self.robot, Goal::Pose, pose, nearest, (&[], way), size);
            self.space.distance(&slid, q) < SAME
        }
    }
}
