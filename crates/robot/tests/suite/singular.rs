//! At singular poses and next to them: never empty, and the configuration that a pose was made from is found, or lies in
//! a family that is reported.

use crate::common::{Random, robot, share};
use denavit::geometry::Transform;
use denavit::inverse::{Answer, InverseKinematics, InverseOptions};
use denavit::robot::Robot;
use std::f64::consts::{PI, TAU};

const OFFSETS: [f64; 7] = [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2];

/// The columns of the geometric Jacobian, lengths by the arm's size.
fn jacobian(robot: &Robot<f64>, q: &[f64]) -> Vec<[f64; 6]> {
    let size = robot.reach();
    let p = robot.pose(q).translation;
    let mut before = robot.base;
    let mut columns = vec![[0.0; 6]; robot.joints];
    for link in &robot.links {
        let screw = before * link.before;
        let z = screw.rotation.z();
        let lever = z.cross(p - screw.translation);
        for &(j, k) in &link.theta.terms {
            for i in 0..3 {
                columns[j][i] += k * z[i];
                columns[j][3 + i] += k * lever[i] / size;
            }
        }
        before = before * link.transform(q);
    }
    columns
}

/// Jᵀu at a configuration and a direction of the hand, and 1 − u·u.
fn lost(robot: &Robot<f64>, x: &[f64]) -> Vec<f64> {
    let (q, u) = x.split_at(robot.joints);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut rest: Vec<f64> = jacobian(robot, q).iter().map(|c| dot(c, u)).collect();
    rest.push(1.0 - dot(u, u));
    rest
}

/// A singular configuration near a random one: Newton's method with least norm on Jᵀu = 0, |u| = 1.
fn singular(robot: &Robot<f64>, random: &mut Random) -> Option<Vec<f64>> {
    let n = robot.joints;
    let mut x: Vec<f64> = (0..n).map(|_| TAU * random.unit() - PI).collect();
    x.extend((0..6).map(|_| random.unit() - 0.5));
    for _ in 0..60 {
        let f = lost(robot, &x);
        let worst = f.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if worst < 3e-16 {
            break;
        }
        // Central differences are exact enough: the method corrects itself.
        let columns: Vec<Vec<f64>> = (0..x.len())
            .map(|k| {
                let mut moved = x.clone();
                moved[k] += 1e-6;
                let plus = lost(robot, &moved);
                moved[k] -= 2e-6;
                let minus = lost(robot, &moved);
                plus.iter().zip(&minus).map(|(a, b)| (a - b) / 2e-6).collect()
            })
            .collect();
        // y with (A·Aᵀ + λ) y = f, then x − Aᵀ y.
        let rows = f.len();
        let mut m: Vec<Vec<f64>> = (0..rows)
            .map(|i| {
                let mut row: Vec<f64> =
                    (0..rows).map(|j| columns.iter().map(|c| c[i] * c[j]).sum()).collect();
                row[i] += 1e-13;
                row.push(f[i]);
                row
            })
            .collect();
        for k in 0..rows {
            let pivot = (k..rows).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs()))?;
            m.swap(k, pivot);
            for i in (0..rows).filter(|&i| i != k) {
                let factor = m[i][k] / m[k][k];
                let row = m[k].clone();
                m[i].iter_mut().zip(&row).for_each(|(a, b)| *a -= factor * b);
            }
        }
        let y: Vec<f64> = (0..rows).map(|k| m[k][rows] / m[k][k]).collect();
        for (xk, c) in x.iter_mut().zip(&columns) {
            *xk -= c.iter().zip(&y).map(|(a, b)| a * b).sum::<f64>();
        }
    }
    let worst = lost(robot, &x).iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut q = x[..n].to_vec();
    q.iter_mut().for_each(|a| *a -= TAU * (*a / TAU).round());
    (worst < 1e-14).then_some(q)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| ((x - y) - TAU * ((x - y) / TAU).round()).abs()).fold(0.0, f64::max)
}

/// The smallest singular value of the Jacobian, by rotations between pairs of its rows (Hestenes 1958): exact to the
/// rounding of its largest.
fn least_singular_value(robot: &Robot<f64>, q: &[f64]) -> f64 {
    let columns = jacobian(robot, q);
    let mut rows: Vec<Vec<f64>> = (0..6).map(|i| columns.iter().map(|c| c[i]).collect()).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    for (i, k) in (0..12).flat_map(|_| (0..6).flat_map(|i| (i + 1..6).map(move |k| (i, k)))) {
        let (a, b) = (rows[i].clone(), rows[k].clone());
        let angle = 0.5 * (2.0 * dot(&a, &b)).atan2(dot(&a, &a) - dot(&b, &b));
        let (s, c) = angle.sin_cos();
        rows[i] = a.iter().zip(&b).map(|(x, y)| c * x + s * y).collect();
        rows[k] = a.iter().zip(&b).map(|(x, y)| c * y - s * x).collect();
    }
    rows.iter().map(|r| dot(r, r).sqrt()).fold(f64::INFINITY, f64::min)
}

/// What a pose of doubles is rounded to, twice: when it is made and when it is solved.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// What a configuration that has a pose may miss it by: the rounding of a chain of links, and of the solver's equations.
const REACHED: f64 = 1e-13;

/// How far the hand is from a pose: the worst entry of the matrix, lengths by the arm's size as residuals count it.
fn miss(robot: &Robot<f64>, pose: &Transform<f64>, q: &[f64]) -> f64 {
    let have = robot.pose(q);
    let size = robot.reach().hypot(pose.translation.norm());
    let away = (have.translation - pose.translation).norm() / size;
    let turned = have.rotation.rows().into_iter().flatten().zip(pose.rotation.rows().into_iter().flatten());
    turned.map(|(a, b)| (a - b).abs()).fold(away, f64::max)
}

/// Whether a configuration with the pose cannot be told apart from another by a pose of doubles: the poses of all between
/// them, on a line that may be bent, differ by no more than rounding. They differ by σ·distance, σ the smallest singular
/// value; at two roots that meet, σ at the roots is twice its mean between them, so that such roots stay two.
fn is_same(robot: &Robot<f64>, pose: &Transform<f64>, found: &[f64], q: &[f64]) -> bool {
    let away = distance(found, q);
    let sigma = || least_singular_value(robot, found).max(least_singular_value(robot, q));
    away <= 1e-4 || away <= 1e-2 && away * sigma() <= ROUNDING && miss(robot, pose, found) <= REACHED
}

/// Whether a configuration is among the solutions or in a family.
fn holds(solver: &InverseKinematics, pose: &Transform<f64>, answer: &Answer, q: &[f64]) -> bool {
    let robot = solver.robot.clone();
    answer.solutions.iter().any(|s| is_same(&robot, pose, &s.q, q))
        || solver.nearest(pose, answer, q).is_some_and(|n| is_same(&robot, pose, &n.q, q))
}

/// Every solution that is returned reaches the pose.
fn reach_the_pose(solver: &InverseKinematics, pose: &Transform<f64>, answer: &Answer) -> bool {
    let all = answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative));
    all.map(|s| miss(&solver.robot, pose, &s.q)).all(|missed| missed <= 1e-9)
}

/// The solver of a robot without limits.
fn solver(name: &str) -> InverseKinematics {
    let mut description = robot(name);
    description.rows.iter_mut().for_each(|r| r.limits = None);
    InverseKinematics::new(&description, &InverseOptions::default()).expect("numbers")
}

/// What the answer to the pose of a configuration lacks, if anything.
fn lack(solver: &InverseKinematics, q: &[f64]) -> Option<&'static str> {
    let pose = solver.robot.pose(q);
    let answer = solver.solve(&pose, &[]);
    assert!(reach_the_pose(solver, &pose, &answer), "{q:?}: {answer:?}");
    match answer.is_reachable() {
        false => Some("empty"),
        true => (!holds(solver, &pose, &answer, q)).then_some("missed"),
    }
}

fn solve_near_singular(name: &str, count: usize) {
    let solver = solver(name);
    let mut random = Random(7);
    let (mut lacking, mut tried) = (vec![], 0);
    while tried < count * OFFSETS.len() {
        let Some(at) = singular(&solver.robot, &mut random) else { continue };
        let way: Vec<f64> = at.iter().map(|_| random.unit() - 0.5).collect();
        for offset in OFFSETS {
            let q: Vec<f64> = at.iter().zip(&way).map(|(x, d)| x + offset * d).collect();
            tried += 1;
            lacking.extend(lack(&solver, &q).map(|what| (what, offset, q)));
        }
    }
    let count = |what: &str| lacking.iter().filter(|l| l.0 == what).count();
    println!("{name}: {tried} poses, {} empty, {} missed", count("empty"), count("missed"));
    assert!(lacking.is_empty(), "{name}: {lacking:?}");
}

#[test]
fn ur5() {
    solve_near_singular("ur5", share(1000, 40));
}

#[test]
fn puma() {
    solve_near_singular("puma560", share(1000, 40));
}

#[test]
fn rx90() {
    solve_near_singular("staubli-rx90", share(1000, 40));
}

#[test]
fn crx() {
    solve_near_singular("fanuc-crx10ia-l", share(1000, 40));
}

#[test]
fn iiwa() {
    solve_near_singular("kuka-iiwa-14", share(1000, 40));
}

#[test]
fn panda() {
    solve_near_singular("franka-panda", share(1000, 40));
}

/// The last joint has a single value where the elbow is stretched and the flange turned in or out, and a few near it; near
/// the other configuration there is none in a narrow part of the circle.
#[test]
fn narrow_parts_of_a_circle_are_found() {
    let solver = solver("franka-panda");
    let stretched = -(82.5_f64 / 316.0).atan() - (82.5_f64 / 384.0).atan();
    let way = [0.31, -0.22, 0.43, 0.17, -0.38, 0.09, -0.27];
    for (q5, q6) in [(0.0, 1.0), (PI, 2.0)] {
        let at = [0.3, 0.5, -0.4, stretched, q5, q6, 0.7];
        for offset in OFFSETS {
            let q: Vec<f64> = at.iter().zip(&way).map(|(x, d)| x + offset * d).collect();
            assert_eq!(lack(&solver, &q), None, "{q:?}");
        }
    }
    let q = [
        -0.9962661677382091,
        0.5998734567394609,
        2.477990871390394,
        2.613591150030227,
        -1.5708328391908686,
        -1.7113874875870494,
        -2.2144113117926834,
    ];
    assert_eq!(lack(&solver, &q), None, "{q:?}");
}
