//! All joint variables for a pose, from a closed form that is derived from the table.
//!
//! `cargo run --release --example 04_inverse -p denavit`

use denavit::Robot;
use denavit::catalogue;
use denavit::inverse::{InverseModel, InverseOptions};

fn main() {
    let robot = catalogue::robot("ur5").expect("in the catalogue");

    // Link lengths stay symbols: one derivation serves all robots of the family.
    let model = InverseModel::derive(&robot, &InverseOptions::default()).expect("a UR5 has a closed form");
    let unknowns: Vec<String> = model.steps.iter().map(|s| model.chain.describe(s.unknown)).collect();
    println!("found one after the other: {}", unknowns.join(", "));
    println!("at most {} solutions", model.max_solutions());

    // The lengths get their values; now poses are solved, in microseconds.
    let solver = model.solver(&robot).expect("the catalogue gives all lengths");
    let numbers = Robot::numeric(&robot).expect("the catalogue gives all lengths");
    let q = [0.1, -1.2, 1.4, 0.3, 0.8, -0.5];
    let pose = numbers.pose(&q);
    let answer = solver.solve(&pose, &[]);
    for s in &answer.solutions {
        println!("{:7.3?}  {:<24} residual {:.0e}", s.q, s.branch, s.residual);
        assert!(s.residual < 1e-12);
    }
    let found = |x: &[f64]| x.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(answer.solutions.iter().any(|s| found(&s.q)), "the configuration that the pose is made from");

    // Where q5 = 0 the last axis is parallel to three others: the arm can move with its hand still.
    let stretched = numbers.pose(&[0.1, -1.2, 1.4, 0.3, 0.0, -0.5]);
    for family in solver.solve(&stretched, &[]).families {
        println!("{} free, as at {:7.3?}", family.free.join(", "), family.representative.q);
    }

    // Out of reach: nothing, and why.
    let mut far = pose;
    far.translation.0[0] += 2.0;
    println!("{:?}", solver.solve(&far, &[]).obstacle);
}
