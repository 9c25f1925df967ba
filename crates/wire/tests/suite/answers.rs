//! Every kind of answer, for robots of the catalogue.

use denavit::Robot;
use denavit::catalogue;
use denavit::description::{Description, JointKind};
use denavit::forward::{Outputs, Reference};
use denavit::geometry::Vector;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::idealise::idealised;
use denavit::inverse::{self, InverseKinematics, InverseModel};
use denavit::motion::hand::{HandPath, Line, Orientation};
use denavit::motion::plan::{KnownLimits, PlanOptions, Planned, Wish};
use denavit::velocity::{
    Damping, JacobianModel, RateSolver, Singularities, Viewpoint, analytic, geometric, measures,
    nearest_singularity, regular_configuration, singular_configurations,
};
use denavit_emit::{Language, Precision};
use denavit_generate::{PackageOptions, Wanted, generate};
use denavit_report::Derivation;
use denavit_report::explain::Explanation;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_wire::jacobian::{self, Analytic, Largest, Near, Rates};
use denavit_wire::pose::{self, matrix};
use denavit_wire::{Schema, catalogue::Catalogue, text};
use denavit_wire::{check, code, derivation, finding, forward, path, robot, singular, view};
use serde_json::Value;
use std::path::Path;

/// Robots of all kinds: closed form, limits, a joint too many, no closed form, a branch of a table, a slide.
const ROBOTS: [&str; 6] = ["staubli-rx90", "puma560", "franka-panda", "kinova-jaco", "scara", "stanford"];

/// What the command line answers to a robot: names of answers, and their JSON.
pub fn answers(name: &str) -> Vec<(&'static str, String)> {
    let d = catalogue::robot(name).expect("it is in the catalogue").filled();
    let numbers = Robot::numeric(&d).expect("everything has a value");
    let q = regular_configuration(&d, vec![0.1; numbers.joints]);
    let mut all = vec![
        ("robots", text(&Catalogue::of([(name, &d)], [], []))),
        ("show", text(&robot::Robot::of(&d))),
        ("view", text(&view::Served { schema: Schema, url: "http://127.0.0.1/".into() })),
        ("line", text(&finding::BadLine { error: "no JSON", line: 3, schema: Schema })),
        ("fk", placed(&d, &numbers, &q)),
    ];
    let derived = Derivation::new(&d, Reference::Base, Reference::Tool, Outputs::ALL);
    all.push(("derive", text(&forward::Derived::of(&derived))));
    all.extend(solved(&d, &q));
    all.extend(moving(&d, &numbers, &q));
    all.push(("path", followed(&d, &numbers, &q)));
    all.push(("generate", written(&d)));
    all
}

fn placed(d: &Description, numbers: &Robot<f64>, q: &[f64]) -> String {
    let tool = numbers.pose(q);
    let frames: Vec<pose::Matrix> = numbers.frames(q).iter().map(matrix).collect();
    text(&forward::Placed {
        frames: &frames,
        orientation: Some(extract(&tool.rotation, OrientationSet::Quaternion).into()),
        pose: matrix(&tool),
        q,
        robot: &d.name,
        schema: Schema,
        within_limits: Some(true),
    })
}

fn solved(d: &Description, q: &[f64]) -> Vec<(&'static str, String)> {
    use denavit_wire::inverse as wire;
    let options = inverse::InverseOptions::default();
    let solver = InverseKinematics::new(d, &options).expect("it can be solved");
    let given: Vec<f64> = solver.given.iter().map(|&j| q[j]).collect();
    let pose = solver.robot.pose(q);
    let answer = solver.solve(&pose, &given);
    let nearest = solver.nearest(&pose, &answer, q).expect("the pose is one of the arm's");
    let mut far = pose;
    far.translation = Vector([90.0, 0.0, 0.0]);
    let none = solver.solve(&far, &given);
    let ideal = idealised(d, 1e-6).expect("everything has a value");
    let wire_of = |answer: &inverse::Answer| wire::Answer {
        best: Some(wire::Nearest::best(&nearest)),
        complete: answer.is_complete(),
        doubt: Some("words".into()),
        families: answer.families.iter().map(|f| wire::Family::of(f, &solver.space)).collect(),
        given: given.iter().map(|x| ("q1".to_string(), *x)).collect(),
        idealised: Some(wire::Idealised::from(&ideal)),
        joints: d.joint_names(),
        jump: None,
        left_out: None,
        method: solver.method(),
        nearest: Some(wire::Nearest::of(&nearest)),
        obstacle: answer.obstacle.as_ref().map(wire::Obstacle::from),
        pose: matrix(&pose),
        robot: d.name.clone(),
        schema: Schema,
        solutions: answer.solutions.iter().map(|s| wire::Solution::of(s, &solver.space)).collect(),
        status: wire::status(answer),
    };
    assert_eq!(wire::status(&answer), "solved", "{}", d.name);
    // A slide without limits may reach everything.
    assert!(has_slide(d) || wire::status(&none) == "unreachable", "{}", d.name);
    let mut all = vec![("ik", text(&wire_of(&answer))), ("ik", text(&wire_of(&none)))];
    all.push(match InverseModel::derive(d, &options) {
        Ok(model) => ("ik", text(&derivation::Derivation::of(&Explanation::of(&model)))),
        Err(why) => ("ik", text(&wire::Refused::of(d, &why.to_string()))),
    });
    all
}

fn has_slide(d: &Description) -> bool {
    d.variables().iter().any(|v| v.kind == JointKind::Prismatic)
}

fn moving(d: &Description, numbers: &Robot<f64>, q: &[f64]) -> Vec<(&'static str, String)> {
    let view = Viewpoint::tool();
    let j = geometric(numbers, q, &view);
    let space = inverse::JointSpace::new(d, numbers);
    let found = measures(&j, &space.is_angle, space.reach);
    let set = extract(&numbers.pose(q).rotation, OrientationSet::Quaternion);
    let rates = RateSolver::new(&space.is_angle, space.reach).solve(&j, &[0.1; 6], &[]);
    let near = nearest_singularity(numbers, &view, &space.is_angle, space.reach, q);
    let answer = jacobian::Answer {
        analytic: Some(Analytic::of(set.clone().into(), &analytic(&j, set.set, &set.values))),
        angular: (&found.angular).into(),
        at: jacobian::frame(view.at),
        condition: f64::INFINITY,
        drift: Some([0.0; 6]),
        frame: jacobian::frame(view.axes),
        free: found.whole.free.clone(),
        hessian: Some(vec![j.rows()]),
        jacobian: j.rows(),
        jacobian_rate: Some(j.rows()),
        joint_rates: Some(Rates::of(&rates, &Damping::default())),
        joints: d.joint_names(),
        largest_wrench: Some(Largest { factor: 2.0, joint: 1 }),
        length: found.length,
        linear: (&found.linear).into(),
        lost: found.whole.lost.clone(),
        manipulability: found.whole.manipulability,
        nearest_singularity: near.as_ref().map(Near::from),
        of: jacobian::frame(view.body),
        q: q.to_vec(),
        rank: found.whole.rank,
        robot: d.name.clone(),
        rows: denavit::velocity::ROWS,
        schema: Schema,
        singular_values: found.whole.singular_values.clone(),
        torques: Some(vec![1.0; q.len()]),
        twist: Some([0.0; 6]),
    };
    let entries = j.rows().concat();
    let names = d.vocabulary();
    let print = |e: Expr| print(e, &names, Style::Ascii);
    let formulas = match Singularities::derive(d, Reference::Tool) {
        Ok(found) => {
            singular::Model::with_singularities(&d.name, &found, found.of_its_point(d).as_ref(), print)
        }
        Err(why) => {
            let model = JacobianModel::shortest(d, Reference::Tool);
            let found = singular_configurations(d, &model.view, &[0, 1, 2, 3, 4, 5]);
            singular::Model::without_singularities(&d.name, &model, &why, found.as_deref().ok(), print)
        }
    };
    vec![
        ("jacobian", text(&answer)),
        ("jacobian", text(&jacobian::Matrix::of(&d.name, "base", q, &entries))),
        ("jacobian", text(&formulas)),
    ]
}

fn followed(d: &Description, numbers: &Robot<f64>, q: &[f64]) -> String {
    let from = numbers.pose(q);
    let mut to = from;
    to.translation = to.translation + Vector([0.0, 0.0, 0.02]);
    let line: Box<dyn HandPath + Send + Sync> = Box::new(Line { from, to, orientation: Orientation::Slerp });
    let wish = Wish::Hand { path: line, start: Some(q.to_vec()) };
    let options = PlanOptions { alternatives: true, ..PlanOptions::default() };
    let planned = Planned::new(d, numbers, wish, &KnownLimits::of(d), &options).expect("it is short");
    let state = planned.trajectory.eval(0.0);
    let sample = path::Sample {
        acceleration: state.qdd,
        manipulability: 1.0,
        pose: matrix(&from),
        q: state.q,
        t: 0.0,
        velocity: state.qd,
    };
    text(&path::Path::of(d, &planned, vec![sample]))
}

fn written(d: &Description) -> String {
    let options = PackageOptions {
        language: Language::C,
        functions: vec![Wanted::Pose, Wanted::Inverse],
        inverse: inverse::InverseOptions::default(),
        precision: Precision::Double,
        name: None,
        masses: None,
        loads: denavit::dynamics::Loads::default(),
        fixed: false,
    };
    let made = generate(d, &options).expect("everything has a value");
    assert!(made.functions.iter().all(|f| f.is_proved), "{}", d.name);
    text(&code::Written::of(&made, Language::C, Path::new("out")))
}

/// A document with every verdict.
pub fn judged() -> String {
    let d = catalogue::robot("staubli-rx90").expect("it is in the catalogue");
    let document = "# RX-90\n\n$P_x = C_1 (C_2 D3 - S_{23} RL4)$\n\n$P_y = S_1 (C_2 D3 + S_{23} RL4)$\n\n\
                    $P_z = S_2 D3 + C_{23} RL4 +$\n\n$\\theta_1 = \\arctan(P_y / P_x)$\n";
    let options = denavit_check::CheckOptions::default();
    let format = denavit_reading::document::Format::of("rx90.md", document);
    let checked = denavit_check::check(document, format, Some(&d), &options).expect("it can be read");
    text(&check::Checked::of("rx90.md", document, &checked))
}

#[test]
fn keys_stand_in_their_order_and_numbers_read_back() {
    for name in ROBOTS {
        for (verb, answer) in answers(name) {
            let value: Value = serde_json::from_str(&answer).expect("it is JSON");
            assert_eq!(value["schema"], 1, "{name} {verb}");
            // Maps of that crate are sorted.
            assert_eq!(value.to_string(), answer, "{name} {verb}");
        }
    }
    let value: Value = serde_json::from_str(&judged()).expect("it is JSON");
    assert_eq!(value.to_string(), judged());
}

#[test]
fn what_is_not_finite_is_null() {
    let all = answers("scara");
    let jacobian = &all.iter().find(|a| a.0 == "jacobian").expect("there is one").1;
    let value: Value = serde_json::from_str(jacobian).expect("it is JSON");
    assert!(value["condition"].is_null(), "{jacobian}");
}

#[test]
fn a_zero_of_a_pose_has_no_sign() {
    let entries: Vec<f64> = (0..32).map(|k| if k % 3 == 0 { -0.0 } else { f64::from(k) }).collect();
    let poses = pose::matrices(&entries);
    assert_eq!(poses.len(), 2);
    assert!(!text(&poses).contains("-0.0"), "{}", text(&poses));
    assert_eq!(poses[1][0][1], 17.0);
}
