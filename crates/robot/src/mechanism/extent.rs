//! The space of a robot's joints with the robot's own lengths.

use super::Robot;
use crate::description::Description;
use crate::space::JointSpace;

impl JointSpace {
    /// That of a description with its numbers; limits without value are none.
    pub fn new(description: &Description, robot: &Robot<f64>) -> Self {
        JointSpace { reach: robot.reach(), foot: robot.foot(), ..Self::without_lengths(description) }
    }
}
