//! A function as machine code.

use crate::error::Error;
use crate::native::Native;
use denavit_program::Function;
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
