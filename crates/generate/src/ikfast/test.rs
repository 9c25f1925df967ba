//! The test of the interface: the vectors of the functions behind it, in its words.

use super::{Interface, Kind, Solver};
use crate::tables::{list, table, wrapped};
use denavit::geometry::Transform;
use denavit_emit::{Certificate, SolverVector};

/// Units in the last place that a pose may be off by.
const UNITS: f64 = 4.0;
/// What an angle may be off by more than the entries that it is computed from.
const ANGLE: f64 = 4.0;
/// How near solutions of elimination are.
const POLISHED: f64 = 1e-9;
/// What the pose of a solution is off by where nothing was rounded, without dimension.
const EXACT: f64 = 1e-9;

/// A goal, and all configurations.
struct Case {
    /// 12 for the hand, then those of joints that are given.
    numbers: Vec<f64>,
    /// With whether they are one of a family.
    known: Vec<(Vec<f64>, bool)>,
    tolerance: f64,
    /// How far the poses of solutions may be from the goal, without dimension.
    off: f64,
}

pub(super) fn text(interface: &Interface) -> String {
    let cases = cases(interface);
    let n = interface.robot.joints;
    let joined = |list: Vec<String>| wrapped("    ", &list.join(", "), "").trim_end().to_string();
    let flags = |list: Vec<bool>| joined(list.into_iter().map(|is| u8::from(is).to_string()).collect());
    let numbers = |list: Vec<f64>| joined(list.into_iter().map(|x| format!("{x:?}")).collect());
    let mut known: Vec<(Vec<f64>, bool)> = cases.iter().flat_map(|c| c.known.iter().cloned()).collect();
    let mut ends = vec![0];
    cases.iter().for_each(|c| ends.push(ends[ends.len() - 1] + c.known.len()));
    if known.is_empty() {
        known.push((vec![0.0; n], false));
    }
    let goals: Vec<&[f64]> = cases.iter().map(|c| &c.numbers[..]).collect();
    let vectors = &interface.pose.vectors;
    let configurations: Vec<&[f64]> = vectors.iter().map(|v| &v.variables[..]).collect();
    let poses: Vec<Vec<f64>> =
        vectors.iter().map(|v| padded(interface.kind.goal(&rows(&v.results)))).collect();
    let steps: Vec<String> = (0..n).map(|j| format!("0.7 * step + {:?}", 0.1 * (j + 1) as f64)).collect();
    include_str!("test.cpp")
        .replace("@goals@", &cases.len().to_string())
        .replace("@known_count@", &known.len().to_string())
        .replace("@configurations@", &vectors.len().to_string())
        .replace("@goal_rows@", &table(&goals))
        .replace("@first@", &joined(ends.iter().map(usize::to_string).collect()))
        .replace("@known@", &table(&known.iter().map(|k| &k.0[..]).collect::<Vec<_>>()))
        .replace("@is_member@", &flags(known.iter().map(|k| k.1).collect()))
        .replace("@tolerances@", &numbers(cases.iter().map(|c| c.tolerance).collect()))
        .replace("@offs@", &numbers(cases.iter().map(|c| c.off).collect()))
        .replace("@configuration_rows@", &table(&configurations))
        .replace("@pose_rows@", &table(&poses))
        .replace("@pose_tolerances@", list(&padded(tolerances(interface)), 0).trim_matches(['{', '}']))
        .replace("@steps@", wrapped("                ", &steps.join(", "), "").trim())
        .replace("@size@", &format!("{:?}", interface.size))
}

/// What the entries of a goal may be off by, from what those of the pose may be off by.
fn tolerances(interface: &Interface) -> Vec<f64> {
    let scales = &interface.pose.scales;
    let each: Vec<f64> = scales.iter().map(|s| UNITS * f64::EPSILON * s).collect();
    let rows = rows(&each);
    match interface.kind.rotation_numbers() {
        // An angle has its own rule.
        1 => vec![rows[0][3], rows[1][3], rows[2][3], ANGLE * rows[0][0]],
        _ => interface.kind.goal(&rows),
    }
}

fn cases(interface: &Interface) -> Vec<Case> {
    let Interface { kind, robot, given, .. } = interface;
    let off = |goal: &[f64], known: &[(Vec<f64>, bool)]| {
        let of = |q: &[f64]| {
            let found = kind.goal(&matrix(&robot.pose(q)));
            let each = found.iter().zip(goal).enumerate().map(|(k, (x, y))| match k {
                0..3 => (x - y).abs() / interface.size,
                // An angle from −π to π, at its end.
                _ => (x - y).abs().min((std::f64::consts::TAU - (x - y).abs()).abs()),
            });
            each.fold(0.0, f64::max)
        };
        EXACT + 2.0 * known.iter().map(|k| of(&k.0)).fold(0.0, f64::max)
    };
    let case = |rows: [[f64; 4]; 3], values: &[f64], known: Vec<(Vec<f64>, bool)>, tolerance| {
        let goal = kind.goal(&rows);
        kind.stands_for(&rows).then(|| Case {
            off: off(&goal, &known),
            numbers: padded(goal).into_iter().chain(values.iter().copied()).collect(),
            known,
            tolerance,
        })
    };
    match interface.solver {
        Solver::General(general) => {
            let all = general.vectors.iter().map(|v| {
                let known = v.solutions.iter().map(|q| (q.clone(), false)).collect();
                case(v.pose, &[], known, POLISHED)
            });
            all.flatten().collect()
        }
        Solver::Closed(closed) => {
            // A direction of another length means the same direction here.
            let is_meant =
                |v: &&SolverVector| kind != &Kind::Direction || v.certificate != Certificate::NotAPose;
            let all = closed.vectors().iter().filter(is_meant).map(|v| {
                let (hand, values) = v.variables.split_at(v.variables.len() - given.len());
                let known = v.solutions.iter().map(|s| (s.results.clone(), s.free != 0)).collect();
                case(full(hand), values, known, v.tolerance)
            });
            all.flatten().collect()
        }
    }
}

/// Rows 1 to 3 of a matrix in a list.
fn rows(list: &[f64]) -> [[f64; 4]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|k| list[4 * i + k]))
}

/// What a solver takes of the hand, in rows 1 to 3 of its pose; entries that it does not take are 0.
fn full(hand: &[f64]) -> [[f64; 4]; 3] {
    let width = hand.len() / 3;
    std::array::from_fn(|i| {
        std::array::from_fn(|k| if k + width < 4 { 0.0 } else { hand[width * i + k + width - 4] })
    })
}

fn matrix(pose: &Transform<f64>) -> [[f64; 4]; 3] {
    let m = pose.matrix();
    std::array::from_fn(|i| m[i])
}

/// The goal as the test stores it.
fn padded(mut goal: Vec<f64>) -> Vec<f64> {
    goal.resize(12, 0.0);
    goal
}
