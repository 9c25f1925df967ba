//! Evaluators: one configuration, a block, millions.

mod batch;
pub(crate) mod block;
mod file;
pub(crate) mod machine;
mod real;
pub(crate) mod rows;
mod scalar;
pub(crate) mod tape;

pub use batch::{Batch, Block};
pub use machine::{Arithmetic, Isa};
pub use real::Real;
pub use scalar::Scalar;

use crate::code::Code;
use crate::program::Program;
use std::sync::Arc;
use tape::Tape;

/// A program ready to be evaluated, with values for its parameters. It can be sent to other threads.
#[derive(Clone, Debug)]
pub struct Function {
    code: Arc<Code>,
    tape: Arc<Tape>,
    uniforms: Arc<[f64]>,
    isa: Isa,
    arithmetic: Arithmetic,
}

impl Program {
    /// Compiles the program, with one value per parameter ([`Program::parameters`]).
    ///
    /// # Panics
    /// If there is not one value per parameter.
    pub fn compile(&self, parameters: &[f64]) -> Function {
        let code = Code::new(self);
        let tape = Tape::new(&code);
        let isa = Isa::detect();
        let uniforms = code.uniforms(parameters).into();
        Function { code: code.into(), tape: tape.into(), uniforms, isa, arithmetic: isa.arithmetic() }
    }
}

impl Function {
    /// The same with other values for its parameters; nothing is compiled again.
    ///
    /// # Panics
    /// If there is not one value per parameter.
    #[must_use]
    pub fn with_parameters(&self, parameters: &[f64]) -> Function {
        Function { uniforms: self.code.uniforms(parameters).into(), ..self.clone() }
    }

    /// The same on other instructions, or with routines that round the same on every machine.
    #[must_use]
    pub fn on(&self, isa: Isa, arithmetic: Arithmetic) -> Function {
        Function { isa, arithmetic, ..self.clone() }
    }

    /// The instructions.
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// The instructions with registers.
    pub(crate) fn tape(&self) -> &Tape {
        &self.tape
    }

    /// Parameters, constants and what depends on these alone, in the order of [`Code::uniforms`].
    pub fn uniforms(&self) -> &[f64] {
        &self.uniforms
    }

    /// Which vector instructions are used, and how routines round.
    pub fn target(&self) -> (Isa, Arithmetic) {
        (self.isa, self.arithmetic)
    }

    /// An evaluator for one configuration at a time.
    pub fn scalar(&self) -> Scalar {
        Scalar::new(&self.tape, &self.uniforms, self.isa, self.arithmetic)
    }

    /// An evaluator for a block of [`Block::lanes`] configurations, as a structure of arrays.
    pub fn block<T: Real>(&self) -> Block<T> {
        Block::new(&self.tape, &self.uniforms, self.isa, self.arithmetic)
    }

    /// An evaluator for any number of configurations, one a row.
    pub fn batch<T: Real>(&self) -> Batch<T> {
        Batch::new(self.block())
    }
}
