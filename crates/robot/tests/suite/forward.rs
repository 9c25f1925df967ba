//! Forward models of every robot of the catalogue: proved, equal to numbers that somebody else computed, and short.

use crate::common::{numbers, robot, with_values};
use denavit::forward::{ForwardModel, Outputs, Proof, Reference};
use denavit::geometry::Transform;
use denavit::{Robot, catalogue};
use denavit_symbolic::{Expr, Symbol, equal};
use serde_json::Value;
use std::collections::BTreeMap;

/// Poses that Pinocchio computed from the same tables; the file says with which versions.
fn peer() -> Value {
    serde_json::from_str(include_str!("../peers/fk.json")).expect("valid JSON")
}

fn distance(x: &Transform<f64>, rows: &Value) -> f64 {
    let peer: Vec<f64> = rows.as_array().into_iter().flatten().flat_map(numbers).collect();
    assert_eq!(peer.len(), 16);
    x.matrix().iter().flatten().zip(peer).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn every_robot_agrees_with_pinocchio() {
    let peer = peer();
    for name in catalogue::names() {
        let data = &peer["robots"][name];
        let samples = data["samples"].as_array().unwrap_or_else(|| panic!("{name}: no peer data"));
        assert!(samples.len() >= 8, "{name}");
        let description = with_values(robot(name), &data["parameters"]);
        let robot = Robot::numeric(&description).unwrap_or_else(|e| panic!("{name}: {e}"));
        let model = ForwardModel::of_tool(&description, Outputs::ALL);
        for sample in samples {
            let q = numbers(&sample["q"]);
            let frames = robot.frames(&q);
            let reach = frames.iter().map(|x| x.translation.norm()).fold(1.0, f64::max);
            let off = distance(&robot.pose(&q), &sample["pose"]);
            assert!(off <= 1e-12 * reach, "{name} at {q:?}: {off:e}");
            if let Some(theirs) = sample["frames"].as_array() {
                assert_eq!(theirs.len() + 1, frames.len());
                for (i, (ours, theirs)) in frames[1..].iter().zip(theirs).enumerate() {
                    let off = distance(ours, theirs);
                    assert!(off <= 1e-12 * reach, "{name}, frame {} at {q:?}: {off:e}", i + 1);
                }
            }
            // the number is the oracle of the formula
            let value = |s: Symbol| -> Option<f64> {
                let variables = description.variables();
                let joint = variables.iter().position(|v| v.symbol == s).map(|j| q[j]);
                joint.or_else(|| description.value(s))
            };
            let traced = model.algorithm.eval(value).unwrap_or_else(|s| panic!("{name}: no value for {s:?}"));
            let pose = robot.pose(&q).matrix();
            for ((row, column), x) in Outputs::ALL.places().into_iter().zip(traced) {
                let off = (x - pose[row][column]).abs();
                assert!(off <= 1e-13 * reach, "{name}, entry {row},{column} at {q:?}: {off:e}");
            }
        }
    }
}

#[test]
fn every_program_is_proved() {
    for name in catalogue::names() {
        let model = ForwardModel::of_tool(&robot(name), Outputs::ALL);
        assert_eq!(model.proof, Proof::Proved, "{name}");
        assert!(model.matrix.is_ok(), "{name}");
    }
}

/// RᵀR = 1 and det R = 1, by proof.
#[test]
fn orientations_are_rotations() {
    for name in catalogue::names() {
        let matrix = ForwardModel::of_tool(&robot(name), Outputs::ALL).matrix.expect("expanded");
        let column = |c: usize| [0, 1, 2].map(|r| matrix[r][c]);
        let dot = |a: [Expr; 3], b: [Expr; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (x, y, z) = (column(0), column(1), column(2));
        let cross = [y[1] * z[2] - y[2] * z[1], y[2] * z[0] - y[0] * z[2], y[0] * z[1] - y[1] * z[0]];
        let (zero, one) = (Expr::int(0), Expr::int(1));
        let laws =
            [(dot(x, x), one), (dot(y, y), one), (dot(z, z), one), (dot(x, y), zero), (dot(y, z), zero)];
        for (left, right) in laws.into_iter().chain([(dot(z, x), zero), (dot(x, cross), one)]) {
            assert!(equal(left, right).is_equal(), "{name}");
        }
    }
}

/// Multiplications, additions, sine/cosine pairs, depth and estimated cycles of the whole pose; a change shows in
/// review.
#[test]
fn operation_counts() {
    let mut found = String::new();
    for name in catalogue::names() {
        let program = ForwardModel::of_tool(&robot(name), Outputs::ALL).algorithm;
        let (depth, cycles) = (program.depth(), program.cycles());
        found += &format!("{name}: {}; depth {depth}, {cycles} cycles\n", program.count());
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots/operation_counts.txt");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(path, &found).expect("snapshot written");
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    assert_eq!(found, expected, "UPDATE_SNAPSHOTS=1 writes the new counts");
}

/// The counts of the project's notes on exact algebra, section 6: the least known for these tables.
#[test]
fn counts_reach_the_least_known() {
    let mut least = BTreeMap::new();
    least.insert("staubli-rx90", ("all", 36, 16, 6));
    least.insert("ur5", ("all", 35, 21, 6));
    least.insert("ur3-lab", ("all", 35, 21, 6));
    least.insert("prrrrp", ("x,z,position", 14, 8, 4));
    least.insert("stanford", ("all", 36, 15, 5));
    least.insert("puma560", ("all", 43, 24, 6));
    least.insert("cylindrical-wrist", ("all", 27, 12, 4));
    least.insert("smart5-six-rail", ("all", 41, 25, 6));
    for (name, (outputs, mul, add, sincos)) in least {
        let outputs = outputs.parse().expect("known outputs");
        let count = ForwardModel::of_tool(&robot(name), outputs).algorithm.count();
        let ours = (count.multiplications, count.additions, count.sincos);
        assert!(ours.0 <= mul && ours.1 <= add && ours.2 <= sincos, "{name}: {ours:?}");
    }
    let only = |name, parts: &str| {
        let count = ForwardModel::of_tool(&robot(name), parts.parse().expect("known")).algorithm.count();
        (count.multiplications, count.additions)
    };
    assert_eq!(only("staubli-rx90", "position,x,z"), (30, 13));
    assert_eq!(only("staubli-rx90", "position,z"), (16, 7));
}

#[test]
fn any_frame_in_any_other() {
    for name in ["staubli-rx90", "cylindrical-wrist", "franka-panda", "smart5-six-rail"] {
        let d = robot(name);
        let last = d.rows.len();
        for (i, j) in [(0, 1), (1, 3), (2, last), (last, 0), (4, 1), (3, 3)] {
            let model = ForwardModel::derive(&d, Reference::Frame(i), Reference::Frame(j), Outputs::ALL);
            assert_eq!(model.proof, Proof::Proved, "{name}: T{i},{j}");
        }
    }
}
