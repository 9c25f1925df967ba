//! Objects: what only pointers to are seen of.

use crate::robot;
use crate::solver;
use std::sync::Arc;

/// A robot: one chain of joints with its tool. Used by any number of threads at once.
#[derive(Debug)]
pub struct Robot(pub Arc<robot::Core>);

/// The inverse kinematics of a robot, prepared. Used by any number of threads at once.
#[derive(Debug)]
pub struct Solver(pub Arc<solver::Core>);

/// All that was found for a pose.
#[derive(Debug)]
pub struct Answer(pub solver::Found);

const _: () = {
    const fn shared<T: Send + Sync>() {}
    shared::<Robot>();
    shared::<Solver>();
    shared::<Answer>();
};
