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
//!
//! [`Function`]: denavit_program::Function
//! [`Function::scalar`]: denavit_program::Function::scalar
//! [`Function::batch`]: denavit_program::Function::batch
//! [`Function::target`]: denavit_program::Function::target

mod code;
mod emit;
mod error;
mod native;
mod routines;
mod solver;

pub use code::MachineCode;
pub use error::Error;
pub use solver::MachineSolver;
