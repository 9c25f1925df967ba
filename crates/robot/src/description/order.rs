//! A row as screws, in the order of its convention: the one place that knows it.
//!
//! With Z = Rz(θ)·Tz(d), X = Rx(α)·Tx(a) and the branch B = Rz(γ)·Tz(b), a row is Z·X in the standard convention, X·Z in
//! Craig's, B·X·Z in Khalil's.

use super::{Convention, Row};
use crate::geometry::{Axis, Transform};
use denavit_symbolic::Expr;

/// A rotation about and a translation along one axis, which commute.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Screw {
    /// The axis of both.
    pub axis: Axis,
    /// Radians.
    pub angle: Expr,
    /// Metres.
    pub length: Expr,
}

/// The screws of a row, in order.
#[derive(Clone, PartialEq, Debug)]
pub struct Screws {
    /// The constant ones before the joint's.
    pub before: Vec<Screw>,
    /// The joint's own: θ and d.
    pub joint: Screw,
    /// The constant ones behind it.
    pub behind: Vec<Screw>,
}

impl Convention {
    /// True if a row begins with its joint's screw, so that its axis is the z of the frame before; in the other conventions
    /// it is the z of the row's own frame.
    pub fn begins_with_joint(self) -> bool {
        self == Convention::Standard
    }
}

impl Row {
    /// What the row multiplies.
    pub fn screws(&self, convention: Convention) -> Screws {
        let joint = Screw { axis: Axis::Z, angle: self.theta, length: self.d };
        let x = Screw { axis: Axis::X, angle: self.alpha, length: self.a };
        let branch = Screw { axis: Axis::Z, angle: self.gamma, length: self.b };
        match convention {
            Convention::Standard => Screws { before: vec![], joint, behind: vec![x] },
            Convention::Craig => Screws { before: vec![x], joint, behind: vec![] },
            Convention::Khalil => Screws { before: vec![branch, x], joint, behind: vec![] },
        }
    }
}

impl Screw {
    /// True if it does nothing.
    pub fn is_identity(&self) -> bool {
        self.angle.is_zero() && self.length.is_zero()
    }

    /// As a matrix.
    pub fn transform(&self) -> Transform<Expr> {
        let o = Expr::int(0);
        let [x, y, z] = Axis::ALL.map(|a| if a == self.axis { self.length } else { o });
        Transform::rotation_about(self.axis, self.angle) * Transform::translation(x, y, z)
    }
}

impl IntoIterator for Screws {
    type Item = Screw;
    type IntoIter = std::vec::IntoIter<Screw>;
    fn into_iter(self) -> Self::IntoIter {
        let mut all = self.before;
        all.push(self.joint);
        all.extend(self.behind);
        all.into_iter()
    }
}
