//! Derivations in stores of their own: what comes out of them works outside, and nothing stays behind.

use denavit::forward::{ForwardModel, Outputs, pose_program};
use denavit::inverse::general::GeneralSolver;
use denavit::inverse::{
    Answer, InverseKinematics, InverseModel, InverseOptions, InverseSolver, JointSpace, Manifold,
    NumericSolver, RedundantSolver, SelfMotion,
};
use denavit::velocity::RateSolver;
use denavit::{Description, Robot, catalogue, description};
use denavit_program::solver::{Leaves, Solutions, SolverBatch, SolverFunction, SolverScalar};
use denavit_program::{Batch, Block, Function, Scalar};
use denavit_symbolic::{scoped, store_size};

fn robot(name: &str) -> Description {
    description::read_toml(catalogue::text(name).expect("the catalogue has it")).expect("no errors").0
}

/// The last entry of the position, as text.
fn forward(name: &str) -> String {
    let d = robot(name);
    let model = ForwardModel::of_tool(&d, Outputs::ALL);
    model.matrix.map_or_else(|refusal| refusal.to_string(), |m| m[2][3].to_string())
}

/// A solver with numbers.
fn inverse(name: &str) -> InverseSolver {
    let d = robot(name);
    let model = InverseModel::derive(&d, &InverseOptions::default()).expect("a closed form");
    model.solver(&d).expect("the catalogue gives all lengths")
}

#[test]
fn what_is_compiled_goes_to_other_threads() {
    fn crosses<T: Send + Sync + 'static>() {}
    crosses::<(Function, Scalar, Block<f64>, Batch<f64>, Block<f32>, Batch<f32>)>();
    crosses::<(SolverFunction, SolverScalar, SolverBatch, Leaves, Solutions)>();
    crosses::<(Robot<f64>, JointSpace, InverseSolver, GeneralSolver, NumericSolver, RedundantSolver)>();
    crosses::<(InverseKinematics, RateSolver, Answer, Manifold, SelfMotion)>();
}

#[test]
fn what_was_derived_inside_works_outside() {
    let q = [0.1, -1.2, 1.4, 0.3, 0.8, -0.5];
    let (function, solver) = scoped(|| {
        let d = robot("ur5");
        let function =
            pose_program(&d).compile_with(|s| d.value(s)).expect("the catalogue gives all lengths");
        (function, inverse("ur5"))
    });
    let pose = solver.robot.pose(&q);
    let matrix: Vec<f64> = pose.matrix().concat();
    let traced = function.scalar().eval(&q).to_vec();
    assert!(matrix.iter().zip(&traced).all(|(a, b)| (a - b).abs() < 1e-14), "{matrix:?} {traced:?}");
    let answer = solver.solve(&pose, &[]);
    let is_meant = |x: &[f64]| x.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(answer.solutions.iter().any(|s| is_meant(&s.q)), "{:?}", answer.solutions);
}

#[test]
fn nothing_stays_behind() {
    let before = store_size();
    let first = scoped(|| (forward("staubli-rx90"), store_size()));
    assert!(first.1 > 100, "a derivation forms expressions");
    for _ in 0..20 {
        assert_eq!(scoped(|| (forward("staubli-rx90"), store_size())), first, "every store starts empty");
    }
    scoped(|| inverse("articulated-3r"));
    assert_eq!(store_size(), before);
}

/// The resident memory of this process, megabytes.
#[cfg(target_os = "linux")]
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux tells");
    let line = status.lines().find_map(|l| l.strip_prefix("VmRSS:")).expect("Linux tells");
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").parse().expect("a number");
    kilobytes / 1024.0
}

/// `cargo test --release -p denavit --test suite scope -- --ignored --nocapture`
#[test]
#[cfg(target_os = "linux")]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn ten_thousand_derivations_in_bounded_memory() {
    let before = store_size();
    let (mut highest, mut early) = (0.0_f64, 0.0_f64);
    for (i, name) in catalogue::names().into_iter().cycle().take(10_000).enumerate() {
        scoped(move || forward(name));
        if i % 100 == 0 {
            scoped(|| inverse("ur5"));
            highest = highest.max(resident());
        }
        if i == 1_000 {
            early = highest;
        }
    }
    println!("{early:.1} MB after 1,000 derivations, {highest:.1} MB after 10,000");
    assert_eq!(store_size(), before);
    assert!(highest < early + 16.0, "{early:.1} MB, then {highest:.1} MB");
}
