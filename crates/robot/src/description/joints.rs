//! The joints of a description as a space of numbers.

use super::{Description, JointKind};
use crate::space::{JointSpace, Periods};
use denavit_symbolic::Symbol;

impl JointSpace {
    /// That of a description; limits without value are none. `reach` is the sum of the robot's lengths, metres.
    pub fn new(description: &Description, reach: f64) -> Self {
        let value = |s: Symbol| description.value(s);
        let limits = description.rows.iter().filter(|r| r.variable.is_some()).map(|r| {
            let [low, high] = r.limits?;
            Some([low.eval(value).ok()?, high.eval(value).ok()?])
        });
        let is_angle = description.variables().iter().map(|v| v.kind == JointKind::Revolute).collect();
        JointSpace { is_angle, limits: limits.collect(), reach, turning: Periods::of(description) }
    }
}
