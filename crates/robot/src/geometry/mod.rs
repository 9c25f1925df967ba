//! Vectors, rotations, rigid transforms, the ways to write an orientation, and bodies by their mass.
//!
//! A transform `x_ab` is frame `b` seen from frame `a`: it takes the coordinates of a point in `b` to its
//! coordinates in `a`, and inner letters cancel, `x_ac = x_ab * x_bc`. Frames are right-handed, angles in
//! radians, lengths in metres (or any one unit: nothing here depends on it).
//!
//! Everything but the reading of orientations is straight-line code over [`Scalar`](crate::scalar::Scalar):
//! `f64` for numbers, `Expr` for formulas.

pub mod body;
pub mod orientation;
pub(crate) mod parallel;
pub mod rotation;
pub mod transform;
pub mod vector;

pub use body::{Body, NoBody, PARAMETERS};
pub(crate) use orientation::quaternion;
pub use orientation::{EulerSet, Orientation, OrientationError, OrientationSet};
pub use rotation::{NotRigid, RIGID_TOLERANCE, Rotation};
pub use transform::Transform;
pub(crate) use transform::nearest_rigid;
pub use vector::{Axis, Vector};
