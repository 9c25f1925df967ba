//! `ik --input`: a line with a matrix in, a line with its solutions out.

use super::answer::Question;
use super::pose;
use crate::commands::stream::{self, Chunk, Worker, complaint, parsed};
use crate::failure::Failure;
use denavit::geometry::Transform;
use denavit::inverse::{Criterion, InverseKinematics};
use std::path::Path;

/// Answers a line for each line; where a path is followed, one after the other.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run(
    solver: &InverseKinematics,
    question: &Question,
    path: &Path,
    follow: bool,
) -> Result<(), Failure> {
    let worker = || Poses { solver: solver.clone(), question: question.clone(), follow };
    if follow { stream::run_in_line(worker, path) } else { stream::run(worker, path) }
}

struct Poses {
    solver: InverseKinematics,
    question: Question,
    follow: bool,
}

impl Poses {
    fn solved(&mut self, pose: &Transform<f64>, out: &mut Vec<u8>) {
        let (mut answer, nearest) = self.question.ask(&self.solver, pose);
        // Curves are long; they are for one pose.
        answer.families.iter_mut().for_each(|f| f.curve.clear());
        denavit_wire::line(&self.question.wire(pose, &answer, nearest.as_ref()), out);
        if self.follow
            && let Some(nearest) = nearest
        {
            self.question.criterion = Some(Criterion::Nearest(nearest.q));
        }
    }
}

impl Worker for Poses {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let mut bad = 0;
        for (number, line) in chunk.lines() {
            let value = parsed(line, "a JSON 4×4 matrix", |l| serde_json::from_slice(l));
            match value.and_then(|v| pose::matrix(&v)) {
                Ok(pose) => self.solved(&pose, out),
                Err(why) => {
                    complaint(number, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}
