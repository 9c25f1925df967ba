//! A robot, or the first rows of its table, prepared for judging: numbers, forward model, all solutions of sample poses.

use super::setting::{Sample, Setting};
use denavit::description::{Description, JointKind};
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Goal, InverseKinematics, InverseModel, InverseOptions, InverseSolver};
use denavit::random::Random;
use denavit::robot::Robot;
use denavit::structure::Structure;
use denavit_symbolic::{Expr, Rational, Symbol};
use std::f64::consts::{FRAC_PI_2, PI};

/// Random poses that are compared, with a fast and with a slow solver.
const POSES: [usize; 2] = [150, 40];
/// Configurations that are drawn for them at most.
const DRAWN: [usize; 2] = [1_500, 120];
/// So many samples of a kind say what is right.
const ENOUGH: usize = 20;
/// Special configurations.
const SPECIAL: usize = 48;

/// A robot with numbers and samples.
pub struct Arm {
    pub description: Description,
    pub goal: Goal,
    pub setting: Setting,
    pub model: Option<InverseModel>,
    /// Random poses with as many solutions as there can be.
    pub samples: Vec<Sample>,
    /// Random poses as they come.
    pub any: Vec<Sample>,
    /// Configurations with joints at 0, ±π/2, π.
    pub special: Vec<Sample>,
    robot: Robot<f64>,
    solver: Method,
}

enum Method {
    Closed(Box<InverseSolver>),
    Dispatched(Box<InverseKinematics>),
    /// The configuration itself is all that is known.
    None,
}

impl Arm {
    /// All rows of a table, or the first ones, without the tool then; nothing if there is no joint.
    pub fn new(
        description: &Description,
        rows: Option<usize>,
        pose: &[[Symbol; 4]; 3],
        goal: Goal,
    ) -> Option<Self> {
        let mut description = description.clone();
        let mut goal = goal;
        if let Some(n) = rows.filter(|&n| n < description.rows.len()) {
            description.rows.truncate(n);
            description.tool = Transform::identity();
            description.poses.clear();
            goal = if description.variables().len() <= 3 { Goal::Position } else { Goal::Pose };
        }
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        if variables.is_empty() {
            return None;
        }
        let mut numbers = description.clone();
        let open = numbers.parameters.iter_mut().filter(|p| p.value.is_none());
        for (k, p) in open.enumerate() {
            // Lengths in (0.2, 1) that have nothing to do with each other.
            p.value = Some(Rational::new(31 + (7 * k as i64) % 69, 100).into());
        }
        let parameters = numbers.known_values();
        let robot = Robot::numeric(&numbers).ok()?;
        let q: Vec<Expr> = variables.iter().map(|&v| v.into()).collect();
        let matrix = Robot::symbolic(&description).pose(&q).matrix();
        let entries = (0..3).flat_map(|r| (0..4).map(move |c| (pose[r][c], matrix[r][c]))).collect();
        let is_angle: Vec<bool> =
            description.variables().iter().map(|v| v.kind == JointKind::Revolute).collect();
        let mut setting = Setting::new(variables, is_angle, entries, parameters, robot.reach());
        let options = InverseOptions { goal, given: None };
        let model = InverseModel::derive(&numbers, &options).ok();
        let closed = model.as_ref().and_then(|m| m.solver(&numbers).ok());
        let six =
            setting.variables.len() == 6 && goal == Goal::Pose && Structure::of(&numbers).nearly.is_empty();
        let solver = match closed {
            Some(solver) => {
                setting.given = solver.given().to_vec();
                Method::Closed(Box::new(solver))
            }
            None if six => match InverseKinematics::new(&numbers, &options) {
                Ok(all) if all.method() == "elimination" => Method::Dispatched(Box::new(all)),
                _ => Method::None,
            },
            None => Method::None,
        };
        setting.is_enumerated = !matches!(solver, Method::None);
        let mut arm = Arm {
            description,
            goal,
            setting,
            model,
            samples: vec![],
            any: vec![],
            special: vec![],
            robot,
            solver,
        };
        arm.draw();
        Some(arm)
    }

    fn draw(&mut self) {
        let slow = usize::from(matches!(self.solver, Method::Dispatched(_)));
        let most = self.model.as_ref().map_or(usize::MAX, InverseModel::max_solutions);
        let mut random = Random(7);
        let mut drawn: Vec<Sample> = vec![];
        let mut full = 0;
        for _ in 0..DRAWN[slow] {
            if full >= POSES[slow] || (drawn.len() >= POSES[slow] && !self.setting.is_enumerated) {
                break;
            }
            let q = self.random(&mut random);
            if let Some((sample, _)) = self.sample(q) {
                full += usize::from(sample.solutions.len() >= most);
                drawn.push(sample);
            }
        }
        // The most solutions that are common enough.
        let mut counts: Vec<usize> = drawn.iter().map(|s| s.solutions.len()).collect();
        counts.sort_unstable_by(|a, b| b.cmp(a));
        let least = counts.get(ENOUGH).or(counts.last()).copied().unwrap_or(0);
        let many = |s: &&Sample| s.solutions.len() >= least;
        self.samples = drawn.iter().filter(many).take(POSES[slow]).cloned().collect();
        drawn.truncate(POSES[slow]);
        self.any = drawn;
        let n = self.setting.variables.len();
        for k in 0..SPECIAL {
            let mut q = self.random(&mut random);
            let corner =
                |random: &mut Random| [0.0, FRAC_PI_2, -FRAC_PI_2, PI][(random.unit() * 4.0) as usize % 4];
            if k % 2 == 0 {
                q[k / 2 % n] = if self.setting.is_angle[k / 2 % n] { corner(&mut random) } else { 0.0 };
            } else {
                let corners = q.iter_mut().zip(&self.setting.is_angle).filter(|x| *x.1);
                corners.for_each(|x| *x.0 = corner(&mut random));
            }
            if let Some((sample, _)) = self.sample(q) {
                self.special.push(sample);
            }
        }
    }

    /// A configuration with few digits: angles all round, lengths up to the robot's size.
    fn random(&self, random: &mut Random) -> Vec<f64> {
        let length = 0.7 * self.setting.size;
        let mut next = |&is_angle: &bool| {
            let x = (2.0 * random.unit() - 1.0) * if is_angle { PI } else { length };
            (x * 1e3).round() / 1e3
        };
        self.setting.is_angle.iter().map(&mut next).collect()
    }

    /// All solutions at the pose of a configuration; nothing if the solver misses the configuration itself.
    pub fn sample(&mut self, q: Vec<f64>) -> Option<(Sample, Answer)> {
        let pose = self.robot.pose(&q);
        let given: Vec<f64> = self.setting.given.iter().map(|&j| q[j]).collect();
        let answer = match &self.solver {
            Method::Closed(solver) => solver.solve(&pose, &given),
            Method::Dispatched(solver) => solver.solve(&pose, &[]),
            Method::None => Answer::empty(),
        };
        let mut solutions: Vec<Vec<f64>> = answer.solutions.iter().map(|s| s.q.clone()).collect();
        let motions: Vec<Vec<f64>> = answer.families.iter().map(|f| f.direction.clone()).collect();
        if !self.setting.is_enumerated {
            solutions.push(q.clone());
        }
        let is_found = solutions.iter().any(|s| self.setting.is_same(s, &q));
        if !is_found && motions.is_empty() {
            return None;
        }
        let entries = pose.matrix()[..3].concat();
        Some((Sample { q, entries, solutions, motions }, answer))
    }

    /// True if a configuration has the pose of another.
    pub fn has_pose(&self, q: &[f64], entries: &[f64]) -> bool {
        let found = self.robot.pose(q).matrix();
        let wanted = |k: usize| {
            self.goal == Goal::Pose || k % 4 == 3 || (self.goal == Goal::PositionAndAxis && k % 4 == 2)
        };
        let near = |(k, (x, y)): (usize, (&f64, &f64))| {
            !wanted(k) || (x - y).abs() <= 1e-5 * if k % 4 == 3 { self.setting.size } else { 1.0 }
        };
        found.iter().flatten().zip(entries).enumerate().all(near)
    }
}
