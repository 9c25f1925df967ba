//! Dynamic functions as programs: beside the plain algorithms, Pinocchio, and one another.

use crate::common::{Random, numbers, robot, with_values};
use crate::dynamics::{ARMS, random_arm, state};
use denavit::description::Description;
use denavit::dynamics::{DynamicFunction as F, DynamicPrograms, Masses};
use denavit_program::Program;
use serde_json::Value;

/// The largest difference, by the size of the second.
#[track_caller]
fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    let off = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
    assert!(off <= tolerance, "{what}: {off:e}\n{a:?}\n{b:?}");
}

fn is_conditioned(f: F) -> f64 {
    if f.is_driven() { 1e4 } else { 1.0 }
}

/// The lengths that are left, as the robot file has them.
fn lengths(d: &Description, program: &Program) -> Vec<f64> {
    program.parameters().iter().map(|s| d.value(*s).expect("a value")).collect()
}

#[test]
fn counts() {
    for name in ["staubli-rx90", "ur5", "franka-panda", "planar-2r"] {
        let d = robot(name);
        let all = DynamicPrograms::new(&d, Masses::Base).unwrap();
        for f in F::ALL {
            if let Some(p) = all.program(f) {
                println!("{name} {f:?} {}", p.count());
            }
        }
    }
}

#[test]
fn programs_compute_what_plain_algorithms_do() {
    for name in ARMS {
        let d = random_arm(name, 77);
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        let mut random = Random(5);
        for f in F::ALL {
            let program = all.program(f).expect("numbers tell all");
            let reference = all.reference(f);
            assert_eq!(program.variables(), all.variables(f));
            let mut scalar = program.compile(&lengths(&d, &program)).scalar();
            let mut plain = reference.compile(&lengths(&d, &reference)).scalar();
            for _ in 0..3 {
                let x: Vec<f64> = state(all.symbols[0].len(), &mut random).concat();
                let x = &x[..program.variables().len()];
                close(&format!("{name}, {f:?}"), scalar.eval(x), plain.eval(x), 1e-11 * is_conditioned(f));
            }
        }
    }
}
