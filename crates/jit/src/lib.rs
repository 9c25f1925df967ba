//! Machine code.
mod emit;
mod memory;
use denavit_program::Function;
use std::sync::Arc;
/// A function as machine code.
#[derive(Clone)]
pub struct MachineCode { function: Function, loaded: Arc<memory::Loaded> }
impl MachineCode {
    /// Compiles.
    pub fn compile(function: &Function) -> Result<Self, cranelift_module::ModuleError> {
        Ok(MachineCode { function: function.clone(), loaded: memory::Loaded::new(function.code())?.into() })
    }
    /// The results.
    #[inline]
    #[allow(unsafe_code)]
    pub fn eval(&self, variables: &[f64], results: &mut [f64]) {
        assert_eq!(variables.len(), self.function.code().variables);
        assert_eq!(results.len(), self.function.code().outputs.len());
        unsafe { self.loaded.run(variables.as_ptr(), self.function.uniforms().as_ptr(), results.as_mut_ptr(), self.function.target()) }
    }
}
