//! What is answered for a configuration, and its JSON.

use crate::commands::fk::strict;
use denavit::Robot;
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::geometry::orientation::{Orientation, OrientationSet, extract};
use denavit::inverse::JointSpace;
use denavit::velocity::{
    AnalyticJacobian, Damping, Jacobian, JointRates, Measures, NearestSingularity, ROWS, RateSolver,
    Viewpoint, Wrench, analytic, geometric, hessian_program, largest_wrench, measures, nearest_singularity,
    rate_program, torques,
};
use denavit_program::Program;
use denavit_symbolic::Expr;
use denavit_wire::Schema;
use denavit_wire::jacobian::{self as wire, Analytic, Largest, Near, Rates, frame};

/// What is asked besides the Jacobian.
pub struct Questions {
    pub orientation: Option<OrientationSet>,
    pub rates: Option<Vec<f64>>,
    /// The components, and which of them are asked for.
    pub twist: Option<([f64; 6], [bool; 6])>,
    pub damping: Damping,
    pub wish: Vec<f64>,
    pub wrench: Option<Wrench>,
    pub torques: Option<Vec<f64>>,
    pub hessian: bool,
}

/// What holds a wrench.
pub struct Held {
    pub torques: Vec<f64>,
    /// By what the wrench can be multiplied until which joint is at its limit.
    pub largest: Option<(f64, usize)>,
}

/// The answers.
pub struct Answer<'a> {
    pub description: &'a Description,
    pub view: Viewpoint<Expr>,
    pub q: Vec<f64>,
    pub jacobian: Jacobian<f64>,
    pub measures: Measures,
    pub nearest: Option<NearestSingularity>,
    pub analytic: Option<(Orientation, AnalyticJacobian<f64>)>,
    /// The twist at the joint velocities, J̇, and J̇q̇.
    pub motion: Option<([f64; 6], Jacobian<f64>, [f64; 6])>,
    pub solved: Option<JointRates>,
    pub held: Option<Held>,
    /// For each joint the derivative of the Jacobian.
    pub hessian: Option<Vec<Jacobian<f64>>>,
    pub questions: Questions,
}

impl<'a> Answer<'a> {
    pub fn new(
        description: &'a Description,
        robot: &Robot<f64>,
        view: Viewpoint<Expr>,
        q: &[f64],
        questions: Questions,
    ) -> Self {
        let space = JointSpace::new(description, robot);
        let numeric = evaluated(description, &view);
        let jacobian = geometric(robot, q, &numeric);
        let length = size(&space);
        let analytic = questions.orientation.map(|set| {
            let pose = match view.body {
                Reference::Frame(i) => robot.frames(q)[i],
                _ => robot.pose(q),
            };
            let o = extract(&pose.rotation, set);
            let found = analytic(&jacobian, set, &o.values);
            (o, found)
        });
        let solved = questions.twist.map(|(twist, rows)| {
            let mut solver = RateSolver::new(&space.is_angle, length);
            solver.damping = questions.damping;
            solver.rows = rows;
            solver.limits = velocity_limits(description).unwrap_or_default();
            solver.solve(&jacobian, &twist, &questions.wish)
        });
        let motion = questions.rates.as_ref().map(|rates| {
            let found = run(description, &rate_program(description, &view), &[q, rates].concat());
            let (entries, drift) = found.split_at(6 * q.len());
            (jacobian.twist(rates), by_rows(entries), std::array::from_fn(|k| drift[k]))
        });
        let held = questions.wrench.map(|wrench| {
            let limits = questions.torques.as_ref();
            Held {
                torques: torques(&jacobian, &wrench),
                largest: limits.and_then(|l| largest_wrench(&jacobian, l, &wrench)),
            }
        });
        let hessian = questions.hessian.then(|| {
            let found = run(description, &hessian_program(description, &view), q);
            let n = q.len();
            let of = |j: usize| by_rows(&found.iter().skip(j).step_by(n).copied().collect::<Vec<_>>());
            (0..n).map(of).collect()
        });
        Answer {
            description,
            measures: measures(&jacobian, &space.is_angle, length),
            nearest: nearest_singularity(robot, &numeric, &space.is_angle, length, q),
            view,
            q: q.to_vec(),
            jacobian,
            analytic,
            motion,
            solved,
            held,
            hessian,
            questions,
        }
    }

    /// Everything that was answered.
    pub fn wire(&self) -> wire::Answer {
        let Measures { linear, angular, whole, length } = &self.measures;
        let motion = self.motion.as_ref();
        let held = self.held.as_ref();
        wire::Answer {
            analytic: self.analytic.as_ref().map(|(o, rates)| Analytic::of(o.clone().into(), rates)),
            angular: angular.into(),
            at: frame(self.view.at),
            condition: whole.condition,
            drift: motion.map(|m| m.2),
            frame: frame(self.view.axes),
            free: whole.free.clone(),
            hessian: self.hessian.as_ref().map(|h| h.iter().map(Jacobian::rows).collect()),
            jacobian: self.jacobian.rows(),
            jacobian_rate: motion.map(|m| m.1.rows()),
            joint_rates: self.solved.as_ref().map(|s| Rates::of(s, &self.questions.damping)),
            joints: self.description.joint_names(),
            largest_wrench: held
                .and_then(|h| h.largest)
                .map(|(factor, joint)| Largest { factor, joint: joint + 1 }),
            length: *length,
            linear: linear.into(),
            lost: whole.lost.clone(),
            manipulability: whole.manipulability,
            nearest_singularity: self.nearest.as_ref().map(Near::from),
            of: frame(self.view.body),
            q: self.q.clone(),
            rank: whole.rank,
            robot: self.description.name.clone(),
            rows: ROWS,
            schema: Schema,
            singular_values: whole.singular_values.clone(),
            torques: held.map(|h| h.torques.clone()),
            twist: motion.map(|m| m.0),
        }
    }
}

/// The length that lengths are divided by where they stand beside angles.
fn size(space: &JointSpace) -> f64 {
    if space.reach > 0.0 { space.reach } else { 1.0 }
}

/// The viewpoint with numbers.
fn evaluated(description: &Description, view: &Viewpoint<Expr>) -> Viewpoint<f64> {
    let offset = view.offset.map(|e| e.eval(|s| description.value(s)).unwrap_or(f64::NAN));
    Viewpoint { axes: view.axes, body: view.body, at: view.at, offset }
}

/// The results of a program at the robot's own values.
fn run(description: &Description, program: &Program, inputs: &[f64]) -> Vec<f64> {
    strict(description, program).scalar().eval(inputs).to_vec()
}

fn by_rows(entries: &[f64]) -> Jacobian<f64> {
    let n = entries.len() / 6;
    Jacobian { columns: (0..n).map(|j| std::array::from_fn(|r| entries[r * n + j])).collect() }
}

/// The joints' largest velocities, if all have one.
fn velocity_limits(description: &Description) -> Option<Vec<f64>> {
    let rows = description.rows.iter().filter(|r| r.variable.is_some());
    rows.map(|r| r.velocity?.eval(|s| description.value(s)).ok()).collect()
}
