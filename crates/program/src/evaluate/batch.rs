//! Many configurations: blocks that stay in the cache, rows around them, all cores.

use crate::evaluate::file::File;
use crate::evaluate::machine::{Arithmetic, Isa};
use crate::evaluate::real::Real;
use crate::evaluate::tape::Tape;
use std::num::NonZero;
use std::sync::Arc;

/// Rows below which a second thread does not pay.
const ROWS_PER_THREAD: usize = 10_000;

/// Runs a [`Function`](crate::Function) for a block of configurations at once, in double or single precision.
///
/// The values are a structure of arrays: fill [`Block::variable`], call [`Block::run`], read [`Block::output`].
#[derive(Clone, Debug)]
pub struct Block<T: Real> {
    tape: Arc<Tape>,
    isa: Isa,
    arithmetic: Arithmetic,
    file: T::File,
}

impl<T: Real> Block<T> {
    pub(crate) fn new(tape: &Arc<Tape>, uniforms: &[f64], isa: Isa, arithmetic: Arithmetic) -> Self {
        Block { tape: tape.clone(), isa, arithmetic, file: T::File::new(tape, uniforms) }
    }

    /// How many configurations a block holds.
    pub fn lanes(&self) -> usize {
        self.file.lanes()
    }

    /// The values of a variable, one a configuration.
    ///
    /// # Panics
    /// If there are not that many variables.
    pub fn variable(&mut self, number: usize) -> &mut [T] {
        assert!(number < self.tape.variables, "a variable of the program");
        self.file.register_mut(number)
    }

    /// The values of a result, one a configuration.
    ///
    /// # Panics
    /// If there are not that many results.
    pub fn output(&self, number: usize) -> &[T] {
        assert!(number < self.tape.outputs, "a result of the program");
        self.file.register(self.tape.variables + number)
    }

    /// Computes the results of all configurations of the block.
    pub fn run(&mut self) {
        self.file.run(self.isa, self.arithmetic, &self.tape);
    }
}

/// Runs a [`Function`](crate::Function) for any number of configurations, one a row. A row's results do not depend
/// on how many others there are, on the threads, or on where a block ends.
#[derive(Clone, Debug)]
pub struct Batch<T: Real> {
    block: Block<T>,
}

impl<T: Real> Batch<T> {
    pub(crate) fn new(block: Block<T>) -> Self {
        Batch { block }
    }

    /// The results of each row of variables, on this thread. Both are row-major: `variables` is N × (number of
    /// variables), `outputs` N × (number of results).
    ///
    /// # Panics
    /// If the lengths do not belong to one number of rows.
    pub fn run(&mut self, variables: &[T], outputs: &mut [T]) {
        if self.count(variables, outputs) > 0 {
            let Block { tape, isa, arithmetic, file } = &mut self.block;
            file.run_rows(*isa, *arithmetic, tape, variables, outputs);
        }
    }

    /// The same on all cores, or on as many threads as `threads` says.
    ///
    /// # Panics
    /// As [`Batch::run`].
    pub fn run_parallel(&self, threads: Option<NonZero<usize>>, variables: &[T], outputs: &mut [T]) {
        let count = self.count(variables, outputs);
        let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = threads.map_or_else(|| cores().min(count / ROWS_PER_THREAD), NonZero::get).max(1);
        let (n, m) = (self.block.tape.variables, self.block.tape.outputs);
        let lanes = self.block.lanes();
        let share = count.div_ceil(threads).next_multiple_of(lanes);
        if threads == 1 || share >= count {
            return self.clone().run(variables, outputs);
        }
        // One share for each thread, the first for this one.
        let (own_variables, mut rest) = variables.split_at(share * n);
        let (own_outputs, others) = outputs.split_at_mut(share * m);
        std::thread::scope(|scope| {
            for out in others.chunks_mut(share * m) {
                let part;
                (part, rest) = rest.split_at(out.len() / m * n);
                let mut batch = self.clone();
                scope.spawn(move || batch.run(part, out));
            }
            self.clone().run(own_variables, own_outputs);
        });
    }

    fn count(&self, variables: &[T], outputs: &[T]) -> usize {
        let (n, m) = (self.block.tape.variables, self.block.tape.outputs);
        if m == 0 {
            return 0;
        }
        let count = outputs.len() / m;
        assert_eq!(outputs.len(), count * m, "whole rows of results");
        assert_eq!(variables.len(), count * n, "one row of variables for each row of results");
        count
    }
}
