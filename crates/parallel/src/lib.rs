//! Parallel robots in numbers: all solutions both ways, and their singularities.
//!
//! ```
//! use denavit_parallel::{Robot, catalogue};
//!
//! let description = catalogue::robot("octahedral-hexapod").expect("it is listed");
//! let robot = Robot::from(&description.numbers()?);
//! // All poses for six lengths of legs, each proved, and that there are no others.
//! let found = robot.forward(&[0.9, 0.92, 0.88, 0.91, 0.9, 0.93]);
//! assert!(found.is_complete() && found.most() == 16);
//! for assembly in &found.all {
//!     let legs = robot.inverse(&assembly.pose).expect("every leg reaches")[0].q.clone();
//!     assert!((legs[1] - 0.92).abs() < 1e-12);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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
