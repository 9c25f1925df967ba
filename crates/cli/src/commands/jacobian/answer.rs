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
use serde_json::{Map, Value, json};

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
    pub analytic: Option<(OrientationSet, Orientation, AnalyticJacobian<f64>)>,
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
        let space = JointSpace::new(description, robot.reach());
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
            (set, o, found)
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

    /// Schema 1 of `jacobian`.
    pub fn json(&self) -> String {
        let m = &self.measures;
        let mut object = Map::new();
        let mut put = |key: &str, value: Value| object.insert(key.into(), value);
        put("schema", 1.into());
        put("robot", self.description.name.as_str().into());
        put("q", json!(self.q));
        put("frame", name(self.view.axes).into());
        put("of", name(self.view.body).into());
        put("at", name(self.view.at).into());
        put("rows", json!(ROWS));
        put("jacobian", json!(self.jacobian.rows()));
        put("rank", m.whole.rank.into());
        put("singular_values", json!(m.whole.singular_values));
        put("length", json!(m.length));
        put("condition", json!(m.whole.condition));
        put("manipulability", json!(m.whole.manipulability));
        for (key, block) in [("linear", &m.linear), ("angular", &m.angular)] {
            let values = json!({
                "singular_values": block.singular_values,
                "manipulability": block.manipulability,
                "condition": block.condition,
            });
            put(key, values);
        }
        put("lost", json!(m.whole.lost));
        put("free", json!(m.whole.free));
        if let Some(n) = &self.nearest {
            put("nearest_singularity", json!({"q": n.q, "distance": n.distance}));
        }
        if let Some((set, o, a)) = &self.analytic {
            let rows = json!({
                "set": set.to_string(), "values": o.values, "singular": o.singular, "rows": a.names,
                "jacobian": a.rows,
            });
            put("analytic", rows);
        }
        if let Some((twist, rate, drift)) = &self.motion {
            put("twist", json!(twist));
            put("jacobian_rate", json!(rate.rows()));
            put("drift", json!(drift));
        }
        if let Some(s) = &self.solved {
            let rates = json!({
                "rates": s.rates, "achieved": s.achieved, "damped": s.damped, "scale": s.scale,
                "damping": {"threshold": self.questions.damping.threshold, "largest": self.questions.damping.largest},
            });
            put("joint_rates", rates);
        }
        if let Some(Held { torques, largest }) = &self.held {
            put("torques", json!(torques));
            if let Some((factor, joint)) = largest {
                put("largest_wrench", json!({"factor": factor, "joint": joint + 1}));
            }
        }
        if let Some(hessian) = &self.hessian {
            put("hessian", json!(hessian.iter().map(Jacobian::rows).collect::<Vec<_>>()));
        }
        format!("{}\n", Value::Object(object))
    }
}

/// The length that lengths are divided by where they stand beside angles.
fn size(space: &JointSpace) -> f64 {
    if space.reach > 0.0 { space.reach } else { 1.0 }
}

/// `base`, `tool`, or a number.
pub fn name(frame: Reference) -> String {
    match frame {
        Reference::Base => "base".into(),
        Reference::Tool => "tool".into(),
        Reference::Frame(i) => i.to_string(),
    }
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
