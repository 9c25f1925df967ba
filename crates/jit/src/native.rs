//! Code in memory: how it gets there, how it is called, when it is freed.
//!
//! All `unsafe` code of the crate is here.
#![allow(unsafe_code)]

use crate::emit::{Callees, emit};
use crate::error::Error;
use crate::routines::{ANGLES, POINTS, Results, Routines};
use cranelift_codegen::ir::{AbiParam, types::F64};
use cranelift_codegen::settings::{self, Configurable, Flags, SetError};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{Linkage, Module, ModuleError, default_libcall_names};
use denavit_program::{Code, Function};

/// Generated code: variables, uniforms, results, and what routines write to.
type Entry = unsafe extern "C" fn(*const f64, *const f64, *mut f64, *mut Results);

/// Values up to which offsets in arrays of doubles fit into an instruction.
const MOST_VALUES: usize = 1 << 27;

/// The code of a function, freed when this is dropped.
pub(crate) struct Native {
    entry: Entry,
    /// The memory; taken by `drop` alone.
    module: Option<JITModule>,
    variables: usize,
    uniforms: usize,
    results: usize,
}

// SAFETY: what keeps a `JITModule` from being shared is its table of symbols, which is looked at while code is linked;
// after `Native::new` the module is touched by `drop` alone, which has it to itself. The code only reads what is
// its own, and writes to the arguments of the call.
unsafe impl Sync for Native {}

impl Native {
    /// Translates the body of a function.
    pub fn new(function: &Function) -> Result<Self, Error> {
        let code = function.code();
        if code.values.max(code.outputs.len()) > MOST_VALUES {
            return Err(Error::Refused(format!("more than {MOST_VALUES} values")));
        }
        let host = cranelift_native::builder().map_err(|e| Error::Host(e.to_string()))?;
        let flags = flags().map_err(|e| Error::Host(e.to_string()))?;
        let isa = host.finish(flags).map_err(|e| Error::Host(e.to_string()))?;
        let (vectors, arithmetic) = function.target();
        let routines = Routines::of(vectors, arithmetic);
        let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
        builder.symbol(SIN_COS, routines.sin_cos).symbol(ATAN2, routines.atan2);
        let mut module = JITModule::new(builder);
        match entry(&mut module, code) {
            Ok(entry) => Ok(Native {
                entry,
                module: Some(module),
                variables: code.variables,
                uniforms: code.first_of_body() - code.variables,
                results: code.outputs.len(),
            }),
            Err(e) => {
                // SAFETY: no address of this module has left `entry`.
                unsafe { module.free_memory() };
                Err(Error::Refused(e.to_string()))
            }
        }
    }

    /// Runs the code.
    ///
    /// # Panics
    /// If a slice has not the length that the code was made for.
    #[inline]
    pub fn run(&self, variables: &[f64], uniforms: &[f64], results: &mut [f64]) {
        assert_eq!(variables.len(), self.variables, "one value per variable");
        assert_eq!(uniforms.len(), self.uniforms, "one value per uniform");
        assert_eq!(results.len(), self.results, "one place per result");
        let mut scratch = Results::NONE;
        // SAFETY: the code reads the first two arrays and writes the third, each within the length that was just
        // checked; borrows keep them alive and apart. It reads of `scratch` what a routine has written there. The
        // module, and the code with it, lives as long as `self`. The routines were chosen for an `Isa`, which exists
        // only where its instructions were found; all other instructions Cranelift has found on this processor.
        unsafe {
            (self.entry)(variables.as_ptr(), uniforms.as_ptr(), results.as_mut_ptr(), &raw mut scratch);
        }
    }
}

impl Drop for Native {
    fn drop(&mut self) {
        if let Some(module) = self.module.take() {
            // SAFETY: `entry` is called through `&self` only, so nothing runs and nothing will.
            unsafe { module.free_memory() };
        }
    }
}

const SIN_COS: &str = "sin_cos";
const ATAN2: &str = "atan2";

fn flags() -> Result<Flags, SetError> {
    let mut flags = settings::builder();
    flags.set("opt_level", "speed")?;
    flags.set("is_pic", "false")?;
    flags.set("use_colocated_libcalls", "false")?;
    flags.set("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" })?;
    Ok(Flags::new(flags))
}

/// Compiles and links.
fn entry(module: &mut JITModule, code: &Code) -> Result<Entry, Box<ModuleError>> {
    let pointer = AbiParam::new(module.target_config().pointer_type());
    // Both routines have the same signature: `Routines` gives it.
    const { assert!(2 * POINTS == ANGLES) };
    let mut routine = module.make_signature();
    routine.params.extend([AbiParam::new(F64); ANGLES]);
    routine.params.push(pointer);
    let sin_cos = module.declare_function(SIN_COS, Linkage::Import, &routine)?;
    let atan2 = module.declare_function(ATAN2, Linkage::Import, &routine)?;

    let mut context = module.make_context();
    context.func.signature.params.extend([pointer; 4]);
    let callees = Callees {
        sin_cos: module.declare_func_in_func(sin_cos, &mut context.func),
        atan2: module.declare_func_in_func(atan2, &mut context.func),
    };
    emit(code, &callees, &mut context.func, module.target_config());
    let own = module.declare_anonymous_function(&context.func.signature)?;
    module.define_function(own, &mut context)?;
    module.finalize_definitions()?;
    let address = module.get_finalized_function(own);
    // SAFETY: the function was declared with four pointers, no result and the default convention, which is C's.
    Ok(unsafe { std::mem::transmute::<*const u8, Entry>(address) })
}
