//! Machine code in memory.
#![allow(unsafe_code)]

use crate::emit::{Routines, emit};
use cranelift_codegen::ir::AbiParam;
use cranelift_codegen::settings::{self, Configurable};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{Linkage, Module, ModuleError, default_libcall_names};
use denavit_program::{Arithmetic, Code, Isa, atan2_8, sin_cos_8};

#[repr(C, align(64))]
pub(crate) struct Scratch {
    pub x: [f64; 8],
    pub s: [f64; 8],
    pub c: [f64; 8],
    pub isa: Isa,
    pub arithmetic: Arithmetic,
}

impl Scratch {
    pub const LANES: usize = 8;
}

extern "C" fn sin_cos(w: &mut Scratch) {
    sin_cos_8(w.isa, w.arithmetic, &w.x, &mut w.s, &mut w.c);
}

extern "C" fn atan2(w: &mut Scratch) {
    atan2_8(w.isa, w.arithmetic, &w.s, &w.x, &mut w.c);
}

type Entry = unsafe extern "C" fn(*const f64, *const f64, *mut f64, *mut Scratch);

pub(crate) struct Loaded {
    module: Option<JITModule>,
    entry: Entry,
}
unsafe impl Sync for Loaded {}
unsafe impl Send for Loaded {}

impl Loaded {
    pub fn new(code: &Code) -> Result<Self, ModuleError> {
        let mut flags = settings::builder();
        flags.set("opt_level", &std::env::var("OPT").unwrap_or("speed".into()))?;
        flags.set("use_colocated_libcalls", "false")?;
        flags.set("is_pic", "false")?;
        flags.set("enable_verifier", &std::env::var("VERIFY").unwrap_or("true".into()))?;
        let isa = cranelift_native::builder().expect("host").finish(settings::Flags::new(flags)).expect("isa");
        let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
        builder.symbol("sin_cos", sin_cos as *const u8);
        builder.symbol("atan2", atan2 as *const u8);
        let mut module = JITModule::new(builder);
        let pointer = AbiParam::new(module.target_config().pointer_type());
        let mut routine = module.make_signature();
        routine.params.push(pointer);
        let mut own = module.make_signature();
        own.params.extend([pointer; 4]);
        let s = module.declare_function("sin_cos", Linkage::Import, &routine)?;
        let a = module.declare_function("atan2", Linkage::Import, &routine)?;
        let main = module.declare_anonymous_function(&own)?;
        let mut ctx = module.make_context();
        ctx.func.signature = own;
        let routines = Routines { sin_cos: module.declare_func_in_func(s, &mut ctx.func), atan2: module.declare_func_in_func(a, &mut ctx.func) };
        emit(code, &routines, &mut ctx.func, module.target_config());
        if std::env::var("DUMP").is_ok() { ctx.set_disasm(true); }
        module.define_function(main, &mut ctx)?;
        if std::env::var("DUMP").is_ok() { println!("{}", ctx.compiled_code().unwrap().vcode.as_ref().unwrap()); }
        module.finalize_definitions()?;
        let entry = unsafe { std::mem::transmute::<*const u8, Entry>(module.get_finalized_function(main)) };
        Ok(Loaded { module: Some(module), entry })
    }

    #[inline]
    pub unsafe fn run(&self, variables: *const f64, uniforms: *const f64, results: *mut f64, target: (Isa, Arithmetic)) {
        let mut scratch = Scratch { x: [0.0; 8], s: [0.0; 8], c: [0.0; 8], isa: target.0, arithmetic: target.1 };
        unsafe { (self.entry)(variables, uniforms, results, &mut scratch) };
    }
}

impl Drop for Loaded {
    fn drop(&mut self) {
        if let Some(module) = self.module.take() {
            unsafe { module.free_memory() };
        }
    }
}
