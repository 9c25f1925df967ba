//! Solvers: all solutions, each once, the same on every path.

use crate::support::solvers::{LENGTHS, Random, planar, planar_forward, six, six_forward};
use denavit_program::Isa;
use denavit_program::solver::{CANDIDATE, Leaves, SAME, Solutions, SolverFunction, TOLERANCE};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::num::NonZero;

/// The distance of two lists of angles, each modulo 2π.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) - TAU * ((a - b) / TAU).round()).fold(0.0, |m, d| d.abs().max(m))
}

/// The generating vector is there, solutions are exact, none is there twice.
fn check(leaves: &Leaves, generating: &[f64]) {
    let nearest = leaves.iter().map(|l| apart(l.outputs, generating)).fold(f64::INFINITY, f64::min);
    assert!(nearest <= 1e-6, "{generating:?} is missing, nearest {nearest:e} in {leaves:?}");
    sound(leaves, generating);
}

fn sound(leaves: &Leaves, generating: &[f64]) {
    for (k, a) in leaves.iter().enumerate() {
        let is_exact = a.residual <= 1e-12 || a.residual > TOLERANCE && a.residual <= CANDIDATE;
        assert!(is_exact, "residual {:e} at {generating:?}", a.residual);
        assert!(leaves.iter().skip(k + 1).all(|b| apart(a.outputs, b.outputs) > SAME), "{generating:?}");
        assert!(a.outputs.iter().all(|x| (-PI..=PI).contains(x)), "{generating:?}");
    }
}

#[test]
fn random_solutions_are_found() {
    let mut random = Random(1);
    let mut six = six().compile(&LENGTHS).scalar();
    let mut candidates = 0;
    for _ in 0..20_000 {
        let x = random.angles(6);
        let leaves = six.solve(&six_forward(LENGTHS, &x), &[]);
        check(leaves, &x);
        candidates += leaves.iter().filter(|l| l.residual > TOLERANCE).count();
    }
    assert!(candidates < 20, "{candidates} branches are nearly solutions");
}

#[test]
fn parameters_have_values_later() {
    let mut random = Random(2);
    let function = planar().compile(&[0.4, 0.3]);
    for _ in 0..20_000 {
        let lengths = [0.1 + random.number().abs(), 0.1 + random.number().abs()];
        let x = random.angles(2);
        let mut scalar = function.with_parameters(&lengths).scalar();
        check(scalar.solve(&planar_forward(lengths, &x), &[]), &x);
    }
}

/// Every combination of 0, ±π/2 and π that a step visits.
fn grid(step: usize) -> impl Iterator<Item = Vec<f64>> {
    let value = |k: usize| [0.0, FRAC_PI_2, PI, -FRAC_PI_2][k % 4];
    (0..4096).step_by(step).map(move |k| (0..6).map(|i| value(k >> (2 * i))).collect())
}

#[test]
fn special_angles_give_no_nonsense() {
    let mut scalar = six().compile(&LENGTHS).scalar();
    let mut free = 0;
    for x in grid(1) {
        let leaves = scalar.solve(&six_forward(LENGTHS, &x), &[]);
        sound(leaves, &x);
        free += u32::from(leaves.iter().any(|l| l.free != 0));
        // An unknown that is free takes what it is given. Node 2 gives θ2 + θ3 + θ4.
        let sum = x[1] + x[2] + x[3];
        let leaves = scalar.solve(&six_forward(LENGTHS, &x), &[None, None, Some([sum.cos(), sum.sin()])]);
        check(leaves, &x);
        let is_singular = x[4].sin().abs() < 0.5;
        let own = leaves.iter().find(|l| apart(l.outputs, &x) < 1e-6).expect("checked");
        assert_eq!(own.free, if is_singular { 1 << 2 } else { 0 }, "{x:?}");
    }
    // sin x5 = 0 on half of the grid; on a ninth of that nothing can be reached with θ2 + θ3 + θ4 = 0.
    assert!((1700..=2048).contains(&free), "{free}");
}

#[test]
fn what_ends_a_branch_is_told() {
    let mut scalar = planar().compile(&[0.4, 0.3]).scalar();
    let leaves = scalar.solve(&[0.6, 0.8], &[]);
    assert!(leaves.is_empty());
    let ended: Vec<_> = leaves.ended().collect();
    // cos x2 = (1 − 0.25)/0.24
    assert_eq!((ended.len(), ended[0].node, ended[0].times), (1, 0, 1));
    assert!((ended[0].gap - (0.75 / 0.24 - 1.0)).abs() < 1e-12);
    // Just out of reach: a candidate whose residual is the gap, 1e-8 of the size √(0.49 + 0.25).
    let leaves = scalar.solve(&[0.7 * (1.0 + 1e-8), 0.0], &[]);
    let leaf = leaves.get(0);
    assert_eq!((leaves.len(), leaf.multiplicity), (1, 2));
    assert!((leaf.residual - 0.7e-8 / 0.74_f64.sqrt()).abs() < 1e-12, "{leaf:?}");
    // Not a number, and infinite.
    assert!(scalar.solve(&[f64::NAN, 0.1], &[]).is_empty());
    assert!(scalar.solve(&[f64::INFINITY, 0.1], &[]).is_empty());
    assert!(scalar.solve(&[1e200, 0.1], &[]).is_empty());
    // Stretched and folded with equal lengths: the other unknown is free.
    let mut equal = planar().compile(&[0.5, 0.5]).scalar();
    let leaves = equal.solve(&[0.0, 0.0], &[None, Some([0.0, 1.0])]);
    assert_eq!((leaves.len(), leaves.get(0).free, leaves.get(0).multiplicity), (1, 2, 2));
    assert!(apart(leaves.get(0).outputs, &[FRAC_PI_2, PI]) < 1e-12);
}

/// Rows of variables: random ones, some nearly singular, some out of reach, the special ones.
fn six_rows(count: usize) -> Vec<Vec<f64>> {
    let mut random = Random(3);
    let mut rows: Vec<Vec<f64>> = (0..count)
        .map(|k| {
            let mut x = random.angles(6);
            if k % 5 == 0 {
                x[2 + k % 3] = 10_f64.powi(-((random.bits() % 17) as i32));
            }
            let mut row = six_forward(LENGTHS, &x);
            if k % 7 == 0 {
                (0..3).for_each(|i| row[4 * i + 3] *= 1.5);
            }
            row
        })
        .collect();
    rows.extend(grid(3).map(|x| six_forward(LENGTHS, &x)));
    rows.push(vec![f64::NAN; 12]);
    rows.push(vec![0.0; 12]);
    rows
}

fn targets(function: &SolverFunction) -> Vec<SolverFunction> {
    use denavit_program::Arithmetic::{Fused, Strict};
    let all = Isa::available().into_iter().flat_map(|isa| [Fused, Strict].map(|a| function.on(isa, a)));
    all.collect()
}

#[test]
fn the_fast_path_is_the_careful_one() {
    for function in targets(&six().compile(&LENGTHS)) {
        let (mut fast, mut careful) = (function.scalar(), function.scalar());
        for row in six_rows(3000) {
            assert_eq!(fast.solve(&row, &[]), careful.solve_carefully(&row, &[]), "{row:?}");
        }
    }
    for function in targets(&planar().compile(&[0.4, 0.3])) {
        let (mut fast, mut careful) = (function.scalar(), function.scalar());
        let mut random = Random(4);
        for _ in 0..3000 {
            let row = [random.number(), random.number()];
            assert_eq!(fast.solve(&row, &[]), careful.solve_carefully(&row, &[]), "{row:?}");
        }
    }
}

#[test]
fn evaluators_go_to_other_threads() {
    fn sent<T: Send + Sync + 'static>(_: &T) {}
    let function = planar().compile(&[0.4, 0.3]);
    sent(&function);
    sent(&function.scalar());
    sent(&function.batch());
}

fn check_batch(function: &SolverFunction, rows: &[Vec<f64>]) {
    let mut scalar = function.scalar();
    let mut batch = function.batch();
    let mut solutions = Solutions::default();
    let check = |solutions: &Solutions, scalar: &mut denavit_program::solver::SolverScalar| {
        assert_eq!(solutions.counts().len(), rows.len());
        for (i, row) in rows.iter().enumerate() {
            let leaves = scalar.solve(row, &[]);
            let one: Vec<(&[f64], f64)> = leaves.iter().map(|l| (l.outputs, l.residual)).collect();
            assert_eq!(solutions.row(i).collect::<Vec<_>>(), one, "row {i}: {row:?}");
            assert_eq!(solutions.is_regular()[i], leaves.is_regular(), "row {i}: {row:?}");
        }
    };
    batch.run(&rows.concat(), &mut solutions);
    check(&solutions, &mut scalar);
    batch.run_parallel(NonZero::new(3), &rows.concat(), &mut solutions);
    check(&solutions, &mut scalar);
}

#[test]
fn a_batch_is_the_same_as_one_by_one() {
    for function in targets(&six().compile(&LENGTHS)) {
        check_batch(&function, &six_rows(2000));
        check_batch(&function, &six_rows(5)[..5]);
        check_batch(&function, &[]);
    }
    let mut random = Random(5);
    let rows: Vec<Vec<f64>> = (0..500).map(|_| vec![random.number(), random.number()]).collect();
    for function in targets(&planar().compile(&[0.4, 0.3])) {
        check_batch(&function, &rows);
    }
}
