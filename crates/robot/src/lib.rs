//! Robot manipulators, exactly: from a Denavit–Hartenberg table to formulas that are proved and programs that compute them.
//!
//! ```
//! use denavit::forward::{ForwardModel, Outputs, Proof};
//! use denavit::inverse::{InverseKinematics, InverseOptions};
//! use denavit::{Robot, catalogue};
//!
//! // A table, as somebody wrote it down.
//! let description = catalogue::robot("ur5").expect("a robot of the catalogue");
//! // Its forward model in formulas, proved equal to the product of its link transforms.
//! let model = ForwardModel::of_tool(&description, Outputs::ALL);
//! assert_eq!(model.proof, Proof::Proved);
//! // In numbers: a pose, and all configurations that bring the tool there.
//! let robot = Robot::numeric(&description)?;
//! let pose = robot.pose(&[0.3, -1.2, 1.5, 0.4, 0.9, -0.6]);
//! let answer = InverseKinematics::new(&description, &InverseOptions::default())?.solve(&pose, &[]);
//! assert!(answer.is_complete() && answer.solutions.len() == 8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What is written down:
//!
//! - [`description`]: tables and robot files made precise, their errors; [`catalogue`]: robots that people own or study.
//!
//! What it describes:
//!
//! - [`mechanism`]: the chain to compute with, over numbers or formulas ([`Scalar`]); its moving axes; walks along it.
//! - [`geometry`]: homogeneous transforms and orientations; [`space`]: the joint variables, their limits and whole turns.
//! - [`structure`]: parallel and meeting axes, spherical wrists; [`idealise`]: the special arm beside a nearly special one.
//!
//! What follows from it:
//!
//! - [`forward`]: link transforms, the simplified model, the shortest algorithm for it.
//! - [`velocity`]: Jacobians, singularities, velocities and forces.
//! - [`dynamics`]: torques, inertia, gravity, motion, energy.
//! - [`closure`]: closed loops: their assembly modes, passive joints and velocities.
//! - [`inverse`]: closed forms with their derivation, elimination, redundancy, descent.
//! - [`motion`]: paths of joints and hand, followed and timed; [`workspace`]: where the tool point comes to.
//!
//! Formulas are those of [`symbolic`], compiled ones those of [`program`]. Expressions belong to a thread, whose store grows;
//! [`symbolic::scoped`] gives a derivation a store of its own, dropped behind it.
//!
//! Beside them: [`quantity`], numbers as a person reads them, and [`random`], numbers that look random.

pub mod catalogue;
pub mod closure;
pub mod description;
pub mod dynamics;
pub mod forward;
pub mod geometry;
pub mod idealise;
pub mod inverse;
pub mod mechanism;
pub mod motion;
pub mod quantity;
pub mod random;
pub mod scalar;
mod shared;
pub mod space;
pub mod structure;
pub mod velocity;
pub mod workspace;

pub use denavit_program as program;
pub use denavit_symbolic as symbolic;
pub use description::Description;
pub use mechanism::{Robot, robot};
pub use scalar::Scalar;

/// The code in the README is true.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
