//! The inverse model in numbers: complete on random configurations, on special ones, near singular ones, and in
//! agreement with what peers count (`tests/peers/ik.json`).

use crate::common::{Random, share};
use denavit::geometry::{Transform, Vector};
use denavit::inverse::derivation::MOST_WORK;
use denavit::inverse::{Answer, Goal, InverseModel, InverseOptions, InverseSolver, Refusal, Stuck};
use denavit::{Description, Robot, catalogue, description};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Arms without a closed form, as general as a 6R arm can be, or a 7R arm with an offset in the wrist.
const REFUSED: [&str; 9] = [
    "abb-gofa-crb15000-5",
    "fanuc-crx10ia-l",
    "kinova-jaco",
    "kinova-mico",
    "motoman-hc10",
    "oblique-6r",
    "rethink-baxter-left",
    "rethink-sawyer",
    "ufactory-xarm6",
];

fn robot(name: &str) -> Description {
    let mut d = catalogue::robot(name).expect("the catalogue has it");
    // Robots given with symbols only get lengths that are not special.
    let mut next = 0.31;
    for p in &mut d.parameters {
        if p.value.is_none() {
            let cents = (next * 100.0) as i64;
            p.value = Some(denavit_symbolic::Rational::new(cents, 100).into());
            next += 0.07;
        }
    }
    d
}

fn model(d: &Description) -> InverseModel {
    InverseModel::derive(d, &InverseOptions::default()).unwrap_or_else(|e| panic!("{}: {e}", d.name))
}

fn difference(a: f64, b: f64, is_angle: bool) -> f64 {
    let d = a - b;
    if is_angle { (d - TAU * (d / TAU).round()).abs() } else { d.abs() }
}

struct Case {
    solver: InverseSolver,
    robot: Robot<f64>,
    is_angle: Vec<bool>,
}

impl Case {
    fn new(name: &str) -> Self {
        let d = robot(name);
        let m = model(&d);
        Self::with(&d, &m)
    }

    fn with(d: &Description, m: &InverseModel) -> Self {
        let is_angle = (0..m.chain.variables.len()).map(|j| m.chain.is_angle(j)).collect();
        let solver = m.solver(d).expect("all parameters have values");
        Case { solver, robot: Robot::numeric(d).expect("all parameters have values"), is_angle }
    }

    fn solve(&self, q: &[f64]) -> Answer {
        let given: Vec<f64> = self.solver.given().iter().map(|&j| q[j]).collect();
        self.solver.solve(&self.robot.pose(q), &given)
    }

    fn near(&self, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        (0..a.len()).all(|j| difference(a[j], b[j], self.is_angle[j]) <= tolerance)
    }

    /// The configuration is a solution, or a member of a family.
    fn holds(&self, answer: &Answer, q: &[f64], tolerance: f64) -> bool {
        // Near a singularity joints are determined to rounding by the guard only.
        if answer.solutions.iter().any(|s| self.near(&s.q, q, tolerance + 1e-13 / s.guard)) {
            return true;
        }
        let pose = self.robot.pose(q);
        let given: Vec<f64> = self.solver.given().iter().map(|&j| q[j]).collect();
        answer.families.iter().any(|f| {
            let members = self.solver.members_at(&pose, &given, f, q);
            members.iter().any(|s| self.near(&s.q, q, tolerance))
        })
    }

    fn random(&self, random: &mut Random) -> Vec<f64> {
        let angles = self.is_angle.iter();
        angles.map(|&a| if a { (random.unit() - 0.5) * TAU } else { random.unit() - 0.3 }).collect()
    }
}

fn served() -> Vec<&'static str> {
    catalogue::names().into_iter().filter(|n| !REFUSED.contains(n)).collect()
}

#[test]
fn random_configurations_are_found() {
    let count = share(100_000, 1_000);
    for name in served() {
        let case = Case::new(name);
        let mut random = Random(1);
        for _ in 0..count {
            let q = case.random(&mut random);
            let answer = case.solve(&q);
            assert!(case.holds(&answer, &q, 1e-4), "{name}: {q:?} is not among {answer:?}");
            for s in &answer.solutions {
                // A slide that is far out has rounding errors of its own.
                let far =
                    s.q.iter().zip(&case.is_angle).filter(|x| !x.1).map(|x| x.0.abs()).fold(1.0, f64::max);
                // Next to a singularity Newton's method ends where rounding does.
                let allowed = 1e-12 * far * (1e-4 / s.guard).max(1.0);
                assert!(s.residual <= allowed, "{name}: residual {} at {q:?}", s.residual);
                assert!(s.q.iter().all(|x| x.is_finite()));
            }
            for (i, s) in answer.solutions.iter().enumerate() {
                let again = answer.solutions[..i].iter().any(|t| case.near(&t.q, &s.q, 1e-7));
                assert!(!again, "{name}: twice {:?}", s.q);
            }
        }
    }
}

#[test]
fn special_configurations_are_found() {
    let values = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
    for name in served() {
        let case = Case::new(name);
        let n = case.is_angle.len();
        let total = 4_usize.pow(n as u32);
        let step = (total / share(4096, 160)).max(1) | 1;
        for number in (0..total).step_by(step) {
            let mut rest = number;
            let q: Vec<f64> = (0..n)
                .map(|j| {
                    let x = values[rest % 4];
                    rest /= 4;
                    if case.is_angle[j] { x } else { x / 4.0 }
                })
                .collect();
            let answer = case.solve(&q);
            assert!(case.holds(&answer, &q, 1e-5), "{name}: {q:?} is not among {answer:#?}");
        }
    }
}

/// The determinant of the geometric Jacobian of a robot with six joints.
fn determinant(robot: &Robot<f64>, q: &[f64]) -> f64 {
    let p = robot.pose(q).translation;
    let mut rows = vec![[0.0; 6]; 6];
    let mut before = robot.base;
    for link in &robot.links {
        let screw = before * link.before;
        let z = screw.rotation.z();
        let lever = z.cross(p - screw.translation);
        for &(j, k) in &link.theta.terms {
            for i in 0..3 {
                rows[j][i] += k * z[i];
                rows[j][3 + i] += k * lever[i];
            }
        }
        for &(j, k) in &link.d.terms {
            for i in 0..3 {
                rows[j][3 + i] += k * z[i];
            }
        }
        before = before * link.transform(q);
    }
    let mut product = 1.0;
    for k in 0..6 {
        let pivot = (k..6).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs())).expect("rows");
        if pivot != k {
            rows.swap(k, pivot);
            product = -product;
        }
        product *= rows[k][k];
        for i in k + 1..6 {
            let factor = if rows[k][k] == 0.0 { 0.0 } else { rows[i][k] / rows[k][k] };
            let pivot = rows[k];
            rows[i].iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
        }
    }
    product
}

/// Where the determinant changes its sign as one joint turns: wrist, elbow and shoulder singularities alike.
fn singular(robot: &Robot<f64>, q: &[f64], joint: usize) -> Vec<f64> {
    let at = |x: f64| {
        let mut q = q.to_vec();
        q[joint] = x;
        determinant(robot, &q)
    };
    let mut found = vec![];
    for k in 0..36 {
        let (mut low, mut high) = (-PI + TAU / 36.0 * f64::from(k), -PI + TAU / 36.0 * f64::from(k + 1));
        if at(low).signum() == at(high).signum() {
            continue;
        }
        let side = at(low).signum();
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if at(middle).signum() == side { low = middle } else { high = middle }
        }
        found.push(low);
    }
    found
}

#[test]
fn the_neighbourhood_of_singularities_is_solved() {
    let arms = served().into_iter().filter(|n| robot(n).variables().len() == 6 && *n != "prrrrp");
    for name in arms {
        let case = Case::new(name);
        let mut random = Random(3);
        let mut seen = 0;
        for _ in 0..share(100, 1) {
            let start = case.random(&mut random);
            for joint in (0..6).filter(|&j| case.is_angle[j]).collect::<Vec<_>>() {
                for x in singular(&case.robot, &start, joint) {
                    for exponent in 1..=16 {
                        let mut q = start.clone();
                        q[joint] = x + if exponent == 16 { 0.0 } else { 10_f64.powi(-exponent) };
                        let answer = case.solve(&q);
                        assert!(case.holds(&answer, &q, 1e-5), "{name}: {q:?} is not among {answer:#?}");
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 0, "{name} has singularities");
    }
}

#[test]
fn peers_count_the_same() {
    let peers: serde_json::Value = serde_json::from_str(include_str!("../peers/ik.json")).expect("JSON");
    let mut compared = 0;
    for (name, entry) in peers["robots"].as_object().expect("robots by name") {
        if REFUSED.contains(&name.as_str()) {
            continue;
        }
        let mut d = robot(name);
        for p in &mut d.parameters {
            if let Some(x) = entry["parameters"][&*p.symbol.name()].as_f64() {
                p.value = denavit_symbolic::Rational::from_decimal(&format!("{x}")).map(Into::into);
            }
        }
        let names: Vec<String> = d.variables().iter().map(|v| v.symbol.name().to_string()).collect();
        let given: Vec<usize> = entry["given"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|g| names.iter().position(|n| Some(n.as_str()) == g.as_str()).expect("a joint variable"))
            .collect();
        let options = InverseOptions {
            given: (!given.is_empty()).then_some(given.clone()),
            ..InverseOptions::default()
        };
        let m = match InverseModel::derive(&d, &options) {
            Ok(m) => m,
            // A slide and a slide: the peers give both where one is too many.
            Err(Refusal::Given(_)) => continue,
            Err(e) => panic!("{name}: {e}"),
        };
        let case = Case::with(&d, &m);
        for c in entry["cases"].as_array().expect("a list") {
            let Some(count) = c["count"].as_u64() else { continue };
            let q: Vec<f64> = c["q"].as_array().expect("joints").iter().filter_map(|x| x.as_f64()).collect();
            let answer = case.solve(&q);
            assert_eq!(answer.solutions.len() as u64, count, "{name} at {q:?}: {answer:#?}");
            assert!(answer.families.is_empty());
            compared += 1;
        }
    }
    assert!(compared > 3_000, "only {compared} cases were compared");
}

#[test]
fn no_closed_form_is_refused_with_reasons() {
    for name in REFUSED {
        match InverseModel::derive(&robot(name), &InverseOptions::default()) {
            Err(Refusal::Stuck(stuck)) => assert!(!stuck.missing.is_empty()),
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn long_chains_are_refused_at_once() {
    let rows = |n: usize| -> String {
        let joint = |k: usize| {
            format!("[[joints]]\ntheta = \"q{k}\"\nd = 0.1\na = 0.1\nalpha = \"{} deg\"\n", 30 + k)
        };
        (1..=n).map(joint).collect()
    };
    let text = format!("name = \"Long\"\nconvention = \"standard\"\n{}", rows(30));
    let d = description::read_toml(&text).expect("a robot").0;
    match InverseModel::derive(&d, &InverseOptions::default()) {
        Err(Refusal::Unsuitable(why)) => assert!(why.to_string().contains("30 joints"), "{why}"),
        other => panic!("{other:?}"),
    }
}

/// An arm of joints with these rows: offset along the axis, length, twist (radians).
fn stuck(rows: impl Iterator<Item = [f64; 3]>) -> Stuck {
    let joint = |(k, [d, a, alpha]): (usize, [f64; 3])| {
        format!("[[joints]]\ntheta = \"q{}\"\nd = {d}\na = {a}\nalpha = {alpha}\n", k + 1)
    };
    let joints: String = rows.enumerate().map(joint).collect();
    let text = format!("name = \"Random\"\nconvention = \"standard\"\n{joints}");
    let d = description::read_toml(&text).expect("a robot").0;
    match InverseModel::derive(&d, &InverseOptions::default()) {
        Err(Refusal::Stuck(stuck)) => *stuck,
        other => panic!("{other:?}"),
    }
}

/// Arms with two joints too many and nothing special about them: refused with little work.
#[test]
fn general_arms_with_eight_joints_are_refused_soon() {
    for seed in 1..=3 {
        let mut random = Random(seed);
        let found =
            stuck((0..8).map(|_| [0.1 + random.unit(), 0.1 + random.unit(), 3.0 * random.unit() - 1.5]));
        assert!(found.missing.len() == 8 && found.steps.is_empty());
        assert!(!found.is_spent && found.work <= MOST_WORK, "{}", found.work);
    }
}

#[test]
fn positions_alone_are_solved() {
    for name in ["planar-2r", "articulated-3r", "scara", "spherical-rrp", "cylindrical-rpp", "cartesian-ppp"]
    {
        let d = robot(name);
        let m = InverseModel::derive(&d, &InverseOptions { goal: Goal::Position, given: None })
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let case = Case::with(&d, &m);
        let mut random = Random(5);
        for _ in 0..500 {
            let q = case.random(&mut random);
            let answer = case.solve(&q);
            assert!(case.holds(&answer, &q, 1e-6), "{name}: {q:?} is not among {answer:#?}");
        }
    }
}

#[test]
fn poses_out_of_reach_say_what_is_in_the_way() {
    for name in ["ur5", "puma560", "planar-3r", "scara", "rhino-xr3"] {
        let case = Case::new(name);
        let q = vec![0.3; case.is_angle.len()];
        let near = case.robot.pose(&q);
        let far =
            Transform::from_rotation_translation(near.rotation, near.translation + Vector([30.0, 0.0, 0.0]));
        let answer = case.solver.solve(&far, &[]);
        assert!(!answer.is_reachable(), "{name}");
        assert!(answer.obstacle.is_some(), "{name}");
    }
}
