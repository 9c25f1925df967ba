//! What controllers call: inverse kinematics with a status for each call, the nearest configuration within limits, all of them with
//! their turns.
//!
//! It stands around `solve`, which lists what a closed form or elimination finds, and is the same for every arm. Where that says
//! that a pose is singular, solutions that it does not see are followed from poses beside it: an isolated solution with a
//! Jacobian of full rank has neighbours at all poses near enough. How near that is, is not known; so nothing is said to be complete there.

mod c;
mod javascript;
pub(crate) mod matlab;
pub(crate) mod python;
mod rust;

use super::{Solver, samples};
use denavit::description::{Description, JointKind};
use denavit::inverse::Goal;
use denavit::robot::Robot;
use denavit::space::{JointSpace, Periods};
use denavit_emit::{Attachment, Language};
use std::f64::consts::TAU;

/// Values of given joints that are tried where the nearest configuration is searched for.
const SAMPLES: usize = 33;

/// The functions around `solve`.
pub(super) struct Controller<'a> {
    solver: Solver<'a>,
    goal: Goal,
    /// Whether the hand can be brought to any pose nearby.
    is_full: bool,
    given: Vec<usize>,
    is_angle: Vec<bool>,
    limits: Vec<Option<[f64; 2]>>,
    turning: Periods,
    /// What lengths are compared with, metres.
    size: f64,
    /// Numbers that functions of the joints take: the joint variables, and those of dynamics.
    variables: usize,
    has_parameters: bool,
    /// Whether all of them have values where the caller gives none.
    has_defaults: bool,
    /// Configurations of which `solve` is known to list all solutions, and how many they are.
    known: Vec<(Vec<f64>, usize)>,
    /// Values of the parameters in the test.
    parameters: Vec<f64>,
}

impl<'a> Controller<'a> {
    /// For an arm in a folder whose functions take so many numbers, and values of parameters beyond those of the joints.
    pub fn new(
        d: &Description,
        solver: Solver<'a>,
        variables: usize,
        more: &[f64],
        has_defaults: bool,
    ) -> Self {
        let robot = Robot::numeric(&samples::valued(d));
        let robot = robot.expect("each parameter has a value");
        let space = JointSpace::new(d, &robot);
        let (goal, rank, given) = match solver {
            Solver::Closed(closed) => {
                let model = closed.model();
                (model.goal, model.rank, model.given.clone())
            }
            Solver::General(_) => (Goal::Pose, 6, vec![]),
        };
        let parameters: Vec<f64> = samples::parameters(d).into_iter().chain(more.iter().copied()).collect();
        let mut turning = space.turning.clone();
        turning.keep(&given);
        Controller {
            solver,
            goal,
            is_full: rank
                == match goal {
                    Goal::Pose => 6,
                    Goal::Position => 3,
                    Goal::PositionAndAxis => 5,
                },
            is_angle: d.variables().iter().map(|v| v.kind == JointKind::Revolute).collect(),
            limits: space.limits.clone(),
            size: space.length(),
            turning,
            given,
            variables,
            known: match solver {
                Solver::Closed(closed) => closed.regular(),
                Solver::General(general) => general.regular(),
            },
            has_parameters: !parameters.is_empty(),
            has_defaults,
            parameters,
        }
    }

    /// The functions in a language.
    pub fn attachment(&self, language: Language) -> Attachment {
        match language {
            Language::Rust => rust::attachment(self),
            Language::Python => python::attachment(self),
            Language::JavaScript => javascript::attachment(self),
            Language::Matlab => matlab::attachment(self),
            Language::C | Language::Cuda | Language::IkFast => c::attachment(self),
        }
    }

    /// Lines for the head of each file.
    pub fn header(&self) -> Vec<String> {
        vec![
            "ik, ik_nearest, ik_all_within_limits: around solve, which lists the solutions, with a status for each call. At \
             singular poses, and beside them, solutions are followed from some poses nearby."
                .into(),
        ]
    }

    /// What is read of a pose.
    fn read(&self) -> &'static str {
        match self.goal {
            Goal::Pose => "rotation (no unit) and position (m)",
            Goal::Position => "their last column, the position (m)",
            Goal::PositionAndAxis => {
                "their last two columns: the direction of the z axis (no unit) and the position (m)"
            }
        }
    }

    /// Where the numbers stand that `solve` takes of a pose: row and column.
    fn places(&self) -> Vec<(usize, usize)> {
        let columns: &[usize] = match self.goal {
            Goal::Pose => &[0, 1, 2, 3],
            Goal::Position => &[3],
            Goal::PositionAndAxis => &[2, 3],
        };
        (0..3).flat_map(|i| columns.iter().map(move |&j| (i, j))).collect()
    }

    /// Where listed angles lie.
    fn range(&self) -> &'static str {
        let is_plain = self.turning.windows.iter().all(|w| !w.is_finite() || *w == TAU);
        if is_plain { "in (-pi, pi]" } else { "in the range in which all links come back, around 0" }
    }

    /// What is said of the nearest configuration.
    fn nearest(&self) -> &'static str {
        if self.given.is_empty() {
            "Of families the member within the limits that is nearest is found by moving the arm with its hand still. The status is \
             that of ik, or OUTSIDE_LIMITS; with FAMILY, UNDECIDED and OUTSIDE_LIMITS a nearer one may not be known."
        } else {
            "The joints in excess are free: it starts from the previous configuration, and from solutions at 33 of their values if \
             that leads farther than 0.1 rad away, and moves the arm with its hand still until no member nearby is nearer. SOLVED \
             then says that q has the pose, and not that nothing else is nearer; OUTSIDE_LIMITS and UNDECIDED that none was found."
        }
    }

    fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.size }
    }

    fn period(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { self.turning.periods[joint] } else { 0.0 }
    }

    fn window(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { self.turning.windows[joint] } else { 0.0 }
    }

    fn limit(&self, joint: usize) -> [f64; 2] {
        self.limits[joint].unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
    }

    /// Motions after which all links are back, besides those in turns of one joint; the first is none.
    fn copies(&self) -> Vec<Vec<f64>> {
        std::iter::once(vec![0.0; self.joints()]).chain(self.turning.copies.iter().cloned()).collect()
    }

    /// Whether `solve` gets the pose as it came: what it is off is what an arm that reaches few poses may miss it by.
    fn passes_rounded(&self) -> bool {
        !self.is_full && self.goal == Goal::Pose
    }

    /// The configurations of the test, and how many have the pose of each.
    fn tested(&self) -> (Vec<Vec<f64>>, String) {
        let counts: Vec<String> = self.known.iter().map(|k| k.1.to_string()).collect();
        (self.known.iter().map(|k| k.0.clone()).collect(), counts.join(", "))
    }

    /// Values of the parameters in the test, as [`Attachment`] takes them.
    fn test_parameters(&self) -> String {
        let values: Vec<String> = self.parameters.iter().map(|x| format!("{x:?}")).collect();
        format!("@Parameters({})@", values.join(", "))
    }

    fn joints(&self) -> usize {
        self.is_angle.len()
    }

    fn is_given(&self, joint: usize) -> bool {
        self.given.contains(&joint)
    }
}
