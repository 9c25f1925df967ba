//! The joints of a description as a space of numbers.

use super::{Description, JointKind, Variable};
use crate::geometry::Vector;
use crate::space::{JointSpace, Periods};
use denavit_symbolic::Symbol;

impl Description {
    /// What the file calls the joints, by the order of their variables; nothing where it has no names. A joint without one is called as
    /// its variable.
    pub fn joint_names(&self) -> Option<Vec<String>> {
        let moving = self.rows.iter().filter_map(|r| Some((r.variable?, r.name.as_ref())));
        let has_names = moving.clone().any(|m| m.1.is_some());
        let name = |(v, name): (Variable, Option<&String>)| {
            name.map_or_else(|| v.symbol.name().to_string(), Clone::clone)
        };
        has_names.then(|| moving.map(name).collect())
    }
}

impl JointSpace {
    /// Joints, limits and periods of a description, without lengths; limits without value are none.
    pub fn without_lengths(description: &Description) -> Self {
        let value = |s: Symbol| description.value(s);
        let limits = description.rows.iter().filter(|r| r.variable.is_some()).map(|r| {
            let [low, high] = r.limits?;
            Some([low.eval(value).ok()?, high.eval(value).ok()?])
        });
        let is_angle = description.variables().iter().map(|v| v.kind == JointKind::Revolute).collect();
        let turning = Periods::of(description);
        JointSpace { is_angle, limits: limits.collect(), reach: 0.0, foot: Vector([0.0; 3]), turning }
    }
}
