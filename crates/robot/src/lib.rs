//! Robot manipulators, exactly: from a Denavit–Hartenberg table to formulas that are proved.
//!
//! - [`description`]: what somebody wrote down, made precise: tables, robot files, their errors.
//! - [`geometry`]: homogeneous transforms and orientations, usable on their own.
//! - [`space`]: the joint variables: angles and lengths, limits, copies whole turns away.
//! - [`mechanism`]: the chain to compute with, over numbers or formulas; its moving axes; walks along it.
//! - [`structure`]: parallel and meeting axes, spherical wrists.
//! - [`idealise`]: the special arm beside a nearly special one.
//! - [`inverse`]: inverse kinematics of any arm: closed forms with their derivation, elimination, redundancy, descent.
//! - [`catalogue`]: robots that people own or study.
//! - [`forward`]: link transforms, the simplified forward model, the shortest algorithm for it.
//! - [`velocity`]: Jacobians, singularities, velocities and forces.
//! - [`quantity`]: numbers as a person reads them.
//! - [`motion`]: paths of joints and hand, followed and timed.

pub mod catalogue;
pub mod description;
pub mod forward;
pub mod geometry;
pub mod idealise;
pub mod inverse;
pub mod mechanism;
pub mod motion;
pub mod quantity;
pub mod random;
pub mod scalar;
pub mod space;
pub mod structure;
pub mod velocity;
pub mod workspace;

pub use description::Description;
pub use mechanism::{Robot, robot};
pub use scalar::Scalar;

/// The code in the README is true.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
