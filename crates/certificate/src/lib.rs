//! Proofs that others can check: an equality of formulas as an identity of polynomials, with the cofactors that make it one.
//!
//! - [`Certificate`]: claims about a robot, each proved from its table by expanding both sides (`field`, `arm`) and dividing
//!   their difference by c² + s² − 1 and the squares of roots; [`forward`], [`jacobian`],
//!   [`inverse`] and [`document`] put claims together.
//! - [`Certificate::to_json`]: for `check_certificate.py`, which uses none of the crates; [`Certificate::to_coq`]: for Coq.
//!
//! Nothing here asks the canonical form whether two formulas are equal.

mod arm;
mod claims;
mod coq;
mod document;
mod field;
mod inverse;
mod json;
mod models;
mod names;
mod text;

pub use arm::{Frame, View};
pub use claims::{Certificate, Claim, MOST_TERMS_IN_ALL, Quantity};
pub use document::document;
pub use field::Obstacle;
pub use inverse::inverse;
pub use models::{forward, jacobian};
