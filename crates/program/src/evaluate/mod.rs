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
use denavit_symbolic::Symbol;
use std::fmt;
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

    /// Compiles the program; `value` gives its parameters.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn compile_with(&self, value: impl Fn(Symbol) -> Option<f64>) -> Result<Function, MissingValue> {
        Ok(self.compile(&values(self.parameters(), value)?))
    }
}

/// A parameter has no value where a number is needed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MissingValue {
    /// The parameters without value.
    pub parameters: Vec<String>,
}

impl fmt::Display for MissingValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no value for {}", self.parameters.join(", "))
    }
}

impl std::error::Error for MissingValue {}

/// The values of parameters, in order; `value` gives each.
///
/// # Errors
/// If a parameter has no value.
pub fn values(
    parameters: &[Symbol],
    value: impl Fn(Symbol) -> Option<f64>,
) -> Result<Vec<f64>, MissingValue> {
    let found: Vec<Option<f64>> = parameters.iter().map(|&s| value(s)).collect();
    let missing = parameters.iter().zip(&found).filter(|(_, x)| x.is_none());
    let missing: Vec<String> = missing.map(|(s, _)| s.name().to_string()).collect();
    if missing.is_empty() {
        Ok(found.into_iter().flatten().collect())
    } else {
        Err(MissingValue { parameters: missing })
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
