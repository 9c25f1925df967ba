//! A walk along the chain: where its frames and axes are at a configuration, and how the joints move them.
//!
//! The axis of a row is the z of the frame in which the row's screw stands. A joint that turns about the axis z through o
//! moves a point p of a body by (z × (p − o), z), one that slides along it by (z, 0), linear velocity first; a joint that
//! stands in several rows by the sum (Whitney 1972).

use super::robot::{Link, Robot};
use crate::description::JointKind;
use crate::geometry::{Transform, Vector};
use crate::scalar::Scalar;

/// A frame of the robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reference {
    /// The base, in which frame 0 has a constant place.
    Base,
    /// The frame behind row i; frame 0 stands before row 1.
    Frame(usize),
    /// The tool, at a constant place in the last frame.
    Tool,
}

/// The axis of a row.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line<T> {
    /// Its direction, of length 1.
    pub direction: Vector<T>,
    /// A point of it, metres.
    pub point: Vector<T>,
}

/// How a joint moves a row: radians about the row's axis, or metres along it, for a unit of the joint.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mover<T> {
    /// The joint, from 0.
    pub joint: usize,
    /// Whether it turns the row or slides it.
    pub kind: JointKind,
    /// By how much.
    pub factor: T,
}

/// The velocity of a point of a body, and the body's angular velocity.
pub type Twist<T> = [Vector<T>; 2];

/// Frames and axes at a configuration, all seen from one frame.
#[derive(Clone, Debug)]
pub struct Walk<T> {
    pub(super) base: Transform<T>,
    /// Frames 0 … n.
    pub(super) frames: Vec<Transform<T>>,
    pub(super) tool: Transform<T>,
    /// The axis of each row.
    pub(super) axes: Vec<Line<T>>,
}

impl<T: Scalar> Line<T> {
    /// The z of a frame.
    #[inline]
    pub(crate) fn z_of(frame: &Transform<T>) -> Self {
        Line { direction: frame.rotation.z(), point: frame.translation }
    }

    /// What a mover does to a point of a body behind the row.
    pub fn twist(&self, mover: &Mover<T>, point: Vector<T>) -> Twist<T> {
        let z = self.direction;
        match mover.kind {
            JointKind::Revolute => [z.cross(point - self.point), z].map(|v| v.scale(mover.factor)),
            JointKind::Prismatic => [z.scale(mover.factor), Vector::zero()],
        }
    }
}

impl<T: Scalar> Link<T> {
    /// How the joints move the row.
    pub(crate) fn movers(&self) -> impl Iterator<Item = Mover<T>> {
        let of = |kind| move |&(joint, factor): &(usize, T)| Mover { joint, kind, factor };
        let turns = self.theta.terms.iter().map(of(JointKind::Revolute));
        turns.chain(self.d.terms.iter().map(of(JointKind::Prismatic)))
    }
}

/// Row by row the axis and the frame behind, from the frame before the first row on; nothing is kept.
pub fn along<T: Scalar>(
    links: &[Link<T>],
    q: &[T],
    start: Transform<T>,
) -> impl Iterator<Item = (Line<T>, Transform<T>)> {
    links.iter().scan(start, move |frame, link| {
        let (axis, behind) = link.step(frame, q);
        *frame = behind;
        Some((axis, behind))
    })
}

/// What each joint does, for a unit of its velocity, to a point of a body behind some rows with these axes.
pub fn twists<T: Scalar>(
    links: &[Link<T>],
    axes: impl Iterator<Item = Line<T>>,
    point: Vector<T>,
    columns: &mut [Twist<T>],
) {
    columns.fill([Vector::zero(); 2]);
    for (link, axis) in links.iter().zip(axes) {
        for mover in link.movers() {
            let [linear, angular] = axis.twist(&mover, point);
            let column = &mut columns[mover.joint];
            *column = [column[0] + linear, column[1] + angular];
        }
    }
}

impl<T: Scalar> Robot<T> {
    /// How many rows of the table move a body.
    pub(crate) fn rows_before(&self, body: Reference) -> usize {
        match body {
            Reference::Base => 0,
            Reference::Frame(i) => i,
            Reference::Tool => self.links.len(),
        }
    }
}

impl<T: Scalar> Walk<T> {
    /// For a robot, before any walk.
    pub fn new(robot: &Robot<T>) -> Self {
        let (n, x) = (robot.links.len(), Transform::identity());
        Walk { base: x, frames: vec![x; n + 1], tool: x, axes: vec![Line::z_of(&x); n] }
    }

    /// The robot at a configuration, seen from one of its frames.
    ///
    /// # Panics
    /// If the robot has no such frame.
    pub fn seen_from(robot: &Robot<T>, q: &[T], from: Reference) -> Self {
        let mut walk = Walk::new(robot);
        walk.to(robot, q, from);
        walk
    }

    /// To a configuration, seen from a frame: from there to both ends, so that formulas hold the joints between only.
    ///
    /// # Panics
    /// If the robot has no such frame, or other rows than the walk's.
    pub fn to(&mut self, robot: &Robot<T>, q: &[T], from: Reference) {
        let n = robot.links.len();
        let (k, start) = match from {
            Reference::Base => (0, robot.base),
            Reference::Frame(i) => (i, Transform::identity()),
            Reference::Tool => (n, robot.tool.inverse()),
        };
        self.frames[k] = start;
        for (i, (axis, frame)) in (k..).zip(along(&robot.links[k..], q, start)) {
            (self.axes[i], self.frames[i + 1]) = (axis, frame);
        }
        for (i, link) in robot.links[..k].iter().enumerate().rev() {
            self.frames[i] = self.frames[i + 1] * link.transform(q).inverse();
            self.axes[i] = link.axis(&self.frames[i]);
        }
        let one = Transform::identity();
        self.base = if from == Reference::Base { one } else { self.frames[0] * robot.base.inverse() };
        self.tool = if from == Reference::Tool { one } else { self.frames[n] * robot.tool };
    }

    /// A frame.
    ///
    /// # Panics
    /// If the robot has no such frame.
    pub fn place(&self, frame: Reference) -> Transform<T> {
        match frame {
            Reference::Base => self.base,
            Reference::Frame(i) => self.frames[i],
            Reference::Tool => self.tool,
        }
    }

    /// The axis of each row.
    pub fn axes(&self) -> &[Line<T>] {
        &self.axes
    }

    /// What each joint does, for a unit of its velocity, to a body and one of its points.
    pub fn twists(&self, robot: &Robot<T>, body: Reference, point: Vector<T>, columns: &mut [Twist<T>]) {
        let links = &robot.links[..robot.rows_before(body)];
        twists(links, self.axes.iter().copied(), point, columns);
    }
}
