//! Many configurations: blocks that stay in the cache, rows around them, all cores.

use crate::evaluate::block::{self, Lanes};
use crate::evaluate::machine::{self, Arithmetic, Isa, Work};
use crate::evaluate::real::Real;
use crate::evaluate::rows;
use crate::evaluate::tape::Tape;
use std::num::NonZero;
use std::sync::Arc;

/// Lanes of a block, and what remains for programs with many registers.
const LANES: usize = 64;
const FEW_LANES: usize = 32;
/// What a register file may take of the first-level cache, in bytes.
const IN_CACHE: usize = 24 * 1024;
/// Results above this size bypass the cache, in bytes.
const STREAMED: usize = if cfg!(miri) { 64 * 1024 } else { 8 * 1024 * 1024 };
/// Rows below which a second thread does not pay.
const ROWS_PER_THREAD: usize = 10_000;

/// Runs a [`Function`](crate::Function) for a block of configurations at once, in double or single precision.
///
/// The values are a structure of arrays: fill [`Block::variable`], call [`Block::run`], read [`Block::output`].
#[derive(Clone, Debug)]
pub struct Block<T> {
    tape: Arc<Tape>,
    isa: Isa,
    arithmetic: Arithmetic,
    file: File<T>,
}

#[derive(Clone, Debug)]
enum File<T> {
    Wide(Vec<Lanes<T, LANES>>),
    Narrow(Vec<Lanes<T, FEW_LANES>>),
}

impl<T: Real> Block<T> {
    pub(crate) fn new(tape: &Arc<Tape>, uniforms: &[f64], isa: Isa, arithmetic: Arithmetic) -> Self {
        fn filled<T: Real, const N: usize>(tape: &Tape, uniforms: &[f64]) -> Vec<Lanes<T, N>> {
            let mut file = vec![Lanes([T::default(); N]); tape.registers];
            let first = tape.variables + tape.outputs;
            for (register, x) in file[first..].iter_mut().zip(uniforms) {
                register.0 = [T::from_f64(*x); N];
            }
            for &(k, u) in &tape.constant_outputs {
                file[tape.variables + k].0 = [T::from_f64(uniforms[u]); N];
            }
            file
        }
        let in_use = tape.registers - tape.constant_outputs.len();
        let wide = in_use * LANES * size_of::<T>() <= IN_CACHE;
        let file =
            if wide { File::Wide(filled(tape, uniforms)) } else { File::Narrow(filled(tape, uniforms)) };
        Block { tape: tape.clone(), isa, arithmetic, file }
    }

    /// How many configurations a block holds.
    pub fn lanes(&self) -> usize {
        match self.file {
            File::Wide(_) => LANES,
            File::Narrow(_) => FEW_LANES,
        }
    }

    /// The values of a variable, one a configuration.
    ///
    /// # Panics
    /// If there are not that many variables.
    pub fn variable(&mut self, number: usize) -> &mut [T] {
        assert!(number < self.tape.variables, "a variable of the program");
        match &mut self.file {
            File::Wide(file) => &mut file[number].0,
            File::Narrow(file) => &mut file[number].0,
        }
    }

    /// The values of a result, one a configuration.
    ///
    /// # Panics
    /// If there are not that many results.
    pub fn output(&self, number: usize) -> &[T] {
        assert!(number < self.tape.outputs, "a result of the program");
        match &self.file {
            File::Wide(file) => &file[self.tape.variables + number].0,
            File::Narrow(file) => &file[self.tape.variables + number].0,
        }
    }

    /// Computes the results of all configurations of the block.
    pub fn run(&mut self) {
        struct Once<'a, T, const N: usize>(&'a Tape, &'a mut [Lanes<T, N>]);
        impl<T: Real, const N: usize> Work for Once<'_, T, N> {
            #[inline(always)]
            fn run<const FUSED: bool>(self) {
                block::run::<T, FUSED, N>(self.0, self.1);
            }
        }
        match &mut self.file {
            File::Wide(file) => self.isa.run(self.arithmetic, Once(&self.tape, file)),
            File::Narrow(file) => self.isa.run(self.arithmetic, Once(&self.tape, file)),
        }
    }

    fn rows(&mut self, variables: &[T], outputs: &mut [T]) {
        let (isa, arithmetic) = (self.isa, self.arithmetic);
        let stream = size_of_val(outputs) > STREAMED;
        match &mut self.file {
            File::Wide(file) => {
                isa.run(arithmetic, Rows { tape: &self.tape, file, variables, outputs, stream })
            }
            File::Narrow(file) => {
                isa.run(arithmetic, Rows { tape: &self.tape, file, variables, outputs, stream })
            }
        }
    }
}

/// Block by block: rows in, run, rows out.
struct Rows<'a, T, const N: usize> {
    tape: &'a Tape,
    file: &'a mut [Lanes<T, N>],
    variables: &'a [T],
    outputs: &'a mut [T],
    stream: bool,
}

impl<T: Real, const N: usize> Work for Rows<'_, T, N> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let (n, m) = (self.tape.variables, self.tape.outputs);
        let mut staging = vec![T::default(); if self.stream { N * m } else { 0 }];
        for (k, out) in self.outputs.chunks_mut(N * m).enumerate() {
            let count = out.len() / m;
            rows::read(&self.variables[k * N * n..(k * N + count) * n], &mut self.file[..n]);
            block::run::<T, FUSED, N>(self.tape, self.file);
            let results = &self.file[n..n + m];
            if self.stream {
                let staged = &mut staging[..out.len()];
                rows::write(results, staged);
                machine::copy_past_cache(staged, out);
            } else {
                rows::write(results, out);
            }
        }
    }
}

/// Runs a [`Function`](crate::Function) for any number of configurations, one a row. A row's results do not depend
/// on how many others there are, on the threads, or on where a block ends.
#[derive(Clone, Debug)]
pub struct Batch<T> {
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
            self.block.rows(variables, outputs);
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
        std::thread::scope(|scope| {
            let mut rest = variables;
            for out in outputs.chunks_mut(share * m) {
                let own;
                (own, rest) = rest.split_at(out.len() / m * n);
                let mut batch = self.clone();
                scope.spawn(move || batch.run(own, out));
            }
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
