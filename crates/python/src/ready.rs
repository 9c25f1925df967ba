//! Programs ready to be called: for one state and for many.

use denavit_jit::MachineCode;
use denavit_program::{Function, Scalar};
use std::sync::{Mutex, PoisonError};

/// A function with what computes one state of it. The bits are those of [`Function`], whoever computes.
pub struct Ready {
    function: Function,
    machine: Option<MachineCode>,
    /// An interpreter that nobody uses now.
    idle: Mutex<Option<Scalar>>,
}

impl Ready {
    /// By the interpreter, which costs nothing to make.
    pub fn new(function: Function) -> Self {
        Ready { function, machine: None, idle: Mutex::default() }
    }

    /// As machine code, where there is some for this processor.
    pub fn native(function: Function) -> Self {
        let machine = MachineCode::compile(&function).ok();
        Ready { function, machine, idle: Mutex::default() }
    }

    /// Whether one state is computed by machine code.
    pub fn is_native(&self) -> bool {
        self.machine.is_some()
    }

    /// The function, for many states.
    pub fn many(&self) -> &Function {
        &self.function
    }

    /// The results of one state.
    ///
    /// # Panics
    /// If there is not one value per variable and one place per result.
    pub fn one(&self, inputs: &[f64], outputs: &mut [f64]) {
        if let Some(machine) = &self.machine {
            return machine.eval(inputs, outputs);
        }
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let mut scalar = idle().take().unwrap_or_else(|| self.function.scalar());
        outputs.copy_from_slice(scalar.eval(inputs));
        *idle() = Some(scalar);
    }
}
