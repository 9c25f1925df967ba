//! Machine code for straight-line programs, one configuration at a time.
//!
//! [`MachineCode::compile`] translates a [`Function`] of `denavit-program` through Cranelift, in a fraction of a
//! millisecond. The results have the same bits as those of [`Function::scalar`], which it replaces where one
//! configuration depends on the last, as in a control loop. Many configurations at once are faster with
//! [`Function::batch`], which uses whole vectors.
//!
//! ```
//! use denavit_jit::MachineCode;
//! use denavit_program::{Graph, Program};
//! use denavit_symbolic::Expr;
//!
//! // r sin x and r cos x, for a parameter r.
//! let [x, r] = ["x", "r"].map(Expr::symbol);
//! let symbol = |e: Expr| e.as_symbol().expect("a symbol");
//! let mut graph = Graph::new(&[symbol(x)], &[symbol(r)]);
//! let outputs = [("u".to_string(), graph.trace(r * x.sin())), ("v".to_string(), graph.trace(r * x.cos()))];
//! let program = Program::new(&graph, &outputs, |_| None, &Default::default());
//!
//! let code = MachineCode::compile(&program.compile(&[2.0]))?;
//! let mut results = [0.0; 2];
//! code.eval(&[0.0], &mut results);
//! assert_eq!(results, [0.0, 2.0]);
//!
//! // Other parameters, the same code.
//! code.with_parameters(&[3.0]).eval(&[0.0], &mut results);
//! assert_eq!(results, [0.0, 3.0]);
//! # Ok::<(), denavit_jit::Error>(())
//! ```
//!
//! Arithmetic becomes scalar instructions, values in registers as far as they reach. Sines and cosines are computed
//! eight in one call, arctangents four, by the routines of [`denavit_program::kernel`] on the vector instructions
//! that the function is for ([`Function::target`]). Parameters and constants are read from an array, so that other
//! parameters need no other code.
//!
//! The code lives in memory of its own, which no part of a program can write once it can run. It is freed with the last
//! [`MachineCode`] that uses it.

mod emit;
mod native;
mod routines;
mod solver;

pub use solver::MachineSolver;

use denavit_program::Function;
use native::Native;
use std::fmt;
use std::sync::Arc;

/// A [`Function`] as machine code. Clones share the code; threads can use it at the same time.
#[derive(Clone)]
pub struct MachineCode {
    function: Function,
    native: Arc<Native>,
}

impl MachineCode {
    /// Translates a function, for its instructions and rounding ([`Function::on`]).
    ///
    /// # Errors
    /// If Cranelift has no code for this processor, or the function is too large for it.
    pub fn compile(function: &Function) -> Result<Self, Error> {
        Ok(MachineCode { function: function.clone(), native: Native::new(function)?.into() })
    }

    /// The same with other values for its parameters; nothing is compiled again.
    ///
    /// # Panics
    /// If there is not one value per parameter.
    #[must_use]
    pub fn with_parameters(&self, parameters: &[f64]) -> Self {
        MachineCode { function: self.function.with_parameters(parameters), native: self.native.clone() }
    }

    /// The function that was translated, with the parameters of this one.
    pub fn function(&self) -> &Function {
        &self.function
    }

    /// The results at a configuration. Nothing is allocated.
    ///
    /// # Panics
    /// If there is not one value per variable and one place per result.
    #[inline]
    pub fn eval(&self, variables: &[f64], results: &mut [f64]) {
        self.native.run(variables, self.function.uniforms(), results);
    }
}

impl fmt::Debug for MachineCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MachineCode").field("function", &self.function).finish_non_exhaustive()
    }
}

/// Why there is no machine code.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Error {
    /// Cranelift has no code for this processor or system.
    Host(String),
    /// Cranelift does not translate this function: it is too large, or there is no memory for it.
    Refused(String),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Host(why) => write!(f, "no machine code on this processor: {why}"),
            Error::Refused(why) => write!(f, "no machine code for this function: {why}"),
        }
    }
}

impl std::error::Error for Error {}
