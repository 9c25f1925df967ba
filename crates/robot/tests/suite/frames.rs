//! Programs for evaluators and generated code, against the numbers of the plain product.

use denavit::description::{Description, JointKind};
use denavit::forward::{ForwardModel, Outputs, Proof, Reference, frames_program, pose_program, prove};
use denavit::geometry::Transform;
use denavit::{Robot, catalogue};
use denavit_program::{Function, Program};
use denavit_symbolic::{Expr, Rational};
use std::num::NonZero;

fn robot(name: &str) -> Description {
    catalogue::robot(name).unwrap_or_else(|| panic!("no robot {name}"))
}

/// A robot of the catalogue; a parameter without value gets one between 0.25 and 1.
fn valued(name: &str) -> Description {
    let mut d = robot(name);
    for (k, p) in d.parameters.iter_mut().enumerate() {
        p.value = p.value.or(Some(Rational::new(16 + (k as i64 % 16) * 3, 64).into()));
    }
    d
}

fn all_frames(d: &Description) -> Program {
    let all: Vec<Reference> = (0..=d.rows.len()).map(Reference::Frame).collect();
    frames_program(d, &all)
}

fn compiled(d: &Description, program: &Program) -> Function {
    program.compile(&d.values(program.parameters()).expect("every parameter has a value"))
}

/// Knuth's linear congruential generator: joint variables in (−π, π), or within a metre.
fn configurations(d: &Description, count: usize) -> Vec<f64> {
    let mut state = 20_261_121_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let variables = d.variables();
    let scale = |kind| if kind == JointKind::Revolute { std::f64::consts::PI } else { 1.0 };
    (0..count).flat_map(|_| variables.iter().map(|v| scale(v.kind) * random()).collect::<Vec<_>>()).collect()
}

/// The largest difference between the matrices, as a share of the reach.
fn distance(found: &[f64], wanted: &[Transform<f64>]) -> f64 {
    let reach = wanted.iter().map(|x| x.translation.norm()).fold(1.0, f64::max);
    let wanted: Vec<f64> = wanted.iter().flat_map(|x| x.matrix()).flatten().collect();
    assert_eq!(found.len(), wanted.len());
    found.iter().zip(wanted).map(|(a, b)| (a - b).abs() / reach).fold(0.0, f64::max)
}

#[test]
fn every_program_gives_the_numbers_of_the_plain_product() {
    for name in catalogue::names() {
        let d = valued(name);
        let chain = Robot::numeric(&d).expect("all values");
        let mut pose = compiled(&d, &pose_program(&d)).scalar();
        let mut frames = compiled(&d, &all_frames(&d)).scalar();
        let mut few = compiled(&d, &frames_program(&d, &[Reference::Tool, Reference::Base])).scalar();
        for q in configurations(&d, 40).chunks_exact(chain.joints) {
            assert!(distance(pose.eval(q), &[chain.pose(q)]) <= 1e-13, "{name}, pose at {q:?}");
            assert!(distance(frames.eval(q), &chain.frames(q)) <= 1e-13, "{name}, frames at {q:?}");
            let both = [chain.pose(q), Transform::identity()];
            assert!(distance(few.eval(q), &both) <= 1e-13, "{name}, tool at {q:?}");
        }
    }
}

/// By proof.
#[test]
fn all_frames_of_every_robot_are_proved() {
    for name in catalogue::names() {
        let d = robot(name);
        let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
        let frames = Robot::symbolic(&d).frames(&q);
        let plain: Vec<Expr> = frames.iter().flat_map(|x| x.matrix()).flatten().collect();
        assert_eq!(prove(&d, &all_frames(&d), &plain), Proof::Proved, "{name}");
    }
}

/// The pose by rows is the algorithm itself: the same bits, operations and names.
#[test]
fn the_pose_by_rows_is_the_algorithm() {
    for name in catalogue::names() {
        let d = valued(name);
        let model = ForwardModel::of_tool(&d, Outputs::ALL);
        let pose = pose_program(&d);
        assert_eq!(pose.count(), model.algorithm.count(), "{name}");
        let (mut by_rows, mut by_columns) =
            (compiled(&d, &pose).scalar(), compiled(&d, &model.algorithm).scalar());
        for q in configurations(&d, 10).chunks_exact(d.variables().len()) {
            let rows = by_rows.eval(q);
            for ((r, c), x) in Outputs::ALL.places().into_iter().zip(by_columns.eval(q)) {
                assert_eq!(rows[4 * r + c].to_bits(), x.to_bits(), "{name}, entry {r},{c} at {q:?}");
            }
            assert_eq!(rows[12..], [0.0, 0.0, 0.0, 1.0], "{name}");
        }
        let names = |p: &Program| -> Vec<String> {
            let mut names: Vec<String> = p.steps().into_iter().map(|s| s.name).collect();
            names.sort();
            names.retain(|n| !n.starts_with("t4"));
            names
        };
        assert_eq!(names(&pose), names(&model.algorithm), "{name}");
    }
}

/// An entry is computed in the same way whichever frames are asked for.
#[test]
fn a_frame_has_the_same_bits_alone_and_among_others() {
    for name in ["ur5", "franka-panda", "staubli-rx90"] {
        let d = valued(name);
        let n = d.rows.len();
        let mut all = compiled(&d, &all_frames(&d)).scalar();
        for i in 0..=n {
            let mut alone = compiled(&d, &frames_program(&d, &[Reference::Frame(i)])).scalar();
            for q in configurations(&d, 20).chunks_exact(d.variables().len()) {
                let among: Vec<u64> = all.eval(q)[16 * i..][..16].iter().map(|x| x.to_bits()).collect();
                let own: Vec<u64> = alone.eval(q).iter().map(|x| x.to_bits()).collect();
                assert_eq!(own, among, "{name}, frame {i}");
            }
        }
    }
}

#[test]
fn a_row_has_the_same_bits_in_any_batch() {
    for name in ["ur5", "franka-panda"] {
        let d = valued(name);
        let function = compiled(&d, &all_frames(&d));
        let (n, m) = (d.variables().len(), 16 * (d.rows.len() + 1));
        let variables = configurations(&d, 1000);
        let mut one_by_one = vec![];
        let mut scalar = function.scalar();
        variables.chunks_exact(n).for_each(|q| one_by_one.extend(scalar.eval(q).iter().map(|x| x.to_bits())));
        for count in [1, 7, 63, 64, 65, 1000] {
            for threads in [1, 2] {
                let mut results = vec![f64::NAN; count * m];
                let batch = function.batch::<f64>();
                batch.run_parallel(NonZero::new(threads), &variables[..count * n], &mut results);
                let bits: Vec<u64> = results.iter().map(|x| x.to_bits()).collect();
                assert!(bits == one_by_one[..count * m], "{name}: {count} rows on {threads} threads");
            }
        }
    }
}

/// Panda: seven axes, each a quarter turn from the next, cost 0, 4, 10 and 4 × 12 multiplications and 0, 0, 4 and
/// 4 × 6 additions, as the zeros of the first matrices fill up; d3 3 and 1, as z3 meets zeros; a3, a4, d5, a6 and d8 3
/// and 3 each. UR5: its three parallel axes cost 4 multiplications each.
#[test]
fn what_all_frames_cost() {
    for (name, multiplications, additions) in [("franka-panda", 80, 44), ("ur5", 48, 24)] {
        let count = all_frames(&robot(name)).count();
        assert_eq!((count.multiplications, count.additions), (multiplications, additions), "{name}");
    }
}
