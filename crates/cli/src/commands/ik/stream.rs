//! `ik --input`: a line with a matrix in, a line with its solutions out.

use super::answer::Question;
use super::pose;
use crate::commands::stream::{self, Chunk, Worker, complaint, parsed};
use crate::failure::Failure;
use crate::terminal::note;
use denavit::geometry::Transform;
use denavit::inverse::{Criterion, InverseKinematics};
use denavit::motion::follow::Jump;
use std::cmp::Ordering;
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
    let worker = || Poses { solver: solver.clone(), question: question.clone(), follow, last: None, said: 0 };
    if follow { stream::run_in_line(worker, path) } else { stream::run(worker, path) }
}

struct Poses {
    solver: InverseKinematics,
    question: Question,
    follow: bool,
    /// The last pose that was followed, and its solution.
    last: Option<(Transform<f64>, Vec<f64>)>,
    /// How many jumps were told of.
    said: usize,
}

/// Jumps that are told of beside the answers.
const TOLD: usize = 20;

impl Poses {
    fn solved(&mut self, number: usize, pose: &Transform<f64>, out: &mut Vec<u8>) {
        let mut found = self.question.ask(&self.solver, pose, None);
        // Curves are long; they are for one pose.
        found.answer.families.iter_mut().for_each(|f| f.curve.clear());
        if self.follow
            && let Some(nearest) = found.best.clone()
        {
            if let Some((before, from)) = &self.last {
                found.jump = Jump::between(&self.solver, [before, pose], [from, &nearest.q]);
            }
            if let Some(jump) = &found.jump {
                self.tell(number, jump);
            }
            self.last = Some((*pose, nearest.q.clone()));
            self.question.criterion = Some(Criterion::Nearest(nearest.q));
        }
        denavit_wire::line(&self.question.wire(pose, &found), out);
    }

    fn tell(&mut self, number: usize, jump: &Jump) {
        self.said += 1;
        match self.said.cmp(&TOLD) {
            Ordering::Less => note(&format!("note: line {number}: {}", self.question.jump(jump))),
            Ordering::Equal => note("note: there are further jumps; the field `jump` of the answers has all"),
            Ordering::Greater => {}
        }
    }
}

impl Worker for Poses {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let mut bad = 0;
        for (number, line) in chunk.lines() {
            let value = parsed(line, "a JSON 4×4 matrix", |l| serde_json::from_slice(l));
            match value.and_then(|v| pose::matrix(&v)) {
                Ok(pose) => self.solved(number, &pose, out),
                Err(why) => {
                    complaint(number, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}
