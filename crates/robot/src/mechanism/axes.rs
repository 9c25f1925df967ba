//! The normal form of a chain: its moving axes with the constants between them, C₀ A₁ C₁ A₂ … Aₙ Cₙ.
//!
//! Aₖ turns about z or slides along it by an affine form of the joint variables; C₀ begins in the base, Cₙ ends at the tool.
//! Rz and Tz about one axis commute, so what is constant of a joint's own row may stand on either side of the joint: an
//! angle beside a slide stands before it, a length beside a turn where [`Lengths`] says. In a row that turns and slides the
//! turn comes first.

use super::robot::{Affine, Robot};
use crate::description::JointKind;
use crate::geometry::{Axis, Rotation, Transform, Vector};
use crate::scalar::Scalar;

/// A chain in normal form.
#[derive(Clone, Debug)]
pub struct MovingAxes<T> {
    /// The moving axes, base first.
    pub moving: Vec<MovingAxis<T>>,
    /// The constants: `constants[k]` stands before axis k, the last behind the last axis.
    pub constants: Vec<Transform<T>>,
}

/// An axis that moves, along z.
#[derive(Clone, Debug)]
pub struct MovingAxis<T> {
    /// Whether it turns or slides.
    pub kind: JointKind,
    /// Its angle or displacement.
    pub value: Affine<T>,
    /// The row of the table it stands in, from 0.
    pub row: usize,
}

/// On which side of a turn the constant length of its own row stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Lengths {
    /// In the constant before it.
    Before,
    /// In the constant behind it.
    Behind,
}

impl<T: Scalar> MovingAxes<T> {
    /// Those of a robot.
    pub fn new(robot: &Robot<T>, lengths: Lengths) -> Self {
        let (mut moving, mut constants) = (vec![], vec![]);
        let mut constant = robot.base;
        for (row, link) in robot.links.iter().enumerate() {
            let (turns, slides) = (link.turns(), link.slides());
            if !turns && !slides {
                constant = constant * link.transform(&[]);
                continue;
            }
            constant = constant * link.before;
            let length = Transform::translation_z(link.d.offset);
            let mut behind = link.after;
            match (turns, slides, lengths) {
                (true, false, Lengths::Before) => constant = constant * length,
                (true, false, Lengths::Behind) => behind = length * behind,
                (false, ..) => constant = constant * turned(&link.theta),
                (true, true, _) => {}
            }
            let screw = [(turns, JointKind::Revolute, &link.theta), (slides, JointKind::Prismatic, &link.d)];
            for (_, kind, value) in screw.into_iter().filter(|s| s.0) {
                moving.push(MovingAxis { kind, value: value.clone(), row });
                constants.push(std::mem::replace(&mut constant, Transform::identity()));
            }
            constant = behind;
        }
        constants.push(constant * robot.tool);
        MovingAxes { moving, constants }
    }
}

impl<T: Scalar> MovingAxis<T> {
    /// Its motion with all joint variables 0.
    pub fn at_rest(&self) -> Transform<T> {
        match self.kind {
            JointKind::Revolute => turned(&self.value),
            JointKind::Prismatic => Transform::translation_z(self.value.offset),
        }
    }

    /// Its motion where the joints are.
    pub fn at(&self, q: &[T]) -> Transform<T> {
        match self.kind {
            JointKind::Revolute => {
                let (s, c) = self.value.sin_cos(q);
                Transform::from_rotation_translation(Rotation::from_sin_cos(Axis::Z, s, c), Vector::zero())
            }
            JointKind::Prismatic => Transform::translation_z(self.value.value(q)),
        }
    }
}

/// Rz by the constant part of an angle.
fn turned<T: Scalar>(angle: &Affine<T>) -> Transform<T> {
    let (s, c) = angle.at_rest().sin_cos(&[]);
    Transform::from_rotation_translation(Rotation::from_sin_cos(Axis::Z, s, c), Vector::zero())
}
