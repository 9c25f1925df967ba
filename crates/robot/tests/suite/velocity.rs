//! Jacobians: proofs, counts, and numbers beside finite differences; velocities near singular configurations.

use crate::common::{Random, case, numbers, robot, with_values};
use denavit::description::Description;
use denavit::forward::{Proof, Reference};
use denavit::geometry::orientation::{EulerSet, OrientationSet, extract};
use denavit::geometry::{Axis, Transform, Vector};
use denavit::velocity::{
    Blocks, Damping, Jacobian, JacobianModel, Obstacle, Place, ROWS, RateFormulas, RateSolver, Singularities,
    Viewpoint, analytic, determinant, geometric, hessian_program, jacobian_and_pose_program,
    jacobian_program, largest_wrench, measures, nearest_singularity, rate_program, torques,
};
use denavit::{Robot, catalogue};
use denavit_program::Program;
use denavit_symbolic::Expr;
use serde_json::Value;

/// The robots of the five documents.
const SOURCES: [&str; 6] =
    ["staubli-rx90", "stanford", "prrrrp", "ur3-lab", "cylindrical-wrist", "smart5-six-rail"];

#[test]
fn jacobians_are_proved_to_be_derivatives() {
    for name in SOURCES.iter().chain(&["puma560", "scara", "parallelogram-5r", "kuka-iiwa-14"]) {
        let d = robot(name);
        let n = d.rows.len();
        let shortest = JacobianModel::shortest(&d, Reference::Frame(n));
        assert_eq!(shortest.proof, Proof::Proved, "{name}");
        for view in [Viewpoint::tool(), Viewpoint::of(Reference::Frame(n / 2), Reference::Frame(1))] {
            let model = JacobianModel::derive(&d, view);
            assert_eq!(model.proof, Proof::Proved, "{name} {view:?}");
        }
    }
}

/// With one entry's sign turned, or two rows exchanged, the proof fails.
#[test]
fn what_is_wrong_is_not_proved() {
    let d = robot("staubli-rx90");
    let view = Viewpoint::of(Reference::Frame(6), Reference::Frame(3));
    let right = JacobianModel::derive(&d, view);
    assert_eq!(right.proof, Proof::Proved);
    let matrix = right.matrix.unwrap();
    let mut turned = matrix.clone();
    turned.columns[0][2] = -turned.columns[0][2];
    let mut exchanged = matrix;
    exchanged.columns.iter_mut().for_each(|c| c.swap(3, 4));
    for wrong in [turned, exchanged] {
        assert_eq!(JacobianModel::of(&d, view, wrong).proof, Proof::Failed);
    }
}

/// The shortest Jacobian: multiplications and additions.
#[test]
fn shortest_jacobians() {
    let expected = [
        ("staubli-rx90", 6, 3),
        ("puma560", 9, 5),
        ("ur5", 9, 6),
        ("stanford", 5, 0),
        ("cylindrical-wrist", 2, 0),
        ("smart5-six-rail", 9, 6),
    ];
    for (name, multiplications, additions) in expected {
        let d = robot(name);
        let model = JacobianModel::shortest(&d, Reference::Frame(d.rows.len()));
        let count = model.algorithm.count();
        assert_eq!((count.multiplications, count.additions), (multiplications, additions), "{name}");
    }
}

/// Jacobian and J̇q̇, to 1e-12 of the reach.
#[test]
fn pinocchio_agrees() {
    let peer: Value = serde_json::from_str(include_str!("../peers/jacobian.json")).expect("valid JSON");
    let robots = peer["robots"].as_object().expect("robots");
    assert_eq!(robots.len(), 17);
    for (name, case) in robots {
        let d = with_values(robot(name), &case["parameters"]);
        let numeric = Robot::numeric(&d).expect("values");
        let bound = 1e-12 * numeric.reach().max(1.0);
        let rates = rate_program(&d, &Viewpoint::tool());
        for sample in case["samples"].as_array().expect("samples") {
            let q = numbers(&sample["q"]);
            let jacobian = geometric(&numeric, &q, &Viewpoint::tool()).rows();
            for (row, expected) in jacobian.iter().zip(sample["jacobian"].as_array().expect("rows")) {
                let expected = numbers(expected);
                assert_eq!(row.len(), expected.len());
                assert!(row.iter().zip(expected).all(|(a, b)| (a - b).abs() <= bound), "{name}");
            }
            let found = run(&d, &rates, &[q.clone(), numbers(&sample["rates"])].concat());
            let (drift, expected) = (&found[6 * q.len()..], numbers(&sample["drift"]));
            assert!(drift.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 20.0 * bound), "{name}");
        }
    }
}

fn numeric(name: &str) -> (Description, Robot<f64>) {
    let d = robot(name);
    let numeric = Robot::numeric(&d).unwrap_or_else(|e| panic!("{name}: {e}"));
    (d, numeric)
}

fn angles(d: &Description) -> Vec<bool> {
    d.variables().iter().map(|v| v.kind == denavit::description::JointKind::Revolute).collect()
}

fn random_configuration(random: &mut Random, n: usize) -> Vec<f64> {
    (0..n).map(|_| 3.0 * (2.0 * random.unit() - 1.0)).collect()
}

/// Runs a program on a robot's own values.
fn run(d: &Description, program: &Program, inputs: &[f64]) -> Vec<f64> {
    let parameters = d.values(program.parameters()).expect("every parameter has a value");
    program.compile(&parameters).scalar().eval(inputs).to_vec()
}

/// Twist by central differences of the pose.
fn by_differences(robot: &Robot<f64>, q: &[f64], j: usize) -> [f64; 6] {
    let h = 1e-5;
    let at = |by: f64| {
        let mut q = q.to_vec();
        q[j] += by;
        robot.pose(&q)
    };
    let (a, b, here) = (at(-h), at(h), robot.pose(q));
    let v = (b.translation - a.translation).scale(0.5 / h);
    let mut w = Vector::zero();
    for axis in Axis::ALL {
        let rate = (b.rotation.column(axis) - a.rotation.column(axis)).scale(0.5 / h);
        w = w + here.rotation.column(axis).cross(rate).scale(0.5);
    }
    [v[0], v[1], v[2], w[0], w[1], w[2]]
}

#[test]
fn every_robot_agrees_with_differences_and_its_program() {
    let mut random = Random(6);
    for name in catalogue::names() {
        let d = robot(name);
        let Ok(numeric) = Robot::numeric(&d) else { continue };
        let view = Viewpoint::tool();
        let with_pose = jacobian_and_pose_program(&d, &Viewpoint::tool());
        for _ in 0..3 {
            let q = random_configuration(&mut random, numeric.joints);
            let jacobian = geometric(&numeric, &q, &view);
            for (j, column) in jacobian.columns.iter().enumerate() {
                let near = by_differences(&numeric, &q, j);
                for (a, b) in column.iter().zip(near) {
                    assert!((a - b).abs() < 1e-7 * numeric.reach().max(1.0), "{name}");
                }
            }
            let results = run(&d, &with_pose, &q);
            let rows = jacobian.rows().concat();
            let pose: Vec<f64> = numeric.pose(&q).matrix().concat();
            for (a, b) in results.iter().zip(rows.iter().chain(&pose)) {
                assert!((a - b).abs() < 1e-13 * numeric.reach().max(1.0), "{name}: {a} {b}");
            }
        }
    }
}

/// Any body, point and frame: the twist follows from that of the tool by a rotation and a lever arm.
#[test]
fn viewpoints_are_one_twist() {
    let mut random = Random(7);
    for name in ["puma560", "smart5-six-rail", "parallelogram-5r"] {
        let (d, numeric) = numeric(name);
        let n = d.rows.len();
        let references = (0..=n).map(Reference::Frame).chain([Reference::Base, Reference::Tool]);
        for axes in references {
            let q = random_configuration(&mut random, numeric.joints);
            let at = Reference::Frame(n / 2);
            let offset = Vector([0.1, -0.2, 0.3]);
            let view = Viewpoint { axes, body: Reference::Tool, at, offset };
            let symbolic = Viewpoint { axes, body: Reference::Tool, at, offset: offset.map(tenths) };
            let seen = geometric(&numeric, &q, &view);
            let tool = geometric(&numeric, &q, &Viewpoint::tool());
            let frames = numeric.frames(&q);
            let frame = match axes {
                Reference::Base => Transform::identity(),
                Reference::Frame(i) => frames[i],
                Reference::Tool => numeric.pose(&q),
            };
            let lever = frames[n / 2].act_on_point(offset) - numeric.pose(&q).translation;
            for (a, b) in seen.columns.iter().zip(&tool.columns) {
                let w = Vector([b[3], b[4], b[5]]);
                let v = Vector([b[0], b[1], b[2]]) + w.cross(lever);
                let (v, w) = (frame.rotation.inverse() * v, frame.rotation.inverse() * w);
                let expected = [v[0], v[1], v[2], w[0], w[1], w[2]];
                assert!(a.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-12), "{name}");
            }
            let results = run(&d, &jacobian_program(&d, &symbolic), &q);
            let rows = seen.rows().concat();
            assert!(results.iter().zip(rows).all(|(x, y)| (x - y).abs() < 1e-12), "{name}");
        }
    }
}

/// A multiple of 1/10 as an exact number.
fn tenths(x: f64) -> Expr {
    Expr::int((x * 10.0).round() as i64) / Expr::int(10)
}

#[test]
fn derivatives_of_jacobians() {
    let mut random = Random(8);
    for name in ["ur5", "stanford", "kuka-iiwa-14"] {
        let (d, numeric) = numeric(name);
        let n = numeric.joints;
        let view = Viewpoint::tool();
        let (rates, hessian) =
            (rate_program(&d, &Viewpoint::tool()), hessian_program(&d, &Viewpoint::tool()));
        for _ in 0..20 {
            let q = random_configuration(&mut random, n);
            let qd = random_configuration(&mut random, n);
            let h = 1e-5;
            let at = |by: f64| -> Vec<f64> {
                let moved: Vec<f64> = q.iter().zip(&qd).map(|(a, b)| a + by * b).collect();
                geometric(&numeric, &moved, &view).rows().concat()
            };
            let near: Vec<f64> = at(h).iter().zip(at(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            let found = run(&d, &rates, &[q.clone(), qd.clone()].concat());
            assert!(found[..6 * n].iter().zip(&near).all(|(a, b)| (a - b).abs() < 1e-6), "{name}");
            for r in 0..6 {
                let product: f64 = (0..n).map(|j| found[r * n + j] * qd[j]).sum();
                assert!((product - found[6 * n + r]).abs() < 1e-12 * product.abs().max(1.0));
            }
            let second = run(&d, &hessian, &q);
            for (entry, rate) in second.chunks(n).zip(&found) {
                let sum: f64 = entry.iter().zip(&qd).map(|(a, b)| a * b).sum();
                assert!((sum - rate).abs() < 1e-12 * rate.abs().max(10.0), "{name}");
            }
        }
    }
}

#[test]
fn analytic_jacobians_of_every_set() {
    let mut random = Random(9);
    let (_, numeric) = numeric("puma560");
    let sets = EulerSet::ALL.iter().map(|&s| OrientationSet::Euler(s)).chain([
        OrientationSet::Rpy,
        OrientationSet::Quaternion,
        OrientationSet::AxisAngle,
        OrientationSet::Matrix,
    ]);
    for set in sets {
        for _ in 0..10 {
            let q = random_configuration(&mut random, 6);
            let values = |q: &[f64]| {
                let x = numeric.pose(q);
                let o = extract(&x.rotation, set);
                (x.translation.0.into_iter().chain(o.values).collect::<Vec<f64>>(), o.singular)
            };
            let (here, _) = values(&q);
            if determinant(set, &here[3..]).is_some_and(|d: f64| d.abs() < 0.05) {
                continue;
            }
            let found = analytic(&geometric(&numeric, &q, &Viewpoint::tool()), set, &here[3..]);
            for j in 0..6 {
                let at = |by: f64| {
                    let mut q = q.clone();
                    q[j] += by;
                    values(&q).0
                };
                let (a, b) = (at(-1e-6), at(1e-6));
                for (row, (x, y)) in found.rows.iter().zip(a.iter().zip(&b)) {
                    let near = (y - x) / 2e-6;
                    // Values jump where a set does: at ±π, or a quaternion's sign.
                    let is_jump = near.abs() > 1e4;
                    assert!(
                        is_jump || (row[j] - near).abs() < 1e-5 * near.abs().max(1.0),
                        "{set} {near} {}",
                        row[j]
                    );
                }
            }
        }
    }
}

/// The stretched wrist of a PUMA: one direction lost, joints 4 and 6 free against each other.
#[test]
fn a_singular_wrist() {
    let (d, numeric) = numeric("puma560");
    let q = [0.3, -0.4, 0.5, 0.6, 0.0, 0.7];
    let view = Viewpoint::tool();
    let jacobian = geometric(&numeric, &q, &view);
    let m = measures(&jacobian, &angles(&d), numeric.reach());
    let w = &m.whole;
    assert_eq!((w.rank, w.lost.len(), w.free.len()), (5, 1, 1));
    assert!(w.condition.is_infinite() && w.manipulability < 1e-15);
    let free = &w.free[0];
    assert!((free[3] + free[5]).abs() < 1e-12 && free[3].abs() > 0.7 && free[0].abs() < 1e-12);
    assert!(jacobian.twist(free).iter().all(|t| t.abs() < 1e-12));
    let [lost] = &w.lost[..] else { panic!("one direction") };
    for column in &jacobian.columns {
        let scaled: f64 =
            (0..6).map(|r| lost[r] * if r < 3 { column[r] / m.length } else { column[r] }).sum();
        assert!(scaled.abs() < 1e-12);
    }
    let mut beside = q;
    beside[4] = 0.1;
    let found =
        nearest_singularity(&numeric, &view, &angles(&d), numeric.reach(), &beside).expect("the wrist");
    assert!(found.q[4].abs() < 1e-6 && (found.distance - 0.1).abs() < 0.01, "{found:?}");
}

/// Twists through singular configurations: joint velocities bounded by the damping's gain, without jumps.
#[test]
fn velocities_through_singularities() {
    let mut random = Random(10);
    let singular: [(&str, &[(usize, f64)]); 4] = [
        ("puma560", &[(4, 0.0)]),
        ("staubli-rx90", &[(2, std::f64::consts::FRAC_PI_2)]),
        ("ur5", &[(2, 0.0)]),
        ("kuka-iiwa-14", &[(3, 0.0), (5, 0.0)]),
    ];
    for (name, held) in singular {
        let (d, numeric) = numeric(name);
        let n = numeric.joints;
        let size = numeric.reach();
        let is_angle = angles(&d);
        let solver = RateSolver::new(&is_angle, size);
        for _ in 0..2_500 {
            let mut through = random_configuration(&mut random, n);
            held.iter().for_each(|&(j, x)| through[j] = x);
            let direction = random_configuration(&mut random, n);
            let twist: [f64; 6] = std::array::from_fn(|_| random.unit() - 0.5);
            let norm =
                (0..6).map(|r| (if r < 3 { twist[r] / size } else { twist[r] }).powi(2)).sum::<f64>().sqrt();
            let at = |by: f64| -> (Jacobian<f64>, Vec<f64>) {
                let q: Vec<f64> = through.iter().zip(&direction).map(|(a, b)| a + by * b).collect();
                let jacobian = geometric(&numeric, &q, &Viewpoint::tool());
                let rates = solver.solve(&jacobian, &twist, &[]).rates;
                (jacobian, rates)
            };
            let mut before: Option<Vec<f64>> = None;
            for step in -3..=3 {
                let (_, rates) = at(1e-6 * f64::from(step));
                let length = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
                assert!(length <= 1.001 * solver.damping.gain() * norm, "{name}");
                if let Some(before) = before {
                    let jump = rates.iter().zip(&before).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                    // |dq̇/ds| is bounded by the gain, twice, times how fast J changes.
                    assert!(jump < 1e-6 * 40.0 * solver.damping.gain().powi(2) * norm, "{name} {jump}");
                }
                before = Some(rates);
            }
        }
    }
}

#[test]
fn rates_meet_the_twist_where_they_can() {
    let (d, numeric) = numeric("kuka-iiwa-14");
    let is_angle = angles(&d);
    let q = [0.3, 0.7, -0.2, -1.3, 0.4, 0.8, 0.1];
    let jacobian = geometric(&numeric, &q, &Viewpoint::tool());
    let twist = [0.1, -0.2, 0.05, 0.3, 0.1, -0.2];
    let mut solver = RateSolver::new(&is_angle, numeric.reach());
    solver.damping = Damping { threshold: 1e-3, largest: 1e-3 };
    let wish = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    for wished in [&[][..], &wish] {
        let found = solver.solve(&jacobian, &twist, wished);
        assert!(found.achieved.iter().zip(twist).all(|(a, b)| (a - b).abs() < 1e-12));
        assert!(found.damped.is_empty() && found.scale == 1.0);
    }
    // The wish is followed as far as it can be: not at all against the twist.
    let (least, with_wish) = (solver.solve(&jacobian, &twist, &[]), solver.solve(&jacobian, &twist, &wish));
    assert!(with_wish.rates[2] > least.rates[2] + 0.01);
    // Limits keep the direction.
    solver.limits = vec![0.05; 7];
    let limited = solver.solve(&jacobian, &twist, &[]);
    assert!(limited.scale < 1.0 && limited.rates.iter().all(|r| r.abs() <= 0.05 + 1e-15));
    let ratio = |k: usize| limited.achieved[k] / twist[k];
    assert!((0..6).all(|k| (ratio(k) - limited.scale).abs() < 1e-9));
    // Position alone.
    solver.limits.clear();
    solver.rows = [true, true, true, false, false, false];
    let position = solver.solve(&jacobian, &twist, &[]);
    assert!((0..3).all(|k| (position.achieved[k] - twist[k]).abs() < 1e-12));
    let length = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
    assert!(length(&position.rates) < length(&least.rates));
}

#[test]
fn wrenches() {
    let (_, numeric) = numeric("planar-2r");
    let jacobian = geometric(&numeric, &[0.0, std::f64::consts::FRAC_PI_2], &Viewpoint::tool());
    let wrench = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0];
    let held = torques(&jacobian, &wrench);
    // Virtual work.
    for (j, column) in jacobian.columns.iter().enumerate() {
        let work: f64 = column.iter().zip(wrench).map(|(a, b)| a * b).sum();
        assert_eq!(work, held[j]);
    }
    let (factor, joint) = largest_wrench(&jacobian, &[10.0, 0.5], &wrench).expect("joints hold it");
    let scaled = torques(&jacobian, &wrench.map(|w| w * factor));
    assert!((scaled[joint].abs() - [10.0, 0.5][joint]).abs() < 1e-12);
    assert!(scaled.iter().zip([10.0, 0.5]).all(|(t, l)| t.abs() <= l + 1e-12));
    // A force along the axes of both joints is held by the structure.
    assert_eq!(largest_wrench(&jacobian, &[10.0, 0.5], &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]), None);
    assert_eq!(ROWS.len(), 6);
}

/// det J in factors, and what happens where each is 0.
#[test]
fn singularities_have_names() {
    let body = |d: &Description| Reference::Frame(d.rows.len());
    let wrist = || vec![3, 4, 5];
    let expected: [(&str, &str, Vec<Place>); 6] = [
        (
            "staubli-rx90",
            "D3*RL4*cos(q3)*sin(q5)*(D3*cos(q2) - RL4*sin(q2 + q3))",
            vec![
                Place::CentreInPlane { wrist: wrist(), axes: [1, 2], parallel: true },
                Place::OneLine(3, 5),
                Place::CentreOnAxis { wrist: wrist(), axis: 0 },
            ],
        ),
        (
            "ur5",
            "a2*a3*sin(q3)*sin(q5)*(a2*cos(q2) + a3*cos(q2 + q3) + d5*sin(q2 + q3 + q4))",
            vec![
                Place::OnePlane(vec![1, 2, 3]),
                Place::Parallel(vec![1, 2, 3, 5]),
                Place::Line { meets: vec![0, 4, 5], parallel: vec![1, 2, 3] },
            ],
        ),
        (
            "puma560",
            "a2*sin(q5)*(d4*cos(q3) + a3*sin(q3))*(a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3))",
            vec![
                Place::OneLine(3, 5),
                Place::CentreInPlane { wrist: wrist(), axes: [1, 2], parallel: true },
                Place::CentreInPlane { wrist: wrist(), axes: [0, 1], parallel: false },
            ],
        ),
        (
            "stanford",
            "q3^2*sin(q2)*sin(q5)",
            vec![
                Place::CentreOnAxis { wrist: wrist(), axis: 1 },
                Place::CentreInPlane { wrist: wrist(), axes: [0, 1], parallel: false },
                Place::OneLine(3, 5),
            ],
        ),
        ("scara", "-a1*a2*sin(q2)", vec![Place::OnePlane(vec![0, 1, 3])]),
        (
            "cylindrical-wrist",
            "(a3 + a4 + a5 + q3)*sin(q5)",
            vec![Place::CentreOnAxis { wrist: wrist(), axis: 1 }, Place::OneLine(3, 5)],
        ),
    ];
    for (name, determinant, places) in expected {
        let d = robot(name);
        let found = Singularities::derive(&d, body(&d)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(found.is_complete && found.minors.len() == 1, "{name}");
        assert_eq!(found.minors[0].determinant.to_string(), determinant, "{name}");
        let why: Vec<&Place> = found.common.iter().flat_map(|s| &s.example).map(|e| &e.place).collect();
        assert_eq!(why, places.iter().collect::<Vec<_>>(), "{name}");
    }
}

/// At each example the Jacobian has lost one rank, and what is said to be free moves nothing.
#[test]
fn examples_are_singular() {
    for name in ["staubli-rx90", "puma560", "ur5", "smart5-six-rail", "abb-irb2400-10"] {
        let (d, numeric) = numeric(name);
        let found = Singularities::derive(&d, Reference::Tool).unwrap_or_else(|e| panic!("{name}: {e}"));
        for s in &found.common {
            let Some(example) = &s.example else { continue };
            let jacobian = geometric(&numeric, &example.q, &Viewpoint::tool());
            let whole = measures(&jacobian, &angles(&d), numeric.reach()).whole;
            assert_eq!(whole.rank, numeric.joints.min(6) - 1, "{name} {}", s.factor);
            for free in &example.free {
                assert!(jacobian.twist(free).iter().all(|t| t.abs() < 1e-6), "{name} {}", s.factor);
            }
        }
    }
}

/// An S-R-S arm: S4 = 0 in all minors; with joint 3 held what its six others lose.
#[test]
fn singularities_of_a_redundant_arm() {
    let d = robot("kuka-iiwa-14");
    let found = Singularities::derive(&d, Reference::Frame(d.rows.len())).expect("short enough");
    assert_eq!(found.minors.len(), 6);
    let held = found.minors.iter().find(|m| !m.joints.contains(&2)).expect("joint 3 held");
    let factors: Vec<String> = held.determinant.factors.iter().map(|f| f.0.to_string()).collect();
    assert!(
        factors.contains(&"sin(q4)".to_string()) && factors.contains(&"sin(q6)".to_string()),
        "{factors:?}"
    );
    let common: Vec<String> = found.common.iter().map(|s| s.factor.to_string()).collect();
    assert_eq!(common, ["sin(q4)"]);
    assert!(!found.is_complete);
}

/// The formulas for joint velocities undo the Jacobian, by proof and in numbers.
#[test]
fn joint_velocities_as_formulas() {
    let with_wrist = ["staubli-rx90", "puma560", "stanford", "cylindrical-wrist", "articulated-3r"];
    let by_rows = ["ur5", "ur10e", "techman-tm5-700"];
    for name in with_wrist.into_iter().chain(by_rows) {
        let d = robot(name);
        let jacobian = match d.variables().len() {
            3 if with_wrist.contains(&name) => JacobianModel::shortest_at_origin(&d, Reference::Tool),
            _ => JacobianModel::shortest(&d, Reference::Frame(d.rows.len())),
        };
        let rates =
            RateFormulas::derive(&d, &jacobian).expect("short").unwrap_or_else(|| panic!("{name}: blocks"));
        assert!(rates.is_proved, "{name}");
        assert_eq!(matches!(rates.blocks, Blocks::Rows), by_rows.contains(&name), "{name}");
        let asked: Vec<Expr> = rates.steps.iter().map(|s| s.1).collect();
        let is_asked = |row: &str| asked.iter().flat_map(|e| e.symbols()).any(|s| *s.name() == *row);
        assert_eq!(ROWS.iter().filter(|row| is_asked(row)).count(), d.variables().len(), "{name}");
        let mut known: Vec<(String, f64)> = vec![];
        let variables = d.variables();
        let mut random = Random(12);
        for (k, row) in ROWS.iter().enumerate() {
            known.push((row.to_string(), 0.1 * (k as f64) - 0.2));
        }
        for p in &d.parameters {
            let value = p.number().unwrap_or(0.3 + random.unit());
            known.push((p.symbol.name().to_string(), value));
        }
        for v in &variables {
            known.push((v.symbol.name().to_string(), 0.4 + random.unit()));
        }
        let value = |known: &[(String, f64)], e: Expr| {
            e.eval(|s| known.iter().find(|k| k.0 == *s.name()).map(|k| k.1)).expect("all is known")
        };
        for (step, e) in &rates.steps {
            let x = value(&known, *e);
            known.push((step.clone(), x));
        }
        let matrix = jacobian.matrix.expect("short");
        for (r, row) in matrix.rows().iter().enumerate().filter(|(r, _)| is_asked(ROWS[*r])) {
            let entries = row.iter().map(|&e| value(&known, e));
            let rate = |v: &denavit::description::Variable| {
                value(&known, Expr::symbol(&format!("d{}", v.symbol.name())))
            };
            let found: f64 = entries.zip(&variables).map(|(e, v)| e * rate(v)).sum();
            assert!((found - (0.1 * (r as f64) - 0.2)).abs() < 1e-10, "{name} {r}");
        }
    }
    let general = robot("oblique-6r");
    let whole = JacobianModel::shortest(&general, Reference::Frame(6));
    assert!(RateFormulas::derive(&general, &whole).expect("short").is_none(), "no blocks");
}

/// The textbook's determinants: of the position alone.
#[test]
fn singularities_of_the_position() {
    for (name, determinant) in [("planar-2r", "a1*a2*sin(q2)"), ("articulated-3r", "")] {
        let d = robot(name);
        let found = Singularities::of_position(&d, Reference::Tool).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(found.is_complete, "{name}");
        if !determinant.is_empty() {
            assert_eq!(found.minors[0].determinant.to_string(), determinant);
        }
        for s in &found.common {
            let example = s.example.as_ref().unwrap_or_else(|| panic!("{name} {}", s.factor));
            assert!(example.lost.iter().all(|w| w[3..].iter().all(|x| *x == 0.0)), "{name}");
        }
    }
    // A link in the middle of the arm: joints behind it do not count.
    let d = robot("ur5");
    let found = Singularities::derive(&d, Reference::Frame(3)).expect("three joints move it");
    assert!(found.minors.iter().all(|m| m.joints == [0, 1, 2]));
}

/// Moving joint 5 alone makes a UR5 singular: nothing further away is called the nearest.
#[test]
fn the_nearest_singularity_is_no_further_than_one_joint_away() {
    let mut random = Random(13);
    for name in ["ur5", "puma560", "abb-irb120", "stanford-manipulator"] {
        let (d, numeric) = numeric(name);
        for _ in 0..10 {
            let q = random_configuration(&mut random, 6);
            let found = nearest_singularity(&numeric, &Viewpoint::tool(), &angles(&d), numeric.reach(), &q);
            let found = found.unwrap_or_else(|| panic!("{name}"));
            let wrist = q[4].sin().abs().asin();
            // Newton's method ends a little beside the place where it starts.
            assert!(found.distance <= 1.02 * wrist + 1e-3, "{name}: {} {wrist}", found.distance);
        }
    }
}

/// The determinant of a calibrated arm has thousands of terms: it is refused, and quickly.
#[test]
fn determinants_that_nobody_reads_are_refused() {
    for name in ["ur5cal", "g1off"] {
        let refused = Singularities::derive(&case(name), Reference::Tool).expect_err(name);
        assert!(matches!(refused, Obstacle::TooLarge(_)), "{name}: {refused}");
    }
}
