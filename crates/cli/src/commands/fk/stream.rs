//! `fk --input`: a line of joint variables in, a line with the pose out.

use crate::commands::fk::answer::Answers;
use crate::commands::stream::{self, Chunk, Worker, complaint, joints};
use crate::failure::Failure;
use denavit_program::Batch;
use std::path::Path;
use std::sync::Arc;

/// Answers a line for each line: the pose, or what is wrong with the line.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run(answers: Answers, path: &Path) -> Result<(), Failure> {
    let answers = Arc::new(answers);
    stream::run(|| Poses { batch: answers.function.batch(), answers: answers.clone() }, path)
}

/// The lines of a chunk go through the program together.
struct Poses {
    answers: Arc<Answers>,
    batch: Batch<f64>,
}

impl Worker for Poses {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let (n, m) = (self.answers.joints, self.answers.results);
        let mut rows: Vec<f64> = vec![];
        // For each line that is not blank what is wrong with it.
        let found: Vec<Option<(usize, String)>> = chunk
            .lines()
            .map(|(number, line)| joints(line, n, &mut rows).err().map(|why| (number, why)))
            .collect();
        let good = found.iter().filter(|f| f.is_none()).count();
        let mut results = vec![0.0; good * m];
        self.batch.run(&rows, &mut results);

        let (mut row, mut bad) = (0, 0);
        for line in found {
            match line {
                None => {
                    self.answers.write(&rows[row * n..][..n], &results[row * m..][..m], out);
                    row += 1;
                }
                Some((line, why)) => {
                    complaint(line, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}
