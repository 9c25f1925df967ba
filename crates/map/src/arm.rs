//! What is known of the arm besides its functions.

/// Names and kinds of joints.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Arm {
    /// The robot's name.
    pub name: String,
    /// The names of its joint variables, and what they are called in its file.
    pub joints: Vec<[String; 2]>,
    /// Which joints turn.
    pub is_angle: Vec<bool>,
}
