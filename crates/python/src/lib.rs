//! `denavit._denavit`: what the Python package `denavit` is made on.
//!
//! A robot is kept as the text of its file, with what was compiled of it; formulas belong to a thread, and each derivation has one of
//! its own, which ends with it. The package's own Python gives this its arguments, words and classes.

mod arrays;
mod batches;
mod border;
mod compiled;
mod exercises;
mod formulas;
mod inverse;
mod loading;
mod motion;
mod named;
mod packed;
mod programs;
mod ready;
mod robot;
mod strided;
mod symbols;
mod trouble;

use pyo3::prelude::*;

/// The module.
#[pymodule]
fn _denavit(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<robot::Core>()?;
    module.add_class::<compiled::Compiled>()?;
    module.add_class::<compiled::CompiledIk>()?;
    module.add_class::<motion::Moving>()?;
    module.add_class::<batches::Columns>()?;
    module.add_class::<batches::Lent>()?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(robot::catalogue, module)?)?;
    module.add_function(wrap_pyfunction!(symbols::not_proved, module)?)?;
    module.add_function(wrap_pyfunction!(formulas::check, module)?)
}
