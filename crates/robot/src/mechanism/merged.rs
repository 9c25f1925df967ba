//! The walk over formulas in which parallel axes are merged before anything is multiplied.

use super::elements::{Elementary, elements};
use super::walk::{Line, Walk};
use crate::description::Description;
use crate::geometry::parallel::{flip, parallel};
use crate::geometry::{Axis, Rotation, Transform};
use denavit_symbolic::{Expr, readable};

impl Walk<Expr> {
    /// Every frame in the base as a product along the chain, each from the one before. The only rule besides multiplication
    /// is Rz(a)·Rz(b) = Rz(a+b), for axes that are exactly parallel. An axis passes through the origin of the frame whose z
    /// it is: the one before the row, or behind it.
    pub fn merged(description: &Description) -> Self {
        let n = description.rows.len();
        let mut here = Here {
            x: description.base,
            before: description.base.rotation,
            angle: Expr::int(0),
            since: Rotation::identity(),
        };
        let mut frames = vec![here.x];
        for e in elements(description, 0, n, false, true) {
            match e {
                Elementary::Turn(Axis::Z, angle) => here.joint(angle),
                Elementary::Turn(axis, angle) => here.turn(Rotation::about(axis, angle)),
                Elementary::Shift(axis, length) => here.shift(axis, length),
                Elementary::EndOfRow(_) => frames.push(here.x),
                Elementary::Fixed(tool) => {
                    for axis in Axis::ALL {
                        here.shift(axis, tool.translation.0[axis.index()]);
                    }
                    here.turn(tool.rotation);
                }
            }
        }
        let first = usize::from(!description.convention.begins_with_joint());
        let axes = frames[first..first + n].iter().map(Line::z_of).collect();
        Walk { base: Transform::identity(), frames, tool: here.x, axes }
    }
}

/// The place reached: its rotation is `before · Rz(angle) · since`, with a constant `since`.
struct Here {
    x: Transform<Expr>,
    before: Rotation<Expr>,
    angle: Expr,
    since: Rotation<Expr>,
}

impl Here {
    /// About the current z. If that is parallel to the z of the turn before, the angles are added and `before`,
    /// which often has zeros, serves again.
    fn joint(&mut self, theta: Expr) {
        match parallel(&self.since) {
            // Rz(φ)·Rz(γ)·S·Rz(θ) = Rz(φ + γ ± θ)·S, with S = 1 or Rx(π)
            Some((gamma, flipped)) => {
                self.angle = self.angle + gamma + if flipped { -theta } else { theta };
                self.since = flip(flipped);
            }
            None => {
                (self.before, self.angle, self.since) = (self.x.rotation, theta, Rotation::identity());
            }
        }
        self.x.rotation = self.before * Rotation::about_z(self.angle) * self.since;
    }

    /// A constant rotation.
    fn turn(&mut self, r: Rotation<Expr>) {
        self.since = (self.since * r).map(readable::settled);
        self.x.rotation = self.x.rotation * r;
    }

    /// Along a current axis.
    fn shift(&mut self, axis: Axis, length: Expr) {
        self.x.translation = self.x.translation + self.x.rotation.column(axis).scale(length);
    }
}
