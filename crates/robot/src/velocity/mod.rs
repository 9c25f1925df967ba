//! Differential kinematics: velocities, singularities, forces.
//!
//! A twist has six components, linear first (`vw`): the velocity of a point of the moving body, metres a second, and
//! the body's angular velocity, radians a second. A [`Viewpoint`] says which body, which point, and along whose axes.

mod analytic;
mod derivatives;
mod geometric;
mod inverse;
mod measures;
mod model;
mod nearest;
mod program;
mod regular;
mod singular;
mod solve;
mod svd;
mod wrench;

pub use analytic::{AnalyticJacobian, analytic, determinant, rates};
pub use derivatives::{hessian_program, rate_program};
pub(crate) use geometric::of_tool;
pub use geometric::{Jacobian, ROWS, Viewpoint, geometric};
pub use inverse::{Blocks, REST, RateFormulas};
pub use measures::{Block, Measures, RANK, Whole, measures};
pub use model::JacobianModel;
pub use nearest::{NearestSingularity, nearest_singularity};
pub use program::{jacobian_and_pose_program, jacobian_program};
pub use regular::regular_configuration;
pub use singular::{
    Example, MAX_JOINTS, Minor, Obstacle, Place, Singularities, Singularity, Still, singular_configuration,
    singular_configurations,
};
pub use solve::{Damping, JointRates, RateSolver};
pub(crate) use svd::dot;
pub use svd::{Svd, singular_values, svd};
pub use wrench::{Wrench, largest_wrench, torques};
