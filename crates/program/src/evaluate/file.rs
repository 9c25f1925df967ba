//! Register files of blocks: one array a register, in two widths.

use crate::evaluate::block::{self, Lanes, Run};
use crate::evaluate::machine::{self, Arithmetic, Instructions, Isa, Work};
use crate::evaluate::real::Real;
use crate::evaluate::rows;
use crate::evaluate::tape::Tape;

/// What a register file may take of the first-level cache, in bytes.
const IN_CACHE: usize = 24 * 1024;
/// Results above this size bypass the cache, in bytes.
const STREAMED: usize = if cfg!(miri) { 64 * 1024 } else { 8 * 1024 * 1024 };

/// The registers of a block. Wide ones are 512 bytes long, so that little time goes into finding out what comes next;
/// programs with many registers get narrow ones, of half that.
pub trait File<T>: Clone + std::fmt::Debug + Send + Sync {
    /// Registers for a tape, constants in place.
    fn new(tape: &Tape, uniforms: &[f64]) -> Self;
    /// Configurations in a block.
    fn lanes(&self) -> usize;
    /// The values of a register.
    fn register(&self, number: usize) -> &[T];
    /// The values of a register.
    fn register_mut(&mut self, number: usize) -> &mut [T];
    /// Runs the tape once.
    fn run(&mut self, isa: Isa, arithmetic: Arithmetic, tape: &Tape);
    /// Runs the tape for rows of variables.
    fn run_rows(&mut self, isa: Isa, arithmetic: Arithmetic, tape: &Tape, variables: &[T], outputs: &mut [T]);
}

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

/// Block by block: rows in, run, rows out.
struct Rows<'a, T, const N: usize> {
    tape: &'a Tape,
    file: &'a mut [Lanes<T, N>],
    variables: &'a [T],
    outputs: &'a mut [T],
}

impl<T: Real, const N: usize> Work for Rows<'_, T, N> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        let (n, m) = (self.tape.variables, self.tape.outputs);
        let stream = size_of_val(self.outputs) > STREAMED;
        let mut staging = vec![T::default(); if stream { N * m } else { 0 }];
        for (k, out) in self.outputs.chunks_mut(N * m).enumerate() {
            let count = out.len() / m;
            rows::read(&self.variables[k * N * n..(k * N + count) * n], &mut self.file[..n]);
            block::run::<I, T, FUSED, N>(self.tape, self.file);
            let results = &self.file[n..n + m];
            if stream {
                let staged = &mut staging[..out.len()];
                rows::write(results, staged);
                machine::copy_past_cache(staged, out);
            } else {
                rows::write(results, out);
            }
        }
        if stream {
            machine::settle_copies();
        }
    }
}

/// A file for one type of number, with the lanes that fill its two widths.
macro_rules! file {
    ($(#[$doc:meta])* $name:ident, $number:ty, $wide:literal, $narrow:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug)]
        pub enum $name {
            /// 512 bytes a register.
            Wide(Vec<Lanes<$number, $wide>>),
            /// 256 bytes a register.
            Narrow(Vec<Lanes<$number, $narrow>>),
        }

        impl File<$number> for $name {
            fn new(tape: &Tape, uniforms: &[f64]) -> Self {
                let in_use = tape.registers - tape.constant_outputs.len();
                if in_use * size_of::<Lanes<$number, $wide>>() <= IN_CACHE {
                    $name::Wide(filled(tape, uniforms))
                } else {
                    $name::Narrow(filled(tape, uniforms))
                }
            }
            fn lanes(&self) -> usize {
                match self {
                    $name::Wide(_) => $wide,
                    $name::Narrow(_) => $narrow,
                }
            }
            fn register(&self, number: usize) -> &[$number] {
                match self {
                    $name::Wide(file) => &file[number].0,
                    $name::Narrow(file) => &file[number].0,
                }
            }
            fn register_mut(&mut self, number: usize) -> &mut [$number] {
                match self {
                    $name::Wide(file) => &mut file[number].0,
                    $name::Narrow(file) => &mut file[number].0,
                }
            }
            fn run(&mut self, isa: Isa, arithmetic: Arithmetic, tape: &Tape) {
                match self {
                    $name::Wide(file) => isa.run(arithmetic, Run(tape, file)),
                    $name::Narrow(file) => isa.run(arithmetic, Run(tape, file)),
                }
            }
            fn run_rows(
                &mut self,
                isa: Isa,
                arithmetic: Arithmetic,
                tape: &Tape,
                variables: &[$number],
                outputs: &mut [$number],
            ) {
                match self {
                    $name::Wide(file) => isa.run(arithmetic, Rows { tape, file, variables, outputs }),
                    $name::Narrow(file) => isa.run(arithmetic, Rows { tape, file, variables, outputs }),
                }
            }
        }
    };
}

file!(
    /// In double precision.
    Double, f64, 64, 32
);
file!(
    /// In single precision.
    Single, f32, 128, 64
);
