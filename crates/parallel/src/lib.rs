//! Parallel robots in numbers: all solutions both ways, and their singularities.
//!
//! - [`stewart`]: Stewart platforms: lengths of legs in closed form, all poses by homotopy, each proved and counted.
//! - [`delta`]: delta robots that turn or slide: eight modes, and two positions, in closed form.
//! - [`planar`]: planar 3-RRR robots: eight modes in closed form, up to six poses, counted for sure.
//! - [`Robot`]: any of them, behind one set of questions.
//! - [`rates`]: J_x ẋ = J_q q̇, singularities of both kinds, and the motion that is gained.
//! - [`catalogue`]: robots that come with the program.
//!
//! Below them: [`interval`] arithmetic, [`complex`] numbers, [`lu`] (linear equations), [`roots`] of polynomials.

pub mod catalogue;
pub mod complex;
pub mod delta;
pub mod interval;
pub mod lu;
pub mod planar;
pub mod rates;
mod robot;
pub mod roots;
pub mod stewart;

pub use delta::Delta;
pub use planar::Planar;
pub use rates::Rates;
pub use robot::{Assemblies, Assembly, Known, Robot, Solution};
pub use stewart::Stewart;
