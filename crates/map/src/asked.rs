//! What is asked of which robot.

use crate::request::Request;

/// A request with what its columns need to know of the robot.
#[derive(Clone)]
pub struct Asked {
    /// The robot's name.
    pub robot: String,
    /// The names of its joint variables, and what they are called in its file.
    pub joints: Vec<[String; 2]>,
    /// Which joints turn.
    pub is_angle: Vec<bool>,
    pub request: Request,
}
