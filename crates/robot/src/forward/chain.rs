//! The chain in factors of one angle each, parallel axes merged before anything is multiplied.
//!
//! ⁱTⱼ = [F₁F₂…Fₘ, Σ F₁…Fₖ·ℓ·v]: every factor turns about one (merged) angle, quarter turns folded in, or is a
//! constant; every item is a length ℓ along a direction v given in frame k. Joints whose axes stay parallel share
//! a factor: Rz(θ2)·Tx(a)·Rz(θ3) is Rz(θ2+θ3) with the item a·(C2, S2, 0) before it. Whether axes are parallel is
//! read off the exact constant rotation between them, so that a turn there and back is found, and 89.99° is not.

use crate::description::Description;
use crate::geometry::parallel::{flip, parallel};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use crate::mechanism::elements::{Elementary, elements};
use denavit_symbolic::{Angle, Expr, Symbol, readable};

/// A chain of rotations about one angle each, with the displacements between them.
#[derive(Clone, Debug)]
pub struct Chain {
    /// The rotation factors; entries are 0, ±1, ±C, ±S of one angle, or constants.
    pub factors: Vec<Rotation<Expr>>,
    /// The displacements.
    pub items: Vec<Item>,
    /// The angles whose sines and cosines occur, along the chain.
    pub angles: Vec<Angle>,
    /// For each frame 0 … m between factors, the number of the table's row behind which it stands.
    pub frames: Vec<usize>,
}

/// A displacement: `length · direction`, in frame `frame`.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// The number of factors before the frame.
    pub frame: usize,
    /// A unit vector in that frame.
    pub direction: Vector<Expr>,
    /// A length, constant or a joint variable with its offset.
    pub length: Expr,
}

impl Chain {
    /// The chain of rows `from+1 … to`, with the base before row 1 and the tool behind the last on request.
    pub fn new(description: &Description, from: usize, to: usize, base: bool, tool: bool) -> Self {
        let mut builder = Builder {
            variables: description.variables().iter().map(|v| v.symbol).collect(),
            folds_behind: description.convention.begins_with_joint(),
            chain: Chain { factors: vec![], items: vec![], angles: vec![], frames: vec![from] },
            group: None,
            constant: Rotation::identity(),
            row: from,
        };
        elements(description, from, to, base, tool).into_iter().for_each(|e| builder.push(e));
        builder.finish()
    }

    /// The product of the factors and items: the transform that the chain stands for.
    pub fn transform(&self) -> Transform<Expr> {
        let mut rotation = Rotation::identity();
        let mut position = Vector::zero();
        for k in 0..=self.factors.len() {
            for item in self.items.iter().filter(|i| i.frame == k) {
                position = position + rotation * item.direction.scale(item.length);
            }
            if let Some(factor) = self.factors.get(k) {
                rotation = rotation * *factor;
            }
        }
        Transform::from_rotation_translation(rotation, position)
    }
}

/// A run of parallel joints: `before · Rz(angle)`, then the builder's constant rotation.
struct Group {
    before: Rotation<Expr>,
    angle: Expr,
    /// Displacements since the last joint, in the frame right behind Rz.
    pending: Vec<(Vector<Expr>, Expr)>,
}

struct Builder {
    variables: Vec<Symbol>,
    /// Constant quarter turns belong to the factor before them (standard), or to the one behind (Craig), so that
    /// the frames between factors are the table's own.
    folds_behind: bool,
    chain: Chain,
    group: Option<Group>,
    /// The constant rotation since the last joint.
    constant: Rotation<Expr>,
    row: usize,
}

impl Builder {
    fn push(&mut self, e: Elementary) {
        match e {
            Elementary::Turn(Axis::Z, angle) if self.varies(angle) => self.joint(angle),
            Elementary::Turn(axis, angle) => self.turn(Rotation::about(axis, angle)),
            Elementary::Shift(axis, length) => self.shift(Vector::unit(axis), length),
            Elementary::Fixed(x) => {
                for axis in [Axis::X, Axis::Y, Axis::Z] {
                    self.shift(Vector::unit(axis), x.translation.0[axis.index()]);
                }
                self.turn(x.rotation);
            }
            Elementary::EndOfRow(row) => self.row = row,
        }
    }

    fn varies(&self, e: Expr) -> bool {
        e.symbols().iter().any(|s| self.variables.contains(s))
    }

    fn turn(&mut self, rotation: Rotation<Expr>) {
        if rotation != Rotation::identity() {
            // A turn there and back is the identity to the letter.
            self.constant = (self.constant * rotation).map(readable::settled);
        }
    }

    fn shift(&mut self, axis: Vector<Expr>, length: Expr) {
        if length.is_zero() {
            return;
        }
        if !is_signed_unit(self.constant * axis) && parallel(&self.constant).is_none() {
            self.close();
            self.constant_factor();
        }
        let direction = self.constant * axis;
        match &mut self.group {
            Some(group) => group.pending.push((direction, length)),
            None => self.chain.items.push(Item { frame: self.chain.factors.len(), direction, length }),
        }
    }

    /// A joint turns by `theta` about the current z.
    fn joint(&mut self, theta: Expr) {
        let frame = self.chain.factors.len();
        match (parallel(&self.constant), &mut self.group) {
            (Some((gamma, flipped)), Some(group)) => {
                // Rz(Φ)·Rz(γ)·S·Rz(θ) = Rz(Φ + γ ± θ)·S, with S = 1 or Rx(π)
                let turned = group.before * Rotation::about_z(group.angle);
                for (direction, length) in group.pending.drain(..) {
                    self.chain.items.push(Item { frame, direction: turned * direction, length });
                }
                group.angle = group.angle + gamma + if flipped { -theta } else { theta };
                self.constant = flip(flipped);
            }
            (Some((gamma, flipped)), None) => {
                let angle = gamma + if flipped { -theta } else { theta };
                self.group = Some(Group { before: Rotation::identity(), angle, pending: vec![] });
                self.constant = flip(flipped);
            }
            (None, _) => {
                self.close();
                if !is_signed_permutation(&self.constant) {
                    self.constant_factor();
                }
                self.group = Some(Group { before: self.constant, angle: theta, pending: vec![] });
                self.constant = Rotation::identity();
            }
        }
        if let Some(group) = &self.group {
            let angle = Angle::of(group.angle);
            if !self.chain.angles.contains(&angle) {
                self.chain.angles.push(angle);
            }
        }
    }

    /// Ends the group: its factor is complete.
    fn close(&mut self) {
        let Some(group) = self.group.take() else { return };
        let mut factor = group.before * Rotation::about_z(group.angle);
        let mut back = Rotation::identity();
        if self.folds_behind && is_signed_permutation(&self.constant) {
            factor = factor * self.constant;
            back = self.constant.inverse();
            self.constant = Rotation::identity();
        }
        self.chain.factors.push(factor);
        self.chain.frames.push(self.row);
        let frame = self.chain.factors.len();
        let items = group.pending.into_iter();
        self.chain.items.extend(items.map(|(v, length)| Item { frame, direction: back * v, length }));
    }

    /// The constant rotation becomes a factor of its own.
    fn constant_factor(&mut self) {
        if self.constant != Rotation::identity() {
            self.chain.factors.push(self.constant);
            self.chain.frames.push(self.row);
            self.constant = Rotation::identity();
        }
    }

    fn finish(mut self) -> Chain {
        self.folds_behind = true; // nothing follows that the last turns could belong to
        self.close();
        self.constant_factor();
        self.chain
    }
}

fn is_signed_unit(v: Vector<Expr>) -> bool {
    v.0.iter().filter(|e| !e.is_zero()).count() == 1
        && v.0.iter().all(|e| e.as_number().is_some_and(|r| r.is_zero() || r.abs().is_one()))
}

fn is_signed_permutation(r: &Rotation<Expr>) -> bool {
    [r.x(), r.y(), r.z()].into_iter().all(is_signed_unit)
}
