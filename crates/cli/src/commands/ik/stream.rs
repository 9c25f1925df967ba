//! `ik --input`: a line with a matrix in, a line with its solutions out.

use super::answer::Question;
use super::pose;
use crate::commands::stream::{self, Chunk, Worker, complaint, parsed};
use crate::failure::Failure;
use denavit::inverse::InverseSolver;
use std::path::Path;

/// Answers a line for each line.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run(solver: &InverseSolver, question: &Question, path: &Path) -> Result<(), Failure> {
    stream::run(|| Poses { solver: solver.clone(), question: question.clone() }, path)
}

struct Poses {
    solver: InverseSolver,
    question: Question,
}

impl Worker for Poses {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let mut bad = 0;
        for (number, line) in chunk.lines() {
            let value = parsed(line, "a JSON 4×4 matrix", |l| serde_json::from_slice(l));
            match value.and_then(|v| pose::matrix(&v)) {
                Ok(pose) => {
                    let answer = self.solver.solve(&pose, &self.question.given);
                    out.extend(self.question.json(&pose, &answer).into_bytes());
                }
                Err(why) => {
                    complaint(number, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}
