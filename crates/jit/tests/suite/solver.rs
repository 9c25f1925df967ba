//! Machine code between the roots of a solver finds what the careful evaluator finds, to the last bit.

use crate::solvers::{LENGTHS, Random, planar, planar_forward, six, six_forward};
use denavit_jit::MachineSolver;
use denavit_program::{Arithmetic, Isa};
use std::f64::consts::FRAC_PI_2;

#[test]
fn leaves_are_the_same() {
    let function = six().compile(&LENGTHS);
    for isa in Isa::available() {
        for arithmetic in [Arithmetic::Fused, Arithmetic::Strict] {
            let function = function.on(isa, arithmetic);
            let mut careful = function.scalar();
            let mut machine = MachineSolver::compile(&function).expect("code for this processor");
            let mut random = Random(11);
            for k in 0..3000 {
                let mut x = random.angles(6);
                if k % 3 == 0 {
                    x = x.iter().map(|x| (x / FRAC_PI_2).round() * FRAC_PI_2).collect();
                }
                let row = six_forward(LENGTHS, &x);
                let given = [None, None, Some([0.6, 0.8])];
                assert_eq!(machine.solve(&row, &given), careful.solve_carefully(&row, &given), "{x:?}");
            }
        }
    }
}

#[test]
fn parameters_have_values_later() {
    let function = planar().compile(&[1.0, 1.0]);
    let machine = MachineSolver::compile(&function).expect("code for this processor");
    let mut random = Random(12);
    for _ in 0..100 {
        let lengths = [0.1 + random.number().abs(), 0.1 + random.number().abs()];
        let row = planar_forward(lengths, &random.angles(2));
        let mut careful = function.with_parameters(&lengths).scalar();
        let mut own = machine.with_parameters(&lengths);
        assert_eq!(own.solve(&row, &[]), careful.solve_carefully(&row, &[]));
    }
}
