//! The arm in the form that elimination takes: six axes and the constant transforms between them.

use crate::description::JointKind;
use crate::geometry::Transform;
use crate::mechanism::{Lengths, MovingAxes, Robot};
use denavit_elimination::{Arm, Joint, Rigid};
use std::fmt;

/// Why elimination does not serve an arm.
#[derive(Clone, PartialEq, Debug)]
pub enum Unsuited {
    /// It has this many axes that move: not six, nor more of which one joint drives all but five.
    Axes(usize),
    /// A row of the table both turns and slides (counted from 1).
    TwoInOne(usize),
    /// The places of the axes do not determine the joint variables.
    Coupled,
    /// The elimination itself refuses: its words.
    Degenerate(String),
}

impl fmt::Display for Unsuited {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unsuited::Axes(n) => write!(
                f,
                "{n} axes move; elimination serves six, or more where one joint drives all but five of them"
            ),
            Unsuited::TwoInOne(row) => write!(f, "row {row} both turns and slides"),
            Unsuited::Coupled => f.write_str("the places of the axes do not determine the joint variables"),
            Unsuited::Degenerate(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Unsuited {}

/// An arm of six axes, and what its axes are in joint variables: x = C·q + c.
#[derive(Clone, Debug)]
pub struct SixAxes {
    /// The axes and the constant transforms between them.
    pub arm: Arm,
    /// c.
    pub offsets: [f64; 6],
    /// C⁻¹.
    pub inverse: [[f64; 6]; 6],
}

impl SixAxes {
    /// That of a robot with as many joints as axes.
    pub fn new(robot: &Robot<f64>) -> Result<Self, Unsuited> {
        let MovingAxes { moving, constants } = MovingAxes::new(robot, Lengths::Before);
        if let Some(row) = robot.links.iter().position(|l| l.turns() && l.slides()) {
            return Err(Unsuited::TwoInOne(row + 1));
        }
        if moving.len() != 6 || robot.joints != 6 {
            return Err(Unsuited::Axes(moving.len().max(robot.joints)));
        }
        let (mut joints, mut offsets, mut coupling) = ([Joint::Revolute; 6], [0.0; 6], [[0.0; 6]; 6]);
        for (k, axis) in moving.iter().enumerate() {
            if axis.kind == JointKind::Prismatic {
                joints[k] = Joint::Prismatic;
            }
            offsets[k] = axis.value.constant();
            for &(j, factor) in &axis.value.terms {
                coupling[k][j] = factor;
            }
        }
        let inverse = inverted(coupling).ok_or(Unsuited::Coupled)?;
        let arm = Arm {
            base: rigid(&constants[0]),
            joints,
            links: std::array::from_fn(|k| rigid(&constants[k + 1])),
        };
        Ok(SixAxes { arm, offsets, inverse })
    }

    /// The joint variables at values of the axes.
    pub fn joints(&self, x: &[f64; 6]) -> Vec<f64> {
        let of = |row: &[f64; 6]| (0..6).map(|k| row[k] * (x[k] - self.offsets[k])).sum();
        self.inverse.iter().map(of).collect()
    }
}

pub(super) fn rigid(x: &Transform<f64>) -> Rigid {
    Rigid { rotation: x.rotation.rows(), translation: x.translation.0 }
}

/// The inverse of a matrix, by Gauss's and Jordan's elimination.
pub(super) fn inverted(mut m: [[f64; 6]; 6]) -> Option<[[f64; 6]; 6]> {
    let mut inverse: [[f64; 6]; 6] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for k in 0..6 {
        let pivot = (k..6).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs()))?;
        m.swap(k, pivot);
        inverse.swap(k, pivot);
        if m[k][k].abs() < 1e-9 {
            return None;
        }
        let by = 1.0 / m[k][k];
        for j in 0..6 {
            m[k][j] *= by;
            inverse[k][j] *= by;
        }
        for i in (0..6).filter(|&i| i != k) {
            let factor = m[i][k];
            for j in 0..6 {
                m[i][j] -= factor * m[k][j];
                inverse[i][j] -= factor * inverse[k][j];
            }
        }
    }
    Some(inverse)
}
