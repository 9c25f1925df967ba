//! What controllers call: inverse kinematics with a status for each call, the nearest configuration within limits, all of them with
//! their turns.
//!
//! It stands around `solve`, which lists what a closed form or elimination finds, and is the same for every arm. Where that says
//! that a pose is singular, solutions that it does not see are followed from poses beside it, where each regular one is
//! found: an isolated solution with a Jacobian of full rank has neighbours at all poses nearby.

mod c;

use super::{PackageOptions, Solver, samples};
use denavit::description::{Description, JointKind};
use denavit::inverse::Goal;
use denavit::robot::Robot;
use denavit::space::{JointSpace, Periods};
use denavit_emit::{Attachment, Language, Precision};

/// The name of the function that lists solutions, in a language.
pub(super) fn solver_name(options: &PackageOptions) -> &'static str {
    if is_served(options) || options.language == Language::IkFast { "solve" } else { "ik" }
}

/// Whether the language has these functions.
pub(super) fn is_served(options: &PackageOptions) -> bool {
    options.language == Language::C && options.precision == Precision::Double
}

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
    /// Configurations of which `solve` is known to list all solutions, and how many they are.
    known: Vec<(Vec<f64>, usize)>,
    /// Values of the parameters in the test.
    parameters: Vec<f64>,
}

impl<'a> Controller<'a> {
    /// For an arm in a folder whose functions take so many numbers, and values of parameters beyond those of the joints.
    pub fn new(d: &Description, solver: Solver<'a>, variables: usize, more: &[f64]) -> Self {
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
        turning.copies.retain(|c| given.iter().all(|&j| c[j] == 0.0));
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
            parameters,
        }
    }

    /// What lists the solutions, in the language.
    pub fn attachment(&self) -> Attachment {
        c::attachment(self)
    }

    /// Lines for the head of each file.
    pub fn header(&self) -> Vec<String> {
        vec![
            "ik, ik_nearest, ik_all_within_limits: around solve, which lists the solutions, with a status for each call. At \
             singular poses, and beside them, solutions are followed from poses nearby, where all are regular."
                .into(),
        ]
    }

    fn joints(&self) -> usize {
        self.is_angle.len()
    }

    fn is_given(&self, joint: usize) -> bool {
        self.given.contains(&joint)
    }
}
