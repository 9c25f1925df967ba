//! Tests of emitted source code, one program.

mod c;
mod cuda;
mod emitted;
mod javascript;
mod matlab;
mod python;
mod rust;
mod solver;
mod solver_support;
mod support;
