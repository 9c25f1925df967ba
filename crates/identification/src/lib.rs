//! Inertial parameters of an arm from recorded motion and torques, and motions that show them.
//!
//! - [`Model`]: the torques as a linear function of base parameters, rotors, friction and offsets.
//! - [`identify`]: [`Columns`] to a [`Motion`] (even times, filters without delay, rates), to [`Observations`], to an [`Estimate`] with
//!   deviations, with what the motion does not tell, and with what is [`Suspect`] of the recording.
//! - [`consistent`]: masses that can be, with the estimated torques, nearest to given ones.
//! - [`excite`]: Fourier series within limits that show the parameters best.
//!
//! No file is opened and no clock is read.

mod columns;
mod consistent;
mod described;
mod estimate;
mod excite;
mod identify;
mod linear;
mod model;
mod motion;
mod observations;
mod signal;
mod suspects;
pub mod words;

pub use columns::{Column, Joints, NoColumns, Roles, Told};
pub use consistent::{Consistent, Prior, consistent, even_mass, scale};
pub use described::{NoPlace, described};
pub use estimate::{Estimate, Known, OfJoint, Options};
pub use excite::{Criterion, Excitation, Limits, NoExcitation, Search, excite};
pub use identify::{Asked, Identified, identify};
pub use linear::Square;
pub use model::{Model, NoModel, Parameter, Sought, What};
pub use motion::{Columns, Cutoff, Motion, NoMotion, Remark, Stretch};
pub use observations::{Normal, Observations, Row};
pub use suspects::Suspect;
