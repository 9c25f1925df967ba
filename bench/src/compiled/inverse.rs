//! Generated inverse kinematics.

use super::{name, runs};
use crate::inverse::{Contestant, Joints, Rows};
use std::hint::black_box;
use std::rc::Rc;

/// One pose at a time, and blocks.
macro_rules! generated {
    ($package:ident, $level:literal, $poses:expr) => {{
        use $package::{SOLVE_LANES, SOLVE_MAX, SolveBlock, SolveSolution, Parameters, solve, solve_block};
        let parameters = Parameters::default();
        let poses: Rc<Vec<Rows>> = $poses.clone();
        let as_matrix =
            |p: &Rows| -> [[f64; 4]; 3] { std::array::from_fn(|i| std::array::from_fn(|j| p[4 * i + j])) };
        let matrices: Vec<[[f64; 4]; 3]> = poses.iter().map(as_matrix).collect();
        let answers = |pose: &[[f64; 4]; 3]| -> Vec<Joints> {
            let mut solutions = [SolveSolution::NONE; SOLVE_MAX];
            let (count, _) = solve(pose, &parameters, &mut solutions);
            solutions[..count].iter().map(|s| s.q).collect()
        };
        let one = Contestant {
            name: name("generated Rust, one pose", $level),
            limit: Some(0.15),
            answers: matrices.iter().map(answers).collect(),
            run: Box::new(move || {
                let mut solutions = [SolveSolution::NONE; SOLVE_MAX];
                for pose in &matrices {
                    black_box(solve(black_box(pose), &parameters, black_box(&mut solutions)));
                }
            }),
        };
        let blocks: Vec<[[f64; SOLVE_LANES]; 12]> = poses
            .chunks_exact(SOLVE_LANES)
            .map(|rows| std::array::from_fn(|k| std::array::from_fn(|i| rows[i][k])))
            .collect();
        let mut answers = vec![];
        let mut solutions = Box::new(SolveBlock::NONE);
        for block in &blocks {
            solve_block(block, &parameters, &mut solutions);
            for i in 0..SOLVE_LANES {
                let there = (0..SOLVE_MAX).filter(|&b| solutions.multiplicity[b][i] > 0);
                answers.push(there.map(|b| std::array::from_fn(|k| solutions.q[b][k][i])).collect());
            }
        }
        let batch = Contestant {
            name: name("generated Rust, blocks", $level),
            limit: Some(0.08),
            answers,
            run: Box::new(move || {
                for block in &blocks {
                    solve_block(black_box(block), &parameters, black_box(&mut solutions));
                }
            }),
        };
        [one, batch]
    }};
}

/// Those for a UR5.
pub fn ur5(poses: &Rc<Vec<Rows>>) -> Vec<Contestant> {
    let mut all: Vec<Contestant> = generated!(ur5_ik_v3, "v3", poses).into();
    if runs("v4") {
        all.extend(generated!(ur5_ik_v4, "v4", poses));
    }
    all
}

/// Those for an IRB 2400.
pub fn irb2400(poses: &Rc<Vec<Rows>>) -> Vec<Contestant> {
    let mut all: Vec<Contestant> = generated!(irb2400_ik_v3, "v3", poses).into();
    if runs("v4") {
        all.extend(generated!(irb2400_ik_v4, "v4", poses));
    }
    all
}
