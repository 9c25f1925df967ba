//! `jacobian --input`: a line of joint variables in, a line with the Jacobian out.

use crate::commands::fk::strict;
use crate::commands::stream::{self, Chunk, Worker, complaint, joints};
use crate::failure::Failure;
use denavit::description::Description;
use denavit::velocity::{Viewpoint, jacobian_program};
use denavit_program::Batch;
use denavit_symbolic::Expr;
use denavit_wire::jacobian::{Matrix, frame};
use std::path::Path;

/// Answers a line for each line: the Jacobian, or what is wrong with the line.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run(description: &Description, view: &Viewpoint<Expr>, path: &Path) -> Result<(), Failure> {
    let function = strict(description, &jacobian_program(description, view));
    let joints = description.variables().len();
    let (robot, frame) = (description.name.clone(), frame(view.axes));
    let worker = || Jacobians { batch: function.batch(), joints, robot: robot.clone(), frame: frame.clone() };
    stream::run(worker, path)
}

/// The lines of a chunk go through the program together.
struct Jacobians {
    batch: Batch<f64>,
    joints: usize,
    robot: String,
    frame: String,
}

impl Worker for Jacobians {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let n = self.joints;
        let mut rows: Vec<f64> = vec![];
        let found: Vec<Result<(), (usize, String)>> = chunk
            .lines()
            .map(|(number, line)| joints(line, n, &mut rows).map_err(|why| (number, why)))
            .collect();
        let good = found.iter().filter(|f| f.is_ok()).count();
        let mut results = vec![0.0; good * 6 * n];
        self.batch.run(&rows, &mut results);
        let (mut row, mut bad) = (0, 0);
        for line in found {
            match line {
                Ok(()) => {
                    let q = &rows[row * n..][..n];
                    let entries = &results[row * 6 * n..][..6 * n];
                    Matrix::of(&self.robot, &self.frame, q, entries).write(out);
                    row += 1;
                }
                Err((line, why)) => {
                    complaint(line, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}
